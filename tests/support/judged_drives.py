"""Drives whose explanations are judged: roads from empty to crowded, some driven on to a crash."""

from __future__ import annotations

import random
from collections.abc import Iterator

from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Outcome

QUICK = ("priority", "rules")
"""Planners of which a decision is so cheap that the road may be long."""
DENSITIES = ((4, 10, 0, 0), (12, 30, 3, 4), (25, 90, 6, 8), (40, 60, 4, 0))
"""Potholes, vehicles, pedestrians and barriers on a road of 8 lanes and 30 rows."""


def drives(count: int, seed: int, planner: str) -> Iterator[Timeline]:
    """Timelines that have just taken a decision; some run on to a crash."""
    draw, found = random.Random(f"{planner} {seed}"), 0
    while found < count:
        rows = 30 if planner in QUICK else 12
        potholes, vehicles, pedestrians, barriers = (
            round(each * rows / 30) for each in draw.choice(DENSITIES)
        )
        config = Config(
            seed=draw.randrange(2**32),
            columns=8,
            rows=rows,
            potholes=potholes,
            vehicles=vehicles,
            pedestrians=pedestrians,
            barriers=barriers,
            courtesy=draw.choice([0.0, 0.5]),
            planner=planner,
        )
        if planner in ("dijkstra", "astar") and draw.random() < 0.4:
            config = config.with_parts(
                preferences=draw.choice([("cautious",), ("fastest",), ("smooth_ride",)])
            )
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, rows)):
            timeline.advance()
            if timeline.state.world.outcome is Outcome.CRASH:
                break
        if timeline.at(timeline.tick - 1).world.outcome is Outcome.RUNNING:
            found += 1
            yield timeline


def crashes(count: int, seed: int) -> Iterator[Timeline]:
    """Timelines of dense roads on which nobody brakes, that have ended in a crash."""
    draw, found = random.Random(f"crashes {seed}"), 0
    while found < count:
        config = Config(
            seed=draw.randrange(2**32),
            potholes=draw.choice([18, 25]),
            vehicles=draw.choice([40, 90]),
            pedestrians=6,
            barriers=8,
            attentive=0.0,
            planner=draw.choice(QUICK),
        )
        timeline = Timeline(config)
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        if timeline.state.world.outcome is Outcome.CRASH:
            found += 1
            yield timeline
