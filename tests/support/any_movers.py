"""All that movers may do, one outcome after the other: each steps left, right or not at all, as it likes."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from sim.types import KINDS, Kind, kind_of
from sim.world import World

Places = tuple[int, ...]
"""Where each mover is, by cell index, in the order of `World.movers`."""


def places_of(world: World) -> Places:
    """Where the movers are now."""
    return tuple(world.movers)


def kinds_of(world: World) -> tuple[Kind, ...]:
    """The kinds of the movers."""
    return tuple(kind_of(name) for name in world.movers.values())


def outcomes(world: World, before: Places, ahead: int) -> Iterator[Places]:
    """Every way in which the movers may go in the tick that begins `ahead` ticks from now."""
    columns = world.road.columns
    tick = world.episode_tick + ahead
    choices = []
    for cell, kind in zip(before, kinds_of(world), strict=True):
        period = KINDS[kind].period or 1
        ends = [cell]
        if tick % period == period - 1 and not world.boards.holding >> cell & 1:
            for step in (-1, 1):
                column, end = cell % columns + step, cell + step
                if 0 <= column < columns and end not in before and not world.boards.fixed >> end & 1:
                    ends.append(end)
        choices.append(ends)
    return (after for after in product(*choices) if len(set(after)) == len(after))


def histories(world: World, ticks: int) -> Iterator[set[tuple[Places, Places]]]:
    """For each tick from now on: every (before, after) that may be."""
    now = {places_of(world)}
    for ahead in range(ticks):
        steps = {(before, after) for before in now for after in outcomes(world, before, ahead)}
        yield steps
        now = {after for _, after in steps}
