"""Facts of the world, of planners and of sensing: each answer says what the session's configuration is."""

from __future__ import annotations

import pytest

from service.actions.questions import SightName, WorldName
from service.narration.answers import FACTS_OF_PLANNERS, FACTS_OF_THE_WORLD
from sim.perceive.parameters import SUITES
from sim.search.costs import weights
from sim.types import Outcome
from tests.narration.test_course import NARRATORS, answer, driven

SESSIONS = (
    {"seed": 1},
    {"seed": 2, "sensor": "camera", "weather": "snow", "slip_probability": 0.2, "planner": "astar"},
    {"seed": 3, "planner": "priority", "collision": "cell", "layout": "maze", "attentive": 0.5},
    {"seed": 4, "planner": "bfs", "sensor": "fusion", "vehicles": 12, "pedestrians": 3, "attentive": 0.0},
    {"seed": 5, "planner": "dijkstra", "preferences": ("cautious", "smooth_ride"), "sensor": "radar"},
)
FACTS: tuple[tuple[str, WorldName | SightName | str], ...] = (
    *(("world", what) for what in FACTS_OF_THE_WORLD),
    *(("planners", what) for what in FACTS_OF_PLANNERS),
    *(("sight", what) for what in ("memory", "unseen", "combining")),
)


@pytest.mark.parametrize("code", NARRATORS)
def test_facts_are_told_shortly_in_whole_sentences(code: str) -> None:
    timelines = [driven(2, **values) for values in SESSIONS]
    for about, what in FACTS:
        for timeline in timelines:
            told = answer(timeline, about, what, code)
            assert told["what"] == what
            assert told["text"].endswith("."), told["text"]
            assert 10 < len(told["text"].split()) <= 60, told["text"]
            assert "{" not in told["text"] + told["question"]


def test_who_brakes_is_said_where_somebody_does() -> None:
    assert "100 %" in answer(driven(0), "world", "tick_order")["text"]
    assert "50 %" in answer(driven(0, attentive=0.5), "world", "tick_order")["text"]
    assert "%" not in answer(driven(0, attentive=0.0), "world", "tick_order")["text"]


def test_the_road_is_slippery_on_snow_with_a_chance_alone() -> None:
    told = {
        (weather, chance): answer(driven(0, weather=weather, slip_probability=chance), "world", "slippery")[
            "text"
        ]
        for weather in ("snow", "rain")
        for chance in (0.0, 0.25)
    }
    assert [key for key, text in told.items() if text.startswith("Yes")] == [("snow", 0.25)]
    assert all("25 %" in text for (_, chance), text in told.items() if chance)


def test_what_touches_is_what_this_session_judges_by() -> None:
    swept, cells = (answer(driven(0, collision=each), "world", "contact") for each in ("swept", "cell"))
    assert "Any touch" in swept["text"]
    assert "Cells alone" in cells["text"]


def test_an_end_is_not_driven_on_from() -> None:
    timeline = driven(400, seed=1, reset_delay_s=1.0)
    assert timeline.state.world.outcome is not Outcome.RUNNING
    told = answer(timeline, "world", "endings")
    assert told["delay_ticks"] == 2
    assert "1 s later" in told["text"]


def test_a_road_is_told_by_what_it_is_drawn_from() -> None:
    exact = answer(driven(0, seed=7, vehicles=12, potholes=0), "world", "road_made")["text"]
    assert "seed, here 7" in exact
    assert "12 cars" in exact
    assert "pothole" not in exact
    assert "68 %" in answer(driven(0), "world", "road_made")["text"]
    assert "maze" in answer(driven(0, layout="maze"), "world", "road_made")["text"]


def test_planners_are_told_apart_by_how_they_decide() -> None:
    timeline = driven(0)
    manners = {
        name: answer(timeline, "planners", "lookahead", planner=name)["manner"]
        for name in ("rules", "priority", "astar", "dijkstra", "bfs")
    }
    assert manners == {
        "rules": "rules",
        "priority": "priority",
        "astar": "costs",
        "dijkstra": "costs",
        "bfs": "time",
    }
    assert answer(timeline, "planners", "lookahead")["planner"] == "rules"
    assert "300 ticks" in answer(timeline, "planners", "lookahead", planner="astar")["text"]
    unknown = answer(timeline, "planners", "ties", planner="patient")
    assert "do not know" in unknown["text"]


def test_costs_are_those_that_the_search_charges() -> None:
    timeline = driven(0, planner="astar", preferences=("smooth_ride",))
    charges, found = answer(timeline, "planners", "costs")["charges"], weights(timeline.state.config)
    assert charges["sideways"] == found.sideways
    assert charges["tick"] == found.tick
    assert "doubt" not in charges
    assert "doubt" in answer(driven(0, planner="astar", sensor="camera"), "planners", "costs")["charges"]
    assert "mover_far" in answer(driven(0, planner="astar", safety_buffer=2), "planners", "costs")["charges"]
    assert answer(driven(0, planner="bfs"), "planners", "costs")["charges"] is None


def test_others_are_known_only_to_a_perfect_sensor() -> None:
    assert answer(driven(0), "planners", "prediction")["faithful"]
    assert answer(driven(0, sensor="lidar"), "planners", "prediction")["text"].startswith("No")
    by_chance = driven(0, planner="astar", attentive=0.5)
    assert "left to chance" in answer(by_chance, "planners", "prediction")["text"]


def test_what_is_heeded_is_by_the_sensitivity_of_the_session() -> None:
    told = answer(driven(0, sensor="radar", detection_sensitivity=0.3), "sight", "unseen")
    assert told["threshold"] == pytest.approx(0.7)
    assert "70 %" in told["text"]
    assert not answer(driven(0), "sight", "memory")["remembers"]
    assert answer(driven(0, sensor="radar"), "sight", "memory")["remembers"]


@pytest.mark.parametrize("code", NARRATORS)
def test_detection_is_told_for_every_sensor_and_falls_with_distance(code: str) -> None:
    told = answer(driven(0), "sight", "detection", code, kind="pedestrian")
    assert set(told["chances"]) == set(SUITES)
    assert all(near > far for near, far in told["chances"].values())
    holes = answer(driven(0), "sight", "detection", code, kind="pothole")
    assert holes["chances"]["radar"][0] < 0.01
    assert "100 %" not in told["text"]
