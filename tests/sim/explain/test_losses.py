"""What decisions have cost adds up to what the drive took above the quickest way from its start."""

from __future__ import annotations

import pytest

from sim.config import Config
from sim.explain import QuestionError
from sim.explain.losses import losses
from sim.oracle.lower_bounds import least_ticks
from sim.session.timeline import Timeline
from sim.types import Outcome


def driven(seed: int, ticks: int = 60, **config: object) -> Timeline:
    """A timeline driven to the end of its first episode."""
    timeline = Timeline(Config(seed=seed, columns=8, rows=16, vehicles=20).with_parts(**config))
    for _ in range(ticks):
        timeline.advance()
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
    return timeline


@pytest.mark.parametrize("planner", ["priority", "rules", "bfs"])
@pytest.mark.parametrize("seed", range(4))
def test_losses_add_up_to_what_an_arrival_took_above_the_quickest_way(seed: int, planner: str) -> None:
    timeline = driven(seed, planner=planner)
    world = timeline.state.world
    assert world.outcome is Outcome.SUCCESS, "choose seeds that arrive"
    assert world.ended is not None
    found, best = losses(timeline), least_ticks(timeline.at(world.episode_start))
    assert best is not None
    assert found.unknown == 0
    assert found.ticks == world.ended - world.episode_start - best
    assert all(loss.ticks is None or loss.ticks > 0 for loss in found.found)


def test_nothing_is_claimed_where_others_react_by_chance() -> None:
    with pytest.raises(QuestionError) as refused:
        losses(driven(1, 3, courtesy=0.5))
    assert refused.value.code == "losses_by_chance"


def test_a_drive_that_has_not_begun_has_no_losses() -> None:
    with pytest.raises(QuestionError) as refused:
        losses(driven(1, 0))
    assert refused.value.code == "nothing_yet"
