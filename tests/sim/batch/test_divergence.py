"""Where planners part is where they part in two single runs."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sim.batch import first_divergence
from sim.config import Config
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

# What they use is compiled at first use, once in every worker that has one of them.
pytestmark = pytest.mark.xdist_group("compiled")


def parting(config: Config) -> int:
    """The tick at which the rule and the exact planner first differ, one world at a time; −1: never."""
    one, other = SimState.start(config), SimState.start(replace(config, planner="bfs"))
    while one.world.outcome is other.world.outcome is Outcome.RUNNING:
        tick = one.world.tick
        one, other = step(one).state, step(other).state
        if one.world.av != other.world.av:
            return tick
    return -1


def test_the_first_difference_is_found() -> None:
    configs = [Config(seed=seed, potholes=4, planner="priority") for seed in range(40)]
    found = first_divergence(configs, "priority", "bfs")
    assert found.tolist() == [parting(config) for config in configs]
    assert (first_divergence(configs, "weighted", "weighted") == -1).all()


def test_who_has_ended_decides_no_more() -> None:
    """Of two that stand in the same cage, one is stuck soon, and the other stands there to the limit."""
    dense = Config(columns=5, rows=8, barriers=14, vehicles=0, potholes=0, planner="priority")
    configs = [replace(dense, seed=seed) for seed in range(40)]
    found = first_divergence(configs, "priority", "bfs")
    assert found.tolist() == [parting(config) for config in configs]
    assert found.tolist() == first_divergence(configs, "bfs", "priority").tolist()
