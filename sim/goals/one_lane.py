"""Blocks every lane but one in a row ahead, so that every way to the goal leads through one of its cells."""

from __future__ import annotations

from sim.actions import Add, Where
from sim.goals.budget import Budget
from sim.goals.finding import Finding
from sim.goals.measure import measure
from sim.goals.more_or_less import CLEAR_ROWS, measure_present, present_drives
from sim.randomness import Stream
from sim.session.edits import apply
from sim.state import SimState
from sim.world.grid import bits


def find_one_lane(state: SimState, budget: Budget) -> Finding | None:
    """Barriers in all lanes but one of a row, the nearest that leaves a way; None where there is none.

    Fixed hazards that stand in the row already stay. Rows with movers are left alone, since a mover could
    stand in the gap. Raises `EditError`.
    """
    before = measure_present(state, budget)
    world = state.world
    road, columns = world.road, world.road.columns
    stream = Stream.of(state.config.seed, "goal one_lane_free", world.episode, world.tick, state.edits)
    for row in range(world.av // columns - CLEAR_ROWS, 0, -1):
        whole = road.row(row)
        free = [*bits(whole & ~world.occupied)]
        if whole & world.moving or len(free) < 2:
            continue
        ranks = stream.narrow(row).words(len(free))
        for _, gap in sorted(zip(ranks, free, strict=True)):
            blocked = [road.cell(cell) for cell in free if cell != gap]
            actions = tuple(Add(kind="barrier", count=1, where=Where(cell=cell)) for cell in blocked)
            after = state
            for action in actions:
                after = apply(after, action).state
            level = measure(after, budget, None if before is None else before.horizon)
            if level is None:
                continue
            return Finding(
                "one_lane_free",
                actions,
                after,
                level,
                before,
                present_drives(after, budget),
                present_drives(state, budget),
                lane=gap % columns + 1,
                row=row,
            )
    return None
