"""A drive as a whole, rules of the world, sensors beside one another: answers against their own facts."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from service.actions import Ask
from service.narration.choices import MOST_LOSSES
from service.narration.narrator import Narrator
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.losses import losses
from sim.explain.sensing import reach
from sim.explain.waits import waits
from sim.session.timeline import Timeline
from sim.types import Kind, Outcome

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
CRASH = {"potholes": 18, "vehicles": 40, "pedestrians": 6, "barriers": 8, "attentive": 0.0}


def driven(ticks: int, **values: Any) -> Timeline:
    timeline = Timeline(Config(**values))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def answer(timeline: Timeline, about: Any, what: Any, code: str = "en", **more: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(about=about, what=what, **more), timeline))


def crashed() -> Timeline:
    runs = (driven(60, seed=seed, planner="priority", **CRASH) for seed in range(40))
    return next(run for run in runs if run.state.world.outcome is Outcome.CRASH)


def test_lane_changes_are_counted_by_side() -> None:
    for seed in range(6):
        timeline = driven(20, seed=seed, potholes=25, planner="astar")
        told = answer(timeline, "history", "lane_changes")
        sides = [each["side"] for each in told["lane_changes"]]
        if len(sides) > 1:
            assert (
                f"{sides.count('left')} to the left and {sides.count('right')} to the right" in told["text"]
            )
        elif not sides:
            assert told["text"].startswith("Not once")
    assert "Nothing has been driven" in answer(driven(0, seed=1), "history", "lane_changes")["text"]


def test_what_was_passed_is_told_by_kind() -> None:
    timeline = driven(18, seed=4, potholes=12, vehicles=10, pedestrians=8, planner="astar")
    told = answer(timeline, "history", "passed", kind="pedestrian")
    count = len(told["passed"]["pedestrian"])
    assert told["text"].startswith(f"{count} pedestrian" if count else "None")
    every = answer(timeline, "history", "passed")
    assert f"{len(every['passed']['vehicle'])} cars" in every["text"]


def test_the_verdict_is_made_of_what_the_drive_was() -> None:
    seen = set()
    for seed in range(8):
        timeline = driven(60, seed=seed, potholes=25, vehicles=8, planner="priority")
        told = answer(timeline, "history", "verdict")
        assert told["outcome"] is timeline.state.world.outcome
        assert told["waited"] == waits(timeline).total
        if told["lost"] is not None:
            assert told["lost"] == losses(timeline).ticks
        if told["outcome"] in (Outcome.CRASH, Outcome.STUCK):
            assert told["text"].startswith("Badly")
        seen.add(told["outcome"])
    assert len(seen) > 1
    assert "crashed" in answer(crashed(), "history", "verdict")["text"]


@pytest.mark.parametrize("code", NARRATORS)
def test_of_a_person_is_said_only_what_is_known(code: str) -> None:
    unknown = {"en": "I cannot say", "de": "kann ich nicht sagen"}[code]
    timeline = crashed()
    told, avoidable = (answer(timeline, "blame", what, code) for what in ("human", "avoidable"))
    assert unknown in told["text"]
    assert told["text"].endswith(avoidable["text"])
    driving = answer(driven(3, seed=1), "blame", "human", code)
    assert unknown in driving["text"]
    assert {"en": "compare the planners", "de": "vergleiche die Planer"}[code] in driving["text"]


def test_how_planners_differ_is_what_each_does() -> None:
    timeline = driven(0, seed=1, planner="rules")
    told = answer(timeline, "planners", "difference", planners=("bfs", "priority"))
    assert list(told["planners"]) == ["bfs", "priority"]
    assert "fewest ticks" in told["text"]
    assert "first free move" in told["text"]
    alone = answer(timeline, "planners", "difference", planners=("bfs",))
    assert list(alone["planners"]) == ["bfs", "rules"]
    same = answer(timeline, "planners", "difference", planners=("rules",))
    assert "is the one that drives" in same["text"]


def test_sensors_and_weathers_are_compared_by_the_tables_of_the_sensors() -> None:
    state = driven(0, seed=1, sensor="camera", weather="fog").state
    told = answer(driven(0, seed=1, sensor="camera", weather="fog"), "sight", "weathers")
    weathers: tuple[tuple[Any, str], ...] = (("clear", "clear"), ("fog", "fog"), ("snow", "snow"))
    for weather, name in weathers:
        found = reach(replace(state.config, weather=weather))
        assert found is not None
        assert told["half_detected_m"][name] == found.half[Kind.VEHICLE] * state.config.cell_m
    assert told["text"].endswith("Worst: fog.")
    best = answer(driven(0, seed=1, sensor="camera", weather="fog"), "sight", "sensors")
    assert best["half_detected_m"]["radar"] == max(best["half_detected_m"].values())
    assert "perfect" in answer(driven(0, seed=1), "sight", "weathers")["text"]


def test_driving_does_not_change_with_the_weather_but_what_is_seen_does() -> None:
    told = answer(driven(0, seed=1, sensor="camera", weather="fog"), "sight", "care")
    assert told["text"].startswith("No:")
    assert told["half_detected_m"] < told["half_detected_clear_m"]
    assert f"{told['half_detected_m']:g} m" in told["text"]
    snow = answer(driven(0, seed=1, weather="snow", slip_probability=0.25), "sight", "care")
    assert "25 %" in snow["text"]


def test_a_person_weighs_as_much_as_a_car() -> None:
    weighs = {name: answer(driven(0, planner=name), "world", "weights") for name in ("astar", "bfs", "rules")}
    assert [each["weighs_nearness"] for each in weighs.values()] == [True, False, False]
    assert "as much as to a car" in weighs["astar"]["text"]
    assert "nothing but time" in weighs["bfs"]["text"]
    assert "order" in weighs["rules"]["text"]


def test_rules_of_the_world_are_those_of_the_settings() -> None:
    timeline = driven(5, seed=1, attentive=0.5, courtesy=0.25)
    assert "50 %" in answer(timeline, "world", "movers")["text"]
    assert "25 %" in answer(timeline, "world", "movers")["text"]
    given_up = answer(timeline, "world", "giving_up")
    assert (given_up["limit"], given_up["left"]) == (300, 295)
    assert "295" in given_up["text"]
    assert len(answer(timeline, "world", "moves")["moves"]) == 6
    assert "let me drive" in answer(timeline, "world", "by_hand")["text"]
    assert not answer(timeline, "world", "by_hand")["by_hand"]


@pytest.mark.parametrize("what", ["learning", "nature", "sources"])
@pytest.mark.parametrize("code", NARRATORS)
def test_what_i_am_is_told_in_sentences(what: str, code: str) -> None:
    told = answer(driven(0), "world", what, code)
    assert told["text"].endswith(".")
    assert len(told["text"].split()) > 15


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("what", ["lane_changes", "verdict"])
def test_one_clock_is_read_in_an_answer(code: str, what: str) -> None:
    told = [answer(driven(20, seed=seed, potholes=25), "history", what, code)["text"] for seed in range(4)]
    assert all(" s" in text for text in told)
    assert [text for text in told if "tick" in text.lower()] == []


def test_the_moves_told_are_most_of_the_time_lost_only_where_they_are() -> None:
    said = set()
    for seed in range(30):
        planner = ("rules", "priority")[seed % 2]
        timeline = driven(60, seed=seed, potholes=(10, 25)[seed % 4 > 1], vehicles=20, planner=planner)
        found = losses(timeline)
        dear = [loss.ticks for loss in found.found if loss.ticks is not None]
        text = answer(timeline, "history", "losses")["text"]
        if len(dear) > MOST_LOSSES:
            most = 2 * sum(dear[:MOST_LOSSES]) > found.ticks
            assert ("most of it here" in text) is most, text
            assert (f"at {len(dear)} moves" in text) is not most, text
            said.add(most)
    assert said == {True, False}
