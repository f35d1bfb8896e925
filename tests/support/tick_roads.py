"""Roads whose tick messages are compared."""

from __future__ import annotations

from sim.config import Config

TICKS = 60


def roads() -> list[Config]:
    small = [Config(seed=seed, rows=14, pedestrians=seed % 3, courtesy=seed % 2 * 0.5) for seed in range(6)]
    large = Config(seed=7, columns=20, rows=40, pothole_probability=0.4, cell_m=2.5)
    return [*small, large, Config(seed=8, columns=3, rows=10, barriers=2), Config(seed=9, planner="astar")]
