"""What a tick has come to. The judge knows no planner and no forecast, only before and after.

It reads the tables of ids, not the boards that moved them, so that it is a second opinion on the
rules as well as on the driving. All defects are listed, not the first.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from sim.config import Collision
from sim.rules.contacts import egos_touch
from sim.types import Kind, Outcome, ego_id, kind_of
from sim.world import Cause, World


def collisions(before: World, after: World, rule: Collision) -> tuple[Cause, ...]:
    """Every collision of an ego in the tick from `before` to `after`.

    `swept`: two bodies of stated size that move linearly within the tick touch (`sim.rules.bodies` derives
    the cases); `cell`: they are in one cell after it, or have changed places.
    """
    found: list[Cause] = []
    known = 0
    for number, (start, end) in enumerate(zip(before.avs, after.avs, strict=True)):
        if end in after.hazards:
            name = after.hazards[end]
            found.append(Cause("hit", kind_of(name), (name,), after.road.cell(end)))
        if end in after.movers:
            name = after.movers[end]
            found.append(Cause("hit", kind_of(name), (name,), after.road.cell(end)))
        passed = after.movers.get(start)
        if start != end and passed is not None and before.movers.get(end) == passed:
            found.append(Cause("swap", kind_of(passed), (passed,), after.road.cell(end)))
        if rule == "swept":
            found += _crossings(before, after, start, end)
        if number:
            found = [*found[:known], *(replace(each, ego=ego_id(number)) for each in found[known:])]
            found += _between_egos(before, after, number, rule)
        known = len(found)
    return tuple(found)


def _between_egos(before: World, after: World, number: int, rule: Collision) -> Iterator[Cause]:
    """Collisions of an ego with those before it, by id."""
    road, own = after.road, (before.avs[number], after.avs[number])
    for other in range(number):
        theirs = (before.avs[other], after.avs[other])
        if egos_touch(road, own, theirs, rule):
            how = "hit" if own[1] == theirs[1] else "swap" if own == theirs[::-1] else "cross"
            yield Cause(how, Kind.AV, (ego_id(other), ego_id(number)), road.cell(own[1]), ego_id(number))


def _crossings(before: World, after: World, start: int, end: int) -> list[Cause]:
    """Movers that a diagonal from `start` to `end` runs into on the way.

    A vehicle that goes forward and to the left meets a mover that comes from the left into the cell it
    leaves, or into the one straight ahead; to the right it is the mirror image.
    """
    ahead = start - after.road.columns
    side = end - ahead
    if side not in (-1, 1):
        return []
    return [
        Cause("cross", kind_of(name), (name,), after.road.cell(cell))
        for cell in (ahead, start)
        if (name := after.movers.get(cell)) is not None and before.movers.get(cell + side) == name
    ]


def outcome(
    after: World, crashes: tuple[Cause, ...], max_ticks: int, parked: Collection[int] = ()
) -> Outcome:
    """How the episode stands after a tick with these collisions.

    SUCCESS: at least one ego has arrived, and all have but those at the places of `parked` in `World.avs`.
    """
    if crashes:
        return Outcome.CRASH
    columns, avs = after.road.columns, after.avs
    if min(avs) < columns and all(cell < columns or number in parked for number, cell in enumerate(avs)):
        return Outcome.SUCCESS
    return Outcome.STUCK if after.episode_tick > max_ticks else Outcome.RUNNING
