"""Camera, lidar, radar and fusion: what they see, how often, and that all of it replays."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import get_args

import pytest

from sim.actions import Set, TimeOfDay, Weather
from sim.config import Config
from sim.decide import sense
from sim.perceive import NO_BELIEF, perceive
from sim.perceive.detection import detection_probability
from sim.perceive.grid_sensor import looks
from sim.perceive.look import Look
from sim.perceive.parameters import SUITES
from sim.perceive.sensor_model import sensor_model
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.statistics import wilson
from sim.transition import step
from sim.types import Kind, Outcome
from sim.world import World
from tests.support.roads import road, run_on

BUILT_IN = tuple(SUITES)
WEATHERS: tuple[Weather, ...] = get_args(Weather)
LIGHTS: tuple[TimeOfDay, ...] = get_args(TimeOfDay)
DEVICES = [suite[0] for suite in SUITES.values() if len(suite) == 1]

BUSY = Config(seed=4, vehicles=20, potholes=20, pedestrians=4, barriers=6)


def first_looks(world: World, config: Config) -> list[Look]:
    return looks(world, config, 0, SUITES[config.sensor])


@pytest.mark.parametrize("spec", DEVICES, ids=lambda spec: spec.name)
def test_more_distance_and_worse_conditions_never_help(spec: object) -> None:
    for kind in (Kind.POTHOLE, Kind.BARRIER, Kind.VEHICLE, Kind.PEDESTRIAN):
        for weather in WEATHERS:
            for light in LIGHTS:
                seen = [detection_probability(spec, kind, weather, light, 5.0 * far) for far in range(1, 30)]  # type: ignore[arg-type]
                best = [detection_probability(spec, kind, "clear", "day", 5.0 * far) for far in range(1, 30)]  # type: ignore[arg-type]
                assert all(a >= b for a, b in pairwise(seen))
                assert all(here <= clear for here, clear in zip(seen, best, strict=True))
                assert all(0.0 <= share < 1.0 for share in seen)


@pytest.mark.parametrize("sensor", ["camera", "lidar", "radar"])
@pytest.mark.parametrize("weather", ["clear", "fog"])
def test_things_are_detected_as_often_as_the_table_says(sensor: str, weather: Weather) -> None:
    state = run_on(road(*["....."] * 2, "..#..", *["....."] * 4, "..A..", "....."))
    spec, tries, hits = SUITES[sensor][0], 1_500, 0
    for seed in range(tries):
        config = state.config.with_parts(seed=seed, sensor=sensor, weather=weather)
        (found,) = first_looks(state.world, config)
        hits += any(report.id == "barrier-1" for report in found.reports)
    low, high = wilson(hits, tries)
    wanted = detection_probability(spec, Kind.BARRIER, weather, "day", 25.0)
    margin = high - low
    assert low - margin / 2 <= wanted <= high + margin / 2


@pytest.mark.parametrize("sensor", BUILT_IN)
def test_a_look_does_not_depend_on_the_order_of_things(sensor: str) -> None:
    state = SimState.start(BUSY.with_parts(sensor=sensor))
    world = state.world
    turned = replace(
        world,
        movers=dict(reversed(world.movers.items())),
        hazards=dict(reversed(world.hazards.items())),
    )
    for one, other in zip(first_looks(world, state.config), first_looks(turned, state.config), strict=True):
        assert set(one.reports) == set(other.reports)
        assert one.visible == other.visible
    one, other = (perceive(each, state.config)[0] for each in (world, turned))
    assert list(one.things()) == list(other.things())


@pytest.mark.parametrize("sensor", BUILT_IN)
def test_taking_a_pothole_away_changes_nothing_else_that_is_reported(sensor: str) -> None:
    state = SimState.start(BUSY.with_parts(sensor=sensor))
    world = state.world
    for name in [name for name in world.hazards.values() if name.startswith("pothole")]:
        less = world.without({name})
        for one, other in zip(first_looks(world, state.config), first_looks(less, state.config), strict=True):
            assert [report for report in one.reports if report.id != name] == list(other.reports)


@pytest.mark.parametrize("sensor", BUILT_IN)
def test_nothing_is_reported_from_behind_or_out_of_view_but_what_is_displaced(sensor: str) -> None:
    state, seen = SimState.start(BUSY.with_parts(sensor=sensor)), 0
    for _ in range(15):
        world, columns = state.world, state.world.road.columns
        cells = {name: cell for table in (world.movers, world.hazards) for cell, name in table.items()}
        for look in first_looks(world, state.config):
            for report in look.reports:
                assert report.cell // columns <= world.av // columns
                if report.id is not None:
                    assert look.visible >> cells[report.id] & 1
                    seen += 1
        state = step(state).state
        if state.world.outcome is not Outcome.RUNNING:
            break
    assert seen > 30


def test_a_camera_sees_nothing_beside_itself_and_a_lidar_does() -> None:
    columns, reach = 5, {}
    for sensor in ("camera", "lidar"):
        model = sensor_model(SUITES[sensor][0], "clear", "day", 5.0, columns)
        reach[sensor] = model.view(2) >> model.reach * columns & 0b11111
    assert reach == {"camera": 0, "lidar": 0b11011}


@pytest.mark.parametrize("sensor", BUILT_IN)
def test_a_replay_sees_the_same(sensor: str) -> None:
    timeline = Timeline(BUSY.with_parts(sensor=sensor, weather="rain", time_of_day="night"))
    states = [timeline.state]
    for _ in range(45):
        timeline.advance()
        states.append(timeline.state)
    assert list(timeline.between(0, 45)) == states[:45]
    assert [timeline.at(tick) for tick in (40, 3, 21)] == [states[tick] for tick in (40, 3, 21)]
    twin = Timeline(timeline.config)
    for _ in range(45):
        twin.advance()
    assert twin.state == timeline.state
    assert sense(twin.state) == sense(timeline.state)


@pytest.mark.parametrize("sensor", BUILT_IN)
def test_undoing_a_change_of_weather_comes_back_to_the_same_states(sensor: str) -> None:
    timeline = Timeline(BUSY.with_parts(sensor=sensor))
    for _ in range(6):
        timeline.advance()
    plain = timeline.copy()
    timeline.apply(1, [Set(parameter="weather", value="snow")])
    for _ in range(6):
        timeline.advance()
        plain.advance()
    assert timeline.state.config.weather == "snow"
    assert sense(timeline.state)[0] != sense(plain.state)[0]
    timeline.rewrite((), 6)
    assert timeline.state == plain.state


@pytest.mark.parametrize("planner", ["rules", "priority", "astar", "dijkstra", "bfs"])
def test_the_perfect_sensor_sees_through_any_weather(planner: str) -> None:
    digests = []
    for weather, light in (("clear", "day"), ("snow", "night")):
        state = SimState.start(
            Config(seed=2, planner=planner, weather=weather, time_of_day=light)  # type: ignore[arg-type]
        )
        told = []
        for _ in range(25):
            state = step(state).state
            told.append(state.world.digest())
        digests.append(told)
        assert state.belief is NO_BELIEF
    assert digests[0] == digests[1]
