"""One sensor at work, rows ahead, keys and counting: each figure against its own count or table."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from service.actions import Ask
from service.sessions.facts import Asked
from sim.config import Config
from sim.decide import sense
from sim.explain.cell_belief import unknown_cells
from sim.explain.search_effort import search_effort
from sim.explain.would_see import would_see
from sim.forecast import predict
from sim.perceive.detection import detection_chance
from sim.perceive.grid_sensor import looks
from sim.perceive.parameters import SUITES
from sim.search.costs import weights
from sim.search.time_expanded import TimeExpandedGraph
from sim.session.timeline import Timeline
from sim.types import Kind, Mode, Move, Outcome
from tests.narration.test_course import NARRATORS, driven

KEYS = Path(__file__).parents[2] / "web" / "src" / "road" / "drivingKeys.js"
COMMANDS = Path(__file__).parents[2] / "web" / "src" / "core" / "commands.js"


def asked(timeline: Timeline, supposes: str | None = None, code: str = "en", **parts: Any) -> dict[str, Any]:
    found: dict[str, Any] = NARRATORS[code].answer(Asked(Ask(**parts), timeline, supposes))
    return found


@pytest.mark.parametrize("sensor", ["camera", "lidar", "radar", "fusion"])
@pytest.mark.parametrize("weather", ["rain", "fog", "snow"])
def test_the_effect_of_a_weather_is_the_difference_to_clear_weather(sensor: str, weather: str) -> None:
    timeline = driven(0, sensor=sensor, weather="clear")
    told = asked(timeline, weather, about="sight", what="effect")
    config = timeline.state.config
    for kind in Kind:
        if kind is Kind.AV:
            continue
        for key, named in (("with", weather), ("without", "clear")):
            there = replace(config, weather=named)  # type: ignore[arg-type]
            found = told["half_detected_cells"][key][kind.value]
            if found:
                assert (detection_chance(there, kind, found * config.cell_m) or 0.0) >= 0.5
            beyond = detection_chance(there, kind, (found + 1) * config.cell_m) or 0.0
            assert beyond < 0.5
    assert told["text"].startswith("It is not so at present." if told["changes"] else "It is not so")


def test_errors_count_ticks_by_what_is_seen_and_what_is_there() -> None:
    timeline = driven(12, seed=5, sensor="radar", weather="rain")
    right = imagined = 0
    for state in timeline.between(0, timeline.tick + 1):
        seen = {(each.kind, each.cell, each.id) for each in sense(state)[0].things()}
        there = {(each.kind, each.cell, each.id) for each in state.world.things()}
        imagined += bool(seen - there)
        right += seen == there
    told = asked(timeline, "agree", about="sight", what="errors")
    assert told["imagined"] == imagined
    assert told["right"] >= right  # out of reach nothing has to be seen
    assert told["ticks"] == timeline.tick + 1
    assert 0 <= told["seen_in_reach"] <= told["things_in_reach"]
    perfect = asked(driven(3), "agree", about="sight", what="errors")
    assert (perfect["right"], perfect["missed"]) == (4, 0)


def test_a_cell_that_is_shown_as_taken_is_not_said_to_be_surely_empty() -> None:
    for seed in range(12):
        timeline = driven(6, seed=seed, sensor="fusion", weather="fog", vehicles=40)
        if timeline.state.world.outcome is not Outcome.RUNNING:
            continue
        threshold = 1.0 - timeline.state.config.detection_sensitivity
        for move in Move:
            if move is Move.STAY:
                continue
            told = asked(timeline, about="sight", what="cell", move=move)
            if told["cell"] is None:
                continue
            shown = {each.cell for each in sense(timeline.state)[0].things()}
            assert (tuple(told["cell"]) in shown) is (told["shown"] is not None)
            assert 0.0 <= told["taken"] <= 1.0
            if told["shown"] is not None:
                assert told["taken"] >= threshold - 1e-9


def test_unknown_cells_are_those_in_no_look() -> None:
    timeline = driven(4, seed=3, sensor="camera", weather="fog")
    state = timeline.state
    found = unknown_cells(state)
    assert found is not None
    road, row = state.world.road, state.world.road.cell(state.world.av)[1]
    seen = {
        cell
        for each in looks(state.world, state.config, 0, SUITES["camera"])
        for cell in range(road.columns * road.rows)
        if each.visible >> cell & 1
    }
    cells = {cell for cell in range((row + 1) * road.columns) if cell != state.world.av}
    assert found.cells == len(cells)
    assert found.beyond + found.unseen == len(cells - seen)


def test_another_sensor_sees_the_nearest_thing_as_its_table_says() -> None:
    timeline = driven(5, seed=2)
    found = would_see(timeline.state, "camera", Kind.VEHICLE)
    assert found is not None
    assert found.chance is not None
    world = timeline.state.world
    column, row = world.road.cell(world.av)
    ahead = [
        (each.cell[0] - column) ** 2 + (each.cell[1] - row) ** 2
        for each in world.things()
        if each.kind is Kind.VEHICLE and each.cell[1] <= row
    ]
    distance = (found.thing.cell[0] - column) ** 2 + (found.thing.cell[1] - row) ** 2
    assert distance == min(ahead)
    if found.in_view:
        config = replace(timeline.state.config, sensor="camera")
        chance = detection_chance(config, Kind.VEHICLE, distance**0.5 * config.cell_m)
        assert found.chance == pytest.approx(chance)


def test_the_heuristic_is_what_the_search_is_bounded_by() -> None:
    timeline = driven(3, seed=3, planner="astar")
    told = asked(timeline, about="planners", what="heuristic")
    config = timeline.state.config
    forecast = predict(sense(timeline.state)[0], 2)
    terrain = TimeExpandedGraph(forecast, weights(config), 1)
    assert terrain.heuristic(forecast.road.columns) == told["least"]
    assert asked(timeline, about="planners", what="heuristic", planner="dijkstra")["least"] is None


def test_the_effort_is_counted_where_a_search_is_made() -> None:
    timeline = driven(3, seed=3, planner="astar")
    told = asked(timeline, about="planners", what="effort")
    assert told["expanded"] == search_effort(timeline.state).expanded > 0
    assert str(told["expanded"]) in told["text"]
    assert asked(timeline, about="planners", what="effort", planner="rules")["expanded"] is None


def test_the_emptiest_lanes_hold_the_fewest_things() -> None:
    for seed in range(8):
        timeline = driven(5, seed=seed, vehicles=30)
        world = timeline.state.world
        row = world.road.cell(world.av)[1]
        counts = [
            sum(
                each.cell[0] == lane and each.cell[1] <= row
                for each in world.things()
                if each.kind is not Kind.AV
            )
            for lane in range(world.road.columns)
        ]
        told = asked(timeline, "lanes emptiest", about="scene")["text"].partition(",")[0]
        least = [str(lane + 1) for lane, count in enumerate(counts) if count == min(counts)]
        assert (
            re.findall(r"\d+", asked(timeline, "lanes emptiest", about="scene")["text"])[: len(least)]
            == least
        )
        assert told.startswith("Emptiest: lane")


def test_gaps_are_the_lanes_in_which_nothing_of_the_row_is() -> None:
    for seed in range(8):
        timeline = driven(2, seed=seed, barriers=12)
        world = timeline.state.world
        row = world.road.cell(world.av)[1]
        rows: dict[int, set[int]] = {}
        for each in world.things():
            if each.kind is Kind.BARRIER and each.cell[1] < row:
                rows.setdefault(row - each.cell[1], set()).add(each.cell[0])
        several = [ahead for ahead, lanes in rows.items() if len(lanes) > 1]
        if not several:
            continue
        there = {each.cell[0] + 1 for each in world.things() if row - each.cell[1] == min(several)}
        free = [str(lane) for lane in range(1, world.road.columns + 1) if lane not in there]
        text = asked(timeline, "row gap", about="scene", kind="barrier")["text"]
        assert re.findall(r"\d+", text.partition(" in lane")[2]) == free


def test_the_keys_that_are_told_drive_on_the_page() -> None:
    keys = KEYS.read_text()
    for key, move in (
        ("ArrowUp", "forward"),
        ("ArrowLeft", "left"),
        ("ArrowRight", "right"),
        ("ArrowDown", "stay"),
    ):
        assert f'{key}: "{move}"' in keys
    assert 's: "stay"' in keys
    assert 'key: " "' in COMMANDS.read_text()
    timeline = driven(1)
    assert "space bar" in asked(timeline, "space", about="world", what="keys")["text"]
    assert timeline.state.mode is not Mode.MANUAL


def test_figures_count_every_end_and_stuck_is_no_success() -> None:
    timeline = driven(400, seed=3, planner="astar")
    metrics = timeline.state.metrics
    told = asked(timeline, "stuck", about="world", what="counting")
    assert told["text"].startswith("Yes.")
    assert (told["successes"], told["crashes"], told["stuck"]) == (
        metrics.successes,
        metrics.crashes,
        metrics.stuck,
    )


def test_the_way_at_the_start_is_that_of_the_first_tick() -> None:
    timeline = driven(20, seed=3, planner="priority")
    first = driven(0, seed=3, planner="priority")
    told = asked(timeline, "start", about="outlook", what="way")["text"]
    assert told == f"At tick 0: {asked(first, about='outlook', what='way')['text']}"


def test_radar_hardly_sees_a_pothole_as_is_said_of_it() -> None:
    assert 0.0 < (detection_chance(Config(sensor="radar"), Kind.POTHOLE, 5.0) or 0.0) < 0.05
    assert "radar hardly sees it" in asked(driven(0), about="world", what="obstacles")["text"]
