"""The moves' ways and how long they last, found in few passes, against a whole pass for each move."""

from __future__ import annotations

import random
from collections.abc import Iterator

from sim.config import Config
from sim.forecast import Forecast
from sim.search.reachability import (
    least_ticks_by_move,
    longest_lasting,
    reachability,
    steps_left,
    survival_by_move,
)
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import MOVES, Move, Outcome


def states(count: int) -> Iterator[SimState]:
    """Moments on crowded roads, on many of which no way leads to the goal."""
    draw = random.Random(5)
    while count:
        rows, columns = draw.choice([8, 14, 30]), draw.choice([5, 8])
        config = Config(
            seed=draw.randrange(2**32),
            columns=columns,
            rows=rows,
            potholes=rows * columns // 6,
            vehicles=rows * columns // draw.choice([3, 6]),
            pedestrians=draw.choice([0, 2]),
            barriers=rows // 4,
            collision=draw.choice(["cell", "swept"]),
        )
        timeline = Timeline(config)
        for _ in range(draw.randrange(rows)):
            timeline.advance()
        if timeline.state.world.outcome is Outcome.RUNNING:
            count -= 1
            yield timeline.state


def test_ways_and_survival_are_those_of_a_whole_pass_for_each_move() -> None:
    without_way = 0
    for state in states(120):
        limit = steps_left(state.config, state.world.episode_tick)
        forecast = Forecast.of_truth(state.world, state.config, limit)
        whole = [
            reachability(forecast.after(move), there, limit - 1, after=1).ticks if there else None
            for move, there in zip(MOVES, forecast.own_steps(), strict=True)
        ]
        expected = tuple(None if ticks is None else ticks + 1 for ticks in whole)
        assert least_ticks_by_move(forecast, limit) == expected
        if expected == (None,) * len(MOVES):
            without_way += 1
            lasts = survival_by_move(forecast, limit)
            longest = MOVES[lasts.index(max(lasts))] if any(lasts) else Move.STAY
            assert longest_lasting(forecast, limit) is longest
    assert without_way > 20
