"""Which sensor or which conditions would have avoided a failure."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

import pytest

from sim.actions import Set
from sim.config import Config, ConfigError
from sim.explain.attribution import Rerun, attribute, rerun
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

FOGGY = Config(sensor="camera", weather="fog", time_of_day="night", potholes=15)


def failures(wanted: int, config: Config = FOGGY) -> Iterator[Timeline]:
    """Timelines in which a crash stands."""
    seed = 0
    while wanted:
        timeline = Timeline(config.with_parts(seed=seed))
        seed += 1
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        if timeline.state.world.outcome is Outcome.CRASH:
            wanted -= 1
            yield timeline


def test_alternatives_are_what_a_session_with_that_setting_comes_to() -> None:
    avoided = 0
    for timeline in failures(6):
        found = attribute(timeline)
        assert found is not None
        assert (found.outcome, found.tick) == (Outcome.CRASH, timeline.tick)
        assert [(each.setting, each.value) for each in found.alternatives] == [
            ("sensor", "perfect"),
            ("sensor", "lidar"),
            ("sensor", "radar"),
            ("sensor", "fusion"),
            ("weather", "clear"),
            ("time_of_day", "day"),
        ]
        for each in found.alternatives:
            state = SimState.start(timeline.config.with_parts(**{each.setting: each.value}))
            while state.world.outcome is Outcome.RUNNING:
                state = step(state).state
            assert (each.outcome, each.ticks) == (state.world.outcome, state.world.tick)
            assert rerun(timeline, {each.setting: each.value}) == Rerun(each.outcome, each.ticks)
        avoided += found.by_sensing
        assert all(each.avoids for each in found.avoided_by)
    assert avoided >= 4


def spoilt(seed: int) -> Timeline:
    """An episode in which it gets foggy and dark after three ticks."""
    timeline = Timeline(Config(seed=seed, sensor="camera", potholes=15))
    for _ in range(3):
        timeline.advance()
    timeline.apply(1, [Set(parameter="weather", value="fog")])
    timeline.apply(2, [Set(parameter="time_of_day", value="night")])
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    return timeline


def test_what_was_said_on_the_way_is_said_again() -> None:
    crashed = (each for each in map(spoilt, count()) if each.state.world.outcome is Outcome.CRASH)
    timeline = next(each for each in crashed if each.tick > 4)
    clear = rerun(timeline, {"weather": "clear"})
    assert clear is not None
    twin = Timeline(timeline.config)
    for _ in range(3):
        twin.advance()
    twin.apply(1, [Set(parameter="time_of_day", value="night")])
    while twin.state.world.outcome is Outcome.RUNNING:
        twin.advance()
    assert (clear.outcome, clear.ticks) == (twin.state.world.outcome, twin.tick)


def test_where_nothing_failed_nothing_is_attributed() -> None:
    timeline = Timeline(Config(seed=1))
    assert attribute(timeline) is None
    assert rerun(timeline, {"sensor": "lidar"}) is None
    with pytest.raises(ConfigError):
        rerun(next(failures(1)), {"sensor": "sonar"})
