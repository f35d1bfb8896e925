"""Rides with sensors that err."""

from __future__ import annotations

import random
from collections.abc import Iterator

from sim.config import Config
from sim.perceive import Sensor
from sim.session.timeline import Timeline
from tests.support.sensors import Delayed, Dropping, Haunted, Missing, Noisy, Phantom

SENSORS: tuple[Sensor, ...] = (
    Phantom((3, 5)),
    Haunted(),
    Missing(frozenset(f"{kind}-{number}" for kind in ("pothole", "vehicle") for number in (1, 3, 5, 8))),
    Delayed(),
    Dropping(),
    Noisy(),
)


def rides(sensor: str, count: int, seed: int = 0, **parts: object) -> Iterator[Timeline]:
    """Timelines that have taken a few decisions with this sensor, the last of them in their latest tick."""
    draw = random.Random(f"{sensor} {seed}")
    found = 0
    while found < count:
        columns, rows = draw.choice([5, 8]), draw.choice([8, 12])
        config = Config(
            seed=draw.randrange(2**32),
            columns=columns,
            rows=rows,
            potholes=draw.choice([0, rows * columns // 8]),
            vehicles=draw.choice([0, rows * columns // 6]),
            pedestrians=draw.choice([0, 2]),
            courtesy=draw.choice([0.0, 0.0, 0.5]),
            planner=draw.choice(["rules", "priority", "rules", "priority", "dijkstra"]),
            sensor=sensor,
        ).with_parts(**parts)
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, rows + 4)):
            timeline.advance()
        if timeline.decision(timeline.tick - 1) is not None:
            found += 1
            yield timeline
