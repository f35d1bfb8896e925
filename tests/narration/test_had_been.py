"""What another sensor or other conditions would have changed about a drive that failed."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, islice

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import Set
from sim.config import Config
from sim.explain.attribution import rerun, seen_since
from sim.perceive import NO_BELIEF, perceive
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome
from tests.support.narration_checks import looks_like_sentences


def driven(seed: int) -> Timeline:
    timeline = Timeline(Config(seed=seed, sensor="camera", weather="fog", time_of_day="night", potholes=15))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


def crashes(wanted: int) -> Iterator[Timeline]:
    """Crashes of a camera in fog by night."""
    found = (each for each in map(driven, count()) if each.state.world.outcome is Outcome.CRASH)
    return islice(found, wanted)


def asked(timeline: Timeline, parameter: str, value: str, code: str = "en") -> dict[str, object]:
    change = (Set(parameter=parameter, value=value),)  # type: ignore[arg-type]
    return Narrator.load(code).answer(Asked(Ask(about="what_if", change=change), timeline))


CHANGES = (("sensor", "lidar"), ("sensor", "perfect"), ("weather", "clear"), ("time_of_day", "day"))


@pytest.mark.parametrize("code", ["en", "de"])
def test_the_answer_is_what_a_session_with_that_setting_comes_to(code: str) -> None:
    arrived = 0
    for timeline in crashes(4):
        for setting, value in CHANGES:
            answer = asked(timeline, setting, value, code)
            looks_like_sentences(str(answer["text"]))
            state = SimState.start(timeline.config.with_parts(**{setting: value}))
            while state.world.outcome is Outcome.RUNNING:
                state = step(state).state
            facts = answer["had_been"]
            assert isinstance(facts, dict)
            assert (facts["outcome"], facts["ticks"]) == (state.world.outcome, state.world.tick)
            arrived += state.world.outcome is Outcome.SUCCESS
            if code == "en":
                would = "I would have arrived" if state.world.outcome is Outcome.SUCCESS else "I would have"
                assert f"Driven again like that from the start, {would}" in str(answer["text"])
    assert 0 < arrived < 16


def test_what_would_have_been_seen_is_what_the_sensor_sees_on_that_drive() -> None:
    seen = unseen = 0
    for timeline in crashes(8):
        cause = timeline.state.world.cause
        assert cause is not None
        (name,) = [each for each in cause.ids if not each.startswith("av-")]
        assert seen_since(timeline, {"sensor": "perfect"}) == 0
        since = seen_since(timeline, {"sensor": "lidar"})
        belief: object = NO_BELIEF
        for state in timeline.between(0, timeline.tick):
            config = state.config.with_parts(sensor="lidar")
            percept, belief = perceive(state.world, config, 0, belief)
            there, found = state.world.find(name), percept.find(name)
            right = found is not None and there is not None and found.cell == there.cell
            if since is not None and state.world.tick >= since:
                assert right
            if since is not None and state.world.tick == since - 1:
                assert not right
        if since is None:
            assert not right
        answer = asked(timeline, "sensor", "lidar")
        told = "I would not have seen it in time" if since is None else f"seen it since tick {since}."
        assert told in str(answer["text"])
        seen, unseen = seen + (since is not None), unseen + (since is None)
    assert seen
    assert unseen


def test_nothing_of_the_kind_is_told_where_nothing_failed_or_nothing_would_be_otherwise() -> None:
    fresh = Timeline(Config(seed=1, sensor="camera"))
    assert "had_been" not in asked(fresh, "sensor", "lidar")
    (crashed,) = crashes(1)
    assert "had_been" not in asked(crashed, "sensor", "camera")
    assert "had_been" not in asked(crashed, "planner", "astar")
    assert "had_been" not in asked(crashed, "sensor", "sonar")
    assert rerun(crashed, {"sensor": "camera"}) is not None
