"""The settings that hold for every device: range, noise and false alarms."""

from __future__ import annotations

import pytest

from sim.actions import Adjust, Set
from sim.batch import Batch
from sim.config import Config, ConfigError
from sim.perceive import NO_BELIEF, Belief, perceive
from sim.perceive.belief import GridBelief
from sim.perceive.detection import detection_chance
from sim.perceive.grid_sensor import looks
from sim.perceive.parameters import LIDAR, SUITES
from sim.perceive.sensor_model import AS_BUILT, Tuning, sensor_model, tuning_of
from sim.session.settings import change_setting
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.statistics import wilson
from sim.transition import step
from sim.types import Kind, Outcome
from tests.support.roads import road, run_on

EMPTY = road(*["......"] * 7, "..A...", "......")


@pytest.mark.parametrize("sensor", ["camera", "lidar", "radar"])
@pytest.mark.parametrize("weather", ["clear", "fog"])
def test_the_defaults_change_nothing(sensor: str, weather: str) -> None:
    config = Config(sensor=sensor, weather=weather)  # type: ignore[arg-type]
    (spec,) = SUITES[sensor]
    same = sensor_model(spec, config.weather, "day", 5.0, 8, tuning_of(config))
    plain = sensor_model(spec, config.weather, "day", 5.0, 8, AS_BUILT)
    assert (same.reach, same.shifts) == (plain.reach, plain.shifts)
    for kind, seen in plain.kinds.items():
        assert same.kinds[kind].drawn == seen.drawn
        assert same.kinds[kind].false_alarm == seen.false_alarm


def test_nothing_is_seen_beyond_the_range() -> None:
    state = SimState.start(Config(seed=3, sensor="fusion", vehicles=25, potholes=25, sensor_range_m=20.0))
    seen = 0
    for seed in range(30):
        config = state.config.with_parts(seed=seed)
        row, column = divmod(state.world.av, state.world.road.columns)
        for look in looks(state.world, config, 0, SUITES["fusion"]):
            for cell in range(state.world.road.columns * state.world.road.rows):
                if look.visible >> cell & 1:
                    far = (row - cell // 8) ** 2 + (column - cell % 8) ** 2
                    assert far <= 16
                    seen += 1
    assert seen > 100
    assert detection_chance(state.config, Kind.VEHICLE, 20.0)
    assert detection_chance(state.config, Kind.VEHICLE, 20.1) == 0.0


def test_false_alarms_are_as_often_as_was_set() -> None:
    rate, tries, alarms = 0.4, 1_500, 0
    state = run_on(EMPTY)
    for seed in range(tries):
        config = state.config.with_parts(seed=seed, sensor="lidar", false_positive_rate=rate, cell_m=20.0)
        (look,) = looks(state.world, config, 0, SUITES["lidar"])
        alarms += len(look.reports)
    model = sensor_model(LIDAR, "clear", "day", 20.0, 6, Tuning(150.0, 0.0, rate))
    own = sensor_model(LIDAR, "clear", "day", 20.0, 6, AS_BUILT)
    cells = (model.reach + 1) * 6
    assert sum(seen.false_alarm - own.kinds[kind].false_alarm for kind, seen in model.kinds.items()) == (
        pytest.approx(rate / cells)
    )
    low, high = wilson(alarms, tries)
    wanted = sum(seen.false_alarm for seen in model.kinds.values()) * look.visible.bit_count()
    assert low - 0.02 <= wanted <= high + 0.02


def test_noise_displaces_more_reports() -> None:
    shares = []
    for noise in (0.0, 0.1, 0.5):
        model = sensor_model(LIDAR, "clear", "day", 5.0, 8, Tuning(150.0, noise, 0.0))
        ((*_, right_cell), *_) = model.shifts[6][7]
        shares.append(right_cell)
    assert shares[0] > 0.99
    assert shares == sorted(shares, reverse=True)
    assert shares[-1] < 0.3


def test_they_are_set_adjusted_undone_and_replayed() -> None:
    timeline = Timeline(Config(seed=5, sensor="camera", potholes=12))
    for _ in range(4):
        timeline.advance()
    timeline.apply(
        1, [Set(parameter="sensor_range_m", value=25), Set(parameter="false_positive_rate", value=0.3)]
    )
    timeline.apply(2, [Adjust(parameter="sensor_noise", direction="up")])
    assert timeline.state.config.sensor_noise == pytest.approx(0.05)
    for _ in range(6):
        timeline.advance()
    twin = timeline.copy()
    twin.rewrite(tuple(timeline.entries), 0)
    assert twin.state == timeline.state
    plain = timeline.copy()
    plain.rewrite((), 4)
    assert plain.state.config.sensor_range_m == 150.0
    assert plain.at(10 if plain.tick >= 10 else plain.tick) != timeline.state


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("sensor_range_m", 4.9),
        ("sensor_range_m", 151.0),
        ("sensor_noise", -0.1),
        ("false_positive_rate", 0.51),
    ],
)
def test_other_numbers_are_refused(name: str, value: float) -> None:
    with pytest.raises(ConfigError) as refused:
        Config(**{name: value})  # type: ignore[arg-type]
    assert [problem.field for problem in refused.value.problems] == [name]
    assert change_setting(Config(), Set(parameter="sensor_noise", value=0.1)).sensor_noise == 0.1


@pytest.mark.parametrize("sensor", ["camera", "fusion"])
def test_with_latency_a_look_is_known_a_tick_later(sensor: str) -> None:
    """What is on the road now has no part in what is seen; the belief holds what was looked at."""
    late = Config(sensor=sensor, sensor_latency=1, seed=5, weather="rain")
    state = SimState.start(late)
    prompt_belief: Belief = NO_BELIEF
    differs = 0
    for tick in range(12):
        seen, belief = perceive(state.world, late, 0, state.belief)
        at_once, prompt = perceive(state.world, late.with_parts(sensor_latency=0), 0, prompt_belief)
        assert isinstance(belief, GridBelief)
        assert isinstance(prompt, GridBelief)
        assert belief.layers == prompt.layers
        if tick == 0:
            assert (seen.right, seen.left, seen.boards) == (at_once.right, at_once.left, at_once.boards)
        else:
            things = frozenset((*state.world.movers.values(), *state.world.hazards.values()))
            blind, _ = perceive(state.world.without(things), late, 0, state.belief)
            assert (seen.right, seen.left, seen.boards) == (blind.right, blind.left, blind.boards)
            differs += seen.movers.keys() != at_once.movers.keys()
        state, prompt_belief = step(state).state, prompt
        if state.world.outcome is not Outcome.RUNNING:
            break
    assert differs


def test_latency_is_nothing_to_the_perfect_sensor_and_nothing_for_a_batch() -> None:
    assert drive_digests(Config(seed=3, sensor_latency=1)) == drive_digests(Config(seed=3))
    with pytest.raises(ValueError, match="late"):
        Batch([Config(sensor="lidar", sensor_latency=1)])
    with pytest.raises(ConfigError):
        Config(sensor_latency=2)


def drive_digests(config: Config) -> list[str]:
    """Of every tick of the first episode."""
    state, found = SimState.start(config), []
    while state.world.outcome is Outcome.RUNNING:
        found.append(state.world.digest())
        state = step(state).state
    return found
