"""What a tick has come to. The judge knows no planner and no forecast, only before and after.

It reads the tables of ids, not the boards that moved them, so that it is a second opinion on the
rules as well as on the driving. All defects are listed, not the first.
"""

from __future__ import annotations

from sim.config import Collision
from sim.types import Kind, Outcome, kind_of
from sim.world import Cause, World


def collisions(before: World, after: World, rule: Collision) -> tuple[Cause, ...]:
    """Every collision of an autonomous vehicle in the tick from `before` to `after`.

    `swept`: two bodies of stated size that move linearly within the tick touch (`sim.rules.bodies` derives
    the cases); `cell`: they are in one cell after it, or have changed places.
    """
    found = []
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
        for other in range(number):
            met = after.avs[other] == end
            if met or (after.avs[other] == start != end == before.avs[other]):
                how = "hit" if met else "swap"
                pair = (f"av-{other + 1}", f"av-{number + 1}")
                found.append(Cause(how, Kind.AV, pair, after.road.cell(end)))
    return tuple(found)


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


def outcome(after: World, crashes: tuple[Cause, ...], max_ticks: int) -> Outcome:
    """How the episode stands after a tick with these collisions."""
    if crashes:
        return Outcome.CRASH
    if max(after.avs) < after.road.columns:
        return Outcome.SUCCESS
    return Outcome.STUCK if after.episode_tick > max_ticks else Outcome.RUNNING
