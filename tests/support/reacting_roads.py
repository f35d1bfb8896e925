"""Runs under way on roads whose movers react, of all densities, for comparing two ways to the same answer."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence

from sim.config import Config, ConfigError
from sim.session.timeline import Timeline
from sim.types import Outcome

SHARES = (0.0, 0.3, 0.5, 1.0)


def reacting_runs(count: int, seed: int, planners: Sequence[str], most_rows: int = 14) -> Iterator[Timeline]:
    """Timelines that have just taken a decision, and are still under way."""
    draw, found = random.Random(f"{seed} {planners}"), 0
    while found < count:
        rows, columns = draw.randint(4, most_rows), draw.choice([3, 5, 8, 9])
        cells = rows * columns
        try:
            config = Config(
                seed=draw.randrange(2**32),
                rows=rows,
                columns=columns,
                planner=draw.choice(planners),
                courtesy=draw.choice(SHARES),
                attentive=draw.choice(SHARES),
                collision=draw.choice(["swept", "cell"]),
                repetition=draw.random() < 0.5,
                vehicles=cells // draw.choice([3, 5, 8, 20]),
                potholes=cells // draw.choice([6, 12, 25]),
                pedestrians=draw.choice([0, 2]),
                barriers=draw.choice([0, 1]),
                safety_buffer=draw.choice([0, 0, 1, 2]),
            )
        except ConfigError:  # more than there is room for
            continue
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, rows)):
            timeline.advance()
        if timeline.state.world.outcome is Outcome.RUNNING:
            found += 1
            yield timeline
