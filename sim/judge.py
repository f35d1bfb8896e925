"""What a tick has come to. The judge knows no planner and no forecast, only before and after.

It reads the tables of ids, not the boards that moved them, so that it is a second opinion on the
rules as well as on the driving. All defects are listed, not the first.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from sim.rules.dynamics import Dynamics, Swept
from sim.types import Kind, Outcome, ego_id, kind_of
from sim.world import Cause, World


def collisions(before: World, after: World, motion: Dynamics) -> tuple[Cause, ...]:
    """Every collision of an ego in the tick from `before` to `after`.

    It is in a cell after the tick that something else is in, or has run into something on the way: what a
    step sweeps, the motion says (`sim.rules.dynamics`).
    """
    if len(after.avs) == 1 and _met_nothing(before, after, motion):
        return ()
    found: list[Cause] = []
    known = 0
    for number, (start, end) in enumerate(zip(before.avs, after.avs, strict=True)):
        if end in after.hazards:
            name = after.hazards[end]
            found.append(Cause("hit", kind_of(name), (name,), after.road.cell(end)))
        if end in after.movers:
            name = after.movers[end]
            found.append(Cause("hit", kind_of(name), (name,), after.road.cell(end)))
        swept = motion.swept(start, end)
        for cell in swept.cells[1:] if len(swept.cells) > 1 else ():
            found += [
                Cause("hit", kind_of(table[cell]), (table[cell],), after.road.cell(cell))
                for table in (after.hazards, after.movers)
                if cell in table
            ]
        if swept.from_left or swept.from_right:
            found += _passed(before, after, start, end, swept)
        if number:
            found = [*found[:known], *(replace(each, ego=ego_id(number)) for each in found[known:])]
            found += _between_egos(before, after, number, motion)
        known = len(found)
    return tuple(found)


def _met_nothing(before: World, after: World, motion: Dynamics) -> bool:
    """Whether the only ego ends in a free cell, and its step sweeps nothing else: so in nearly every tick."""
    (end,) = after.avs
    cells, from_left, from_right = motion.swept(before.avs[0], end)
    nothing_else = len(cells) == 1 and not from_left and not from_right
    return nothing_else and end not in after.hazards and end not in after.movers


def _passed(before: World, after: World, start: int, end: int, swept: Swept) -> list[Cause]:
    """Movers that the ego runs into on the way from `start` to `end`: those that come through it."""
    road, found = after.road, []
    aside = start // road.columns == end // road.columns
    for cells, origin in ((swept.from_left, -1), (swept.from_right, 1)):
        for cell in cells:
            name = after.movers.get(cell)
            if name is not None and before.movers.get(cell + origin) == name:
                how, where = ("swap", end) if aside else ("cross", cell)
                found.append(Cause(how, kind_of(name), (name,), road.cell(where)))
    return found


def _between_egos(before: World, after: World, number: int, motion: Dynamics) -> Iterator[Cause]:
    """Collisions of an ego with those before it, by id."""
    road, own = after.road, (before.avs[number], after.avs[number])
    for other in range(number):
        theirs = (before.avs[other], after.avs[other])
        if motion.egos_touch(own, theirs):
            how = "hit" if own[1] == theirs[1] else "swap" if own == theirs[::-1] else "cross"
            yield Cause(how, Kind.AV, (ego_id(other), ego_id(number)), road.cell(own[1]), ego_id(number))


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
    return Outcome.STUCK if after.tick - after.episode_start > max_ticks else Outcome.RUNNING
