"""Roads with two egos."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from sim.config import Config
from sim.generation import generate
from sim.state import SimState
from sim.world.grid import bits

FIRST = "av-1"


SECOND = "av-2"


def drawn(random: Random, planner: str, egos: int = 2, **parts: object) -> SimState:
    """A random road with several egos in free cells."""
    columns, rows = random.randint(4, 6), random.randint(7, 11)
    config = Config(
        columns=columns,
        rows=rows,
        potholes=random.randint(0, 4),
        vehicles=random.randint(0, 6),
        pedestrians=random.randint(0, 2),
        planner=planner,
        seed=random.getrandbits(32),
    ).with_parts(**parts)
    world = generate(config, 1)
    free = [*bits(world.road.all & ~world.occupied & ~world.road.row(0))]
    world = replace(world, avs=(world.av, *random.sample(free, egos - 1)))
    return SimState.start(config, world)
