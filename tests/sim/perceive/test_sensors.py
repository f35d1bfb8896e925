"""Sensors by name, and beliefs that are carried along."""

from __future__ import annotations

import pytest

from service.sessions.persistence.snapshot_records import TooLargeError
from sim import sensor_names
from sim.batch import Batch
from sim.config import Config, ConfigError
from sim.decide import sense
from sim.perceive import NO_BELIEF, perceive_truth, register_sensor, sensor_named, unregister_sensor
from sim.session.serialization import BeliefError, Packer
from sim.session.timeline import Timeline
from sim.state import SimState, next_episode
from sim.transition import step
from sim.types import Outcome
from tests.support.rides import SENSORS, rides
from tests.support.sensors import NAMES, Delayed, Dropping, Missing, Phantom


def test_a_configuration_takes_the_sensors_there_are() -> None:
    assert sensor_names.names() == ("perfect", "camera", "lidar", "radar", "fusion", *NAMES)
    for sensor in SENSORS:
        assert Config(sensor=sensor.name).sensor == sensor.name
        assert sensor_named(sensor.name) is sensor
    with pytest.raises(ConfigError) as refused:
        Config(sensor="elsewhere")
    (problem,) = refused.value.problems
    assert (problem.field, problem.available) == ("sensor", True)


def test_a_name_is_taken_once_and_given_back() -> None:
    for name in ("perfect", "lidar", "noisy"):
        with pytest.raises(ValueError, match="already"):
            register_sensor(Missing(frozenset(), name))
    register_sensor(Missing(frozenset(), "blinkers"))
    assert Config(sensor="blinkers")
    unregister_sensor("blinkers")
    with pytest.raises(ConfigError):
        Config(sensor="blinkers")
    for name in ("perfect", "blinkers"):
        with pytest.raises(ValueError, match=name):
            unregister_sensor(name)


@pytest.mark.parametrize("sensor", ["delayed", "dropping"])
def test_a_belief_is_that_of_every_look_since_the_episode_began(sensor: str) -> None:
    state = SimState.start(Config(seed=3, sensor=sensor, vehicles=20, potholes=20))
    looks, episode, compared = 0, state.world.episode, 0
    before: list[object] = []
    for _ in range(60):
        if state.world.episode != episode:
            looks, before, episode = 0, [], state.world.episode
            assert state.belief is NO_BELIEF
        if state.world.outcome is Outcome.RUNNING:
            looks += len(state.world.movers) + len(state.world.hazards)
            before.append(perceive_truth(state.world, state.config))
            wanted = tuple(before[-3:]) if sensor == "delayed" else looks
            assert sense(state)[1] == wanted
            state = step(state).state
            if state.world.outcome is Outcome.RUNNING:
                assert state.belief == wanted
                compared += 1
        else:
            state = step(state).state
    assert compared > 20


@pytest.mark.parametrize("sensor", NAMES)
def test_a_replay_by_moves_comes_to_the_same_states(sensor: str) -> None:
    timeline = Timeline(Config(seed=5, sensor=sensor, vehicles=20, potholes=30, rows=12))
    states = [timeline.state]
    for _ in range(40):
        timeline.advance()
        states.append(timeline.state)
    assert list(timeline.between(0, 40)) == states[:40]
    twin = Timeline(timeline.config)
    for _ in range(40):
        twin.advance()
    twin.rewrite((), 0)
    assert twin.state == timeline.state


def test_a_stateless_sensor_costs_no_look_when_moves_are_replayed(monkeypatch: pytest.MonkeyPatch) -> None:
    timeline = Timeline(Config(seed=5, sensor="haunted", rows=12))
    for _ in range(10):
        timeline.advance()
    looks: list[int] = []
    monkeypatch.setattr("sim.decide.perceive", lambda *_: looks.append(1))
    list(timeline.between(0, 10))
    assert not looks


def test_a_state_with_a_belief_is_not_written_and_any_other_is() -> None:
    for sensor in NAMES:
        timeline = next(rides(sensor, 1, seed=2))
        state = timeline.at(timeline.tick - 1) if timeline.state.belief is NO_BELIEF else timeline.state
        if sensor in ("delayed", "dropping") and state.belief is not NO_BELIEF:
            with pytest.raises(BeliefError, match=sensor):
                Packer().run(state)
        else:
            assert Packer().run(state) == 0
    assert not issubclass(BeliefError, TooLargeError)


def test_a_new_road_is_looked_at_afresh() -> None:
    state = step(step(SimState.start(Config(sensor="delayed"))).state).state
    assert state.belief is not NO_BELIEF
    assert next_episode(state)[0].belief is NO_BELIEF


def test_sensors_say_what_they_are() -> None:
    traits = {
        sensor.name: (sensor.stateless, sensor.faithful) for sensor in (*SENSORS, sensor_named("perfect"))
    }
    assert traits.pop("perfect") == (True, True)
    assert {name for name, (stateless, _) in traits.items() if not stateless} == {Delayed.name, Dropping.name}
    assert not any(faithful for _, faithful in traits.values())
    assert Phantom((0, 0)).stateless


@pytest.mark.parametrize("sensor", NAMES)
def test_a_batch_sees_the_truth_and_refuses_what_does_not(sensor: str) -> None:
    states = [SimState.start(Config(sensor=name)) for name in ("perfect", sensor)]
    for configs in ([state.config for state in states], [states[1].config]):
        with pytest.raises(ValueError, match=f"no sensor '{sensor}' of a program"):
            Batch(configs)
    with pytest.raises(ValueError, match=f"no sensor '{sensor}' of a program"):
        Batch.of(states)
