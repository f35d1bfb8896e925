"""The belief: log odds, the prediction of movers, the weighing of looks, and how well it is calibrated."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import pytest

from sim.config import Config
from sim.decide import sense
from sim.perceive import perceive
from sim.perceive.bayes_filter import predict_layers, update_layers
from sim.perceive.belief import LAYER, RIGHT, GridBelief, density, prior, probabilities
from sim.perceive.log_odds import LIMIT, PROBABILITY, log_odds
from sim.perceive.look import Look, Report
from sim.perceive.parameters import FORGETTING, LIDAR
from sim.perceive.sensor_model import sensor_model
from sim.state import SimState
from sim.transition import step
from sim.types import Kind, Outcome
from tests.support.roads import road, run_on
from tools.sensor_calibration import bins_of, error

OPEN = road(*["......"] * 6, "..A...", "......")


def test_log_odds_and_back() -> None:
    for value in range(-LIMIT, LIMIT + 1, 7):
        assert log_odds(PROBABILITY[value + LIMIT]) == value
    assert (log_odds(0.0), log_odds(0.5), log_odds(1.0)) == (-LIMIT, 0, LIMIT)


def test_before_any_look_a_road_is_believed_to_be_like_most() -> None:
    config = Config(potholes=28, vehicles=14, pedestrians=0, barriers=0)
    believed = probabilities(prior(config, config.geometry))
    assert believed[LAYER[Kind.POTHOLE], 5, 3] == pytest.approx(28 / 224, abs=0.001)
    assert believed[RIGHT[Kind.VEHICLE], 5, 3] == pytest.approx(14 / 224 / 2, abs=0.001)
    assert believed[:, 0].max() < 0.003 > believed[:, -1].max()
    assert density(config, Kind.BARRIER) > 0.0, "people put things where no draw would"


@pytest.mark.parametrize("reported", [True, False])
def test_one_look_at_a_pothole_is_bayes_theorem(reported: bool) -> None:
    config = run_on(OPEN, potholes=4).config
    model = sensor_model(LIDAR, "clear", "day", config.cell_m, 6)
    layers, cell = prior(config, OPEN.road).copy(), OPEN.road.index((2, 4))
    before = probabilities(layers)[LAYER[Kind.POTHOLE], 4, 2]
    reports = (Report(Kind.POTHOLE, cell, None, "pothole-1"),) if reported else ()
    update_layers(layers, Look(model, OPEN.road.all, reports), 6, 2)
    seen = model.kinds[Kind.POTHOLE]
    hit, alarm = seen.detection[2][5], seen.false_alarm
    there = hit + (1 - hit) * alarm if reported else (1 - hit) * (1 - alarm)
    free = alarm if reported else 1 - alarm
    wanted = before * there / (before * there + (1 - before) * free)
    if not reported:  # a report of another thing in this cell is left out of a miss
        wanted = before * (1 - hit) / (before * (1 - hit) + (1 - before) * (1 - alarm))
    assert probabilities(layers)[LAYER[Kind.POTHOLE], 4, 2] == pytest.approx(wanted, abs=0.01)


def test_a_hidden_cell_keeps_its_belief() -> None:
    config = run_on(OPEN, potholes=4).config
    model = sensor_model(LIDAR, "clear", "day", config.cell_m, 6)
    layers = prior(config, OPEN.road).copy()
    hidden = OPEN.road.index((2, 3))
    update_layers(layers, Look(model, OPEN.road.all & ~(1 << hidden), ()), 6, 2)
    changed = layers != prior(config, OPEN.road)
    assert not changed[:, 3, 2].any()
    assert changed[:, 3, 1].any()


@pytest.mark.parametrize("sensor", ["camera", "lidar", "radar", "fusion"])
def test_a_vehicle_that_was_seen_is_expected_where_it_drives(sensor: str) -> None:
    """Nothing is reported of it any more, and it is followed by the rule, turning at the edge."""
    start = road("......", "......", "...>..", "..A...", "......", "......")
    state = run_on(start, sensor=sensor)
    belief: object = None
    for episode in count(1):  # a draw in which it is detected
        percept, belief = perceive(replace(state.world, episode=episode), state.config, 0, None)
        seen = percept.find("vehicle-1")
        if seen is not None and seen.heading == "right":
            break
    world, places = state.world, []
    for _ in range(3):
        assert isinstance(belief, GridBelief)
        layers, followed = predict_layers(belief, world, state.config)
        (cell,) = [cell for cell, name in followed.items() if name == "vehicle-1"]
        column, row = world.road.cell(cell)
        places.append((column, row))
        likely = probabilities(layers)[RIGHT[Kind.VEHICLE] : RIGHT[Kind.VEHICLE] + 2, row, column]
        assert 0.75 < likely.max() < 1.0 - FORGETTING / 2
        ahead = [cell for cell, _ in belief.movers if _ == "vehicle-1"]
        heads_left = belief.left >> ahead[0] & 1
        belief = replace(
            belief,
            layers=layers.astype("<i2").tobytes(),
            movers=tuple(followed.items()),
            right=0 if column == 5 or heads_left else 1 << cell,
            left=1 << cell if column == 5 or heads_left else 0,
            episode_tick=belief.episode_tick + 1,
        )
    assert places[:2] == [(4, 2), (5, 2)]


def test_a_phantom_has_a_name_of_its_own_and_keeps_it() -> None:
    names: set[str] = set()
    for seed in range(40):
        state, shown = SimState.start(Config(seed=seed, sensor="radar", potholes=10)), {}
        while state.world.outcome is Outcome.RUNNING and state.world.tick < 12:
            percept = sense(state)[0]
            real = {thing.id for thing in state.world.things()}
            for thing in percept.things():
                if thing.id not in real:
                    assert thing.id.rpartition("-")[2].startswith("p")
                    if not thing.kind.moves:
                        assert shown.setdefault(thing.id, thing.cell) == thing.cell
                    names.add(thing.id)
                assert 0.5 <= percept.likelihoods[thing.id] <= 1.0
            assert len(list(percept.things())) == len({thing.id for thing in percept.things()})
            state = step(state).state
    assert len(names) > 5


def test_a_more_sensitive_vehicle_heeds_all_that_a_less_sensitive_one_does() -> None:
    more = less = 0
    for seed in range(15):
        state = SimState.start(Config(seed=seed, sensor="camera", weather="snow", potholes=15))
        for _ in range(8):
            cells = []
            for sensitivity in (0.3, 0.8):
                config = state.config.with_parts(detection_sensitivity=sensitivity)
                percept = perceive(state.world, config, 0, state.belief)[0]
                cells.append(percept.boards.fixed | percept.right | percept.left)
            assert cells[0] & ~cells[1] == 0
            less += cells[0].bit_count()
            more += cells[1].bit_count()
            state = step(state).state
    assert more > less


@pytest.mark.parametrize("sensor", ["camera", "lidar", "radar", "fusion"])
def test_of_what_is_believed_at_p_about_p_is_there(sensor: str) -> None:
    found = bins_of(sensor, "rain", "day", 15_000)
    assert error(found) <= 0.03
    assert found[-1, 0] > 300, "something is believed"
