"""What a tick has come to. The judge knows no planner and no forecast, only before and after.

It reads the tables of ids, not the boards that moved them, so that it is a second opinion on the
rules as well as on the driving. All defects are listed, not the first.
"""

from __future__ import annotations

from sim.kinds import Kind, Outcome, kind_of
from sim.world import Cause, World


def collisions(before: World, after: World) -> tuple[Cause, ...]:
    """Every collision of an autonomous vehicle in the tick from `before` to `after`."""
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
        for other in range(number):
            met = after.avs[other] == end
            if met or (after.avs[other] == start != end == before.avs[other]):
                how = "hit" if met else "swap"
                pair = (f"av-{other + 1}", f"av-{number + 1}")
                found.append(Cause(how, Kind.AV, pair, after.road.cell(end)))
    return tuple(found)


def outcome(after: World, crashes: tuple[Cause, ...], max_ticks: int) -> Outcome:
    """How the episode stands after a tick with these collisions."""
    if crashes:
        return Outcome.CRASH
    if max(after.avs) < after.road.columns:
        return Outcome.SUCCESS
    return Outcome.STUCK if after.episode_tick > max_ticks else Outcome.RUNNING
