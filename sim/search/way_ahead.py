"""A way to the goal where movers react, found by going ahead: the state that is nearest to the goal first.

Most roads have many ways, and the breadth-first search of `sim.search.reactive` looks at all states of a
tick before it goes on. This search goes ahead until it is stuck, so it meets about as many states as the way
has ticks. Guarantee: a way that is found is one, by the same steps. Where none is found within its bounds
there may be one all the same.
"""

from __future__ import annotations

from sim.search.dead_ends import cells_that_may_arrive
from sim.search.reactive import SPARE_TICKS, ReactiveSearch, Row


def finds_way_ahead(search: ReactiveSearch, limit: int, states: int) -> bool:
    """Whether a way is found within `limit` ticks by looking at so many states."""
    world = search.world
    columns = world.road.columns
    row, column = search.start()
    if row.number == 0:
        return True
    limit = min(limit, -(-row.number // search.forecast.dynamics.rows_a_tick) + SPARE_TICKS[-1])
    hopeful = cells_that_may_arrive(search.forecast, limit)
    waiting: list[tuple[int, Row, int]] = [(0, row, column)]
    seen = set(waiting)
    while waiting and states > 0:
        states -= 1
        ahead, row, column = waiting.pop()
        if ahead == limit:
            continue
        after = list(search.steps(row, column, ahead))
        for _, there, end in reversed(after):  # forward is the first move, and the last of the stack
            if there.number == 0:
                return True
            state = ahead + 1, there, end
            if hopeful[ahead + 1] >> there.number * columns + end & 1 and state not in seen:
                seen.add(state)
                waiting.append(state)
        waiting.sort(key=lambda each: -each[1].number)
    return False
