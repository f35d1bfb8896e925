"""Roads of other seeds end as sessions of those seeds do, driven tick by tick."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain import QuestionError
from sim.explain.other_seeds import other_seeds
from sim.explain.seed_drives import SEEDS
from sim.session.timeline import Timeline
from sim.types import Outcome


def driven(seed: int, ticks: int, **parts: object) -> Timeline:
    config = Config(seed=seed, columns=6, rows=14, potholes=10, vehicles=14, planner="priority")
    timeline = Timeline(config.with_parts(**parts))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


@pytest.mark.parametrize(("seed", "ticks"), [(0, 0), (3, 5), (7, 90)])
def test_each_seed_ends_as_a_session_of_it_does(seed: int, ticks: int) -> None:
    found = other_seeds(driven(seed, ticks))
    assert (found.first, found.last) == (seed + 1, seed + SEEDS)
    ends = [driven(each, 500).state.world.outcome for each in range(found.first, found.last + 1)]
    assert list(found.outcomes) == ends
    assert sum(found.counts.values()) == SEEDS
    assert len(set(ends)) > 1, "choose roads that end otherwise"


def test_nothing_is_driven_with_a_planner_that_takes_long() -> None:
    with pytest.raises(QuestionError) as refused:
        other_seeds(driven(0, 0, planner="astar"))
    assert refused.value.code == "too_long_again"
