"""How often the rule planner arrives, against figures measured by an independent sketch of the rules.

The sketch's 2,000 worlds a figure and the worlds run here both err by chance, and the figures are
told to within a point; 3.3 standard errors of the difference leave one false alarm in a thousand.
The seeds are fixed, so a test that passes goes on passing until the world changes.
"""

from __future__ import annotations

from math import sqrt

import pytest

from sim.config import Config
from sim.metrics import Metrics
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

SOURCE = Config(planner="priority", collision="cell", attentive=0.0, repetition=False)
"""The rules that the sketch goes by: those of the source study."""

SKETCH_WORLDS = 2000
ROUNDING = 0.01


def driven(seed: int, potholes: int | None) -> SimState:
    """The first episode of a seed, to its end."""
    state = SimState.start(SOURCE.with_parts(seed=seed, potholes=potholes))
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state


@pytest.mark.parametrize(
    ("potholes", "measured", "worlds"),
    [(None, 0.979, 300), (10, 0.932, 300), (20, 0.806, 300), (40, 0.452, 150), (60, 0.154, 100)],
)
def test_how_often_the_rule_planner_arrives(potholes: int | None, measured: float, worlds: int) -> None:
    runs = [driven(seed, potholes) for seed in range(worlds)]
    share = sum(state.metrics.successes for state in runs) / worlds
    error = sqrt(measured * (1 - measured) * (1 / worlds + 1 / SKETCH_WORLDS))
    assert abs(share - measured) < 3.3 * error + ROUNDING


def test_the_drive_takes_about_35_ticks_and_goes_forward_most_of_the_time() -> None:
    runs = [driven(seed, None) for seed in range(1000, 1100)]
    arrived = [state.world.episode_tick for state in runs if state.world.outcome is Outcome.SUCCESS]
    assert min(arrived) >= 29, "29 rows, one a tick"
    assert 33.0 < sum(arrived) / len(arrived) < 38.0
    total = Metrics(
        forward=sum(state.metrics.forward for state in runs),
        lateral=sum(state.metrics.lateral for state in runs),
        diagonal=sum(state.metrics.diagonal for state in runs),
        stay=sum(state.metrics.stay for state in runs),
    )
    assert total.forward / total.steps > 0.6
    assert total.forward > total.lateral > total.diagonal > total.stay
