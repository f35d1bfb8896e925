"""Whether the weather made a difference: what is told is what an independent rerun in clear weather does."""

from __future__ import annotations

import pytest

from sim.actions import Set
from sim.config import Config
from sim.explain.attribution import rerun
from sim.explain.driven_again import replayed
from sim.explain.question_error import QuestionError
from sim.explain.weather_effect import weather_effect
from sim.session.timeline import Timeline
from sim.types import Outcome


def driven(ticks: int, **parts: object) -> Timeline:
    """A drive of so many ticks, or to its end."""
    timeline = Timeline(Config(columns=6, rows=14, potholes=12, vehicles=12).with_parts(**parts))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


@pytest.mark.parametrize("weather", ["fog", "snow"])
def test_a_failure_is_the_weathers_where_clear_weather_arrives(weather: str) -> None:
    told = set()
    for seed in range(40):
        timeline = driven(60, seed=seed, sensor="camera", weather=weather, attentive=0.0)
        if timeline.state.world.outcome not in (Outcome.CRASH, Outcome.STUCK):
            continue
        found, other = weather_effect(timeline), rerun(timeline, {"weather": "clear"})
        assert other is not None
        assert found.clear_outcome is other.outcome
        assert found.caused is other.avoids
        told.add(found.caused)
    assert told == {True, False}


def test_the_first_other_move_is_that_of_a_session_in_clear_weather() -> None:
    differing = 0
    for seed in range(20):
        timeline = driven(8, seed=seed, sensor="camera", weather="fog")
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        clear = driven(timeline.tick, seed=seed, sensor="camera")
        moves = [
            (timeline.decision(tick), clear.decision(tick)) for tick in range(min(timeline.tick, clear.tick))
        ]
        first = next((tick for tick, (a, b) in enumerate(moves) if a and b and a.move is not b.move), None)
        found = weather_effect(timeline)
        assert (None if found.differs is None else found.differs.tick) == first
        differing += first is not None
    assert differing


def test_in_clear_weather_nothing_is_run_and_a_perfect_sensor_makes_no_difference() -> None:
    assert weather_effect(driven(5, seed=1)).clear_ticks == 0
    found = weather_effect(driven(5, seed=1, weather="fog"))
    assert (found.caused, found.differs) == (False, None)
    assert found.clear_ticks >= 5
    with pytest.raises(QuestionError, match="nothing_yet"):
        weather_effect(driven(0, seed=1, weather="fog"))


@pytest.mark.parametrize("parts", [{}, {"courtesy": 0.5}, {"sensor": "camera", "weather": "snow"}])
def test_a_drive_comes_again_as_it_was(parts: dict[str, object]) -> None:
    for ticks in (0, 6, 60):
        timeline = driven(ticks, seed=4, **parts)
        if ticks == 6:
            timeline.apply(1, [Set(parameter="safety_buffer", value=2)])
            timeline.advance()
        found = replayed(timeline)
        assert found.same
        assert found.possible
        world = timeline.state.world
        assert found.ticks == (timeline.tick if world.ended is None else world.ended)


def test_another_seed_is_noticed() -> None:
    timeline = driven(6, seed=4)
    real = timeline.between
    other = driven(6, seed=5)
    timeline.between = lambda first, stop: other.between(first, stop)  # type: ignore[method-assign]
    assert not replayed(timeline).same
    timeline.between = real  # type: ignore[method-assign]
