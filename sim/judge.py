"""What a tick has come to. The judge knows no planner and no forecast, only before and after.

It reads the tables of ids, not the boards that moved them, so that it is a second opinion on the
rules as well as on the driving. All defects are listed, not the first.
"""

from __future__ import annotations

from sim.config import Collision
from sim.rules.dynamics import DEFAULT_DYNAMICS, Swept, dynamics_named
from sim.types import Kind, Outcome, kind_of
from sim.world import Cause, World


def collisions(
    before: World, after: World, rule: Collision, dynamics: str = DEFAULT_DYNAMICS
) -> tuple[Cause, ...]:
    """Every collision of an autonomous vehicle in the tick from `before` to `after`.

    `swept`: two bodies of stated size that move linearly within the tick touch (`sim.rules.bodies` derives
    the cases); `cell`: they are in one cell after it, or have changed places. What a step sweeps, the motion
    says (`sim.rules.dynamics`).
    """
    found = []
    motion = dynamics_named(dynamics, after.road.columns, after.road.rows, bodies=rule == "swept")
    for number, (start, end) in enumerate(zip(before.avs, after.avs, strict=True)):
        if end in after.hazards:
            name = after.hazards[end]
            found.append(Cause("hit", kind_of(name), (name,), after.road.cell(end)))
        if end in after.movers:
            name = after.movers[end]
            found.append(Cause("hit", kind_of(name), (name,), after.road.cell(end)))
        swept = motion.swept(start, end)
        for cell in swept.cells[1:]:
            found += [
                Cause("hit", kind_of(table[cell]), (table[cell],), after.road.cell(cell))
                for table in (after.hazards, after.movers)
                if cell in table
            ]
        found += _passed(before, after, start, end, swept)
        for other in range(number):
            met = after.avs[other] == end
            if met or (after.avs[other] == start != end == before.avs[other]):
                how = "hit" if met else "swap"
                pair = (f"av-{other + 1}", f"av-{number + 1}")
                found.append(Cause(how, Kind.AV, pair, after.road.cell(end)))
    return tuple(found)


def _passed(before: World, after: World, start: int, end: int, swept: Swept) -> list[Cause]:
    """Movers that the vehicle runs into on the way from `start` to `end`: those that come through it."""
    road, found = after.road, []
    aside = start // road.columns == end // road.columns
    for cells, origin in ((swept.from_left, -1), (swept.from_right, 1)):
        for cell in cells:
            name = after.movers.get(cell)
            if name is not None and before.movers.get(cell + origin) == name:
                how, where = ("swap", end) if aside else ("cross", cell)
                found.append(Cause(how, kind_of(name), (name,), road.cell(where)))
    return found


def outcome(after: World, crashes: tuple[Cause, ...], max_ticks: int) -> Outcome:
    """How the episode stands after a tick with these collisions."""
    if crashes:
        return Outcome.CRASH
    if max(after.avs) < after.road.columns:
        return Outcome.SUCCESS
    return Outcome.STUCK if after.episode_tick > max_ticks else Outcome.RUNNING
