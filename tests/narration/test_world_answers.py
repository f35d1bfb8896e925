"""Answers about this world and about sensing: each figure is that of the setting, the advice or the table."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest
import yaml

from service.actions import Ask
from service.narration import Narrator
from service.resources import prompts_folder
from service.sessions.facts import Asked
from sim.config import Config
from sim.hazard_advice import advise
from sim.session.timeline import Timeline
from sim.types import Kind, Outcome

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
YES_NO = {"en": ("Yes", "No"), "de": ("Ja", "Nein")}


def driven(ticks: int, **parts: object) -> Timeline:
    timeline = Timeline(Config().with_parts(**parts))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def answer(timeline: Timeline, what: str, code: str = "en", supposes: str | None = None) -> dict[str, Any]:
    about: Any = "sight" if what in ("phantoms", "missed", "truth", "range", "blind", "weather") else "world"
    ask: Any = Ask(about=about, what=what)  # type: ignore[arg-type]
    return NARRATORS[code].answer(Asked(ask, timeline, supposes))


def test_the_pace_is_a_cell_a_tick() -> None:
    told = answer(driven(0, cell_m=4.0, step_seconds=0.25), "pace")
    assert "4 m in 0.25 s, which is 57.6 km/h" in told["text"]
    assert told["speed_kmh"] == pytest.approx(4.0 / 0.25 * 3.6)


def test_the_stopping_distance_is_that_of_the_advice_for_the_speed_and_the_weather() -> None:
    for weather, surface in (("clear", "dry"), ("rain", "wet"), ("snow", "snow")):
        told = answer(driven(0, weather=weather), "stopping")
        figures = advise(Kind.BARRIER, 500.0, 36.0, weather).figures  # type: ignore[arg-type]
        assert (told["stopping_m"], told["stopping_most_m"]) == (figures.stopping_m, figures.stopping_most_m)
        assert surface in told["text"]
        assert f"{figures.stopping_m:.0f} m" in told["text"]
        assert f"{figures.stopping_most_m:.0f} m" in told["text"]


def test_the_gap_is_the_setting_and_says_whether_it_counts() -> None:
    weighed, heedless = (driven(0, safety_buffer=2, planner=planner) for planner in ("astar", "priority"))
    assert answer(weighed, "gap")["heeded"]
    assert "2 cells of distance (10 m)" in answer(weighed, "gap")["text"]
    assert not answer(heedless, "gap")["heeded"]
    assert not answer(driven(0, safety_buffer=0, planner="astar"), "gap")["heeded"]


def test_the_nearest_thing_is_the_nearest_one_seen() -> None:
    timeline = driven(5, seed=2)
    world = timeline.state.world
    column, row = world.road.cell(world.av)
    near = min(max(abs(thing.cell[0] - column), abs(thing.cell[1] - row)) for thing in world.things())
    found = world.find(answer(timeline, "gap")["nearest"])
    assert found is not None
    assert max(abs(found.cell[0] - column), abs(found.cell[1] - row)) == near


def test_right_of_way_tells_what_others_are_set_to_do() -> None:
    told = answer(driven(0, attentive=0.9, courtesy=0.0), "right_of_way")["text"]
    assert "90 %" in told
    assert "nobody gives way" in told
    assert "Nobody brakes" in answer(driven(0, attentive=0.0, courtesy=0.25), "right_of_way")["text"]


def test_who_was_hit_and_how_fast_is_the_crash_itself() -> None:
    kinds = set()
    for seed in range(60):
        timeline = driven(
            40, seed=seed, columns=6, rows=14, potholes=20, vehicles=8, pedestrians=8, planner="priority",
            attentive=0.0,
        )  # fmt: skip
        told = answer(timeline, "harm")
        if timeline.state.world.outcome is not Outcome.CRASH:
            assert told["crash"] is None
            assert told["text"].startswith("No:")
            continue
        world, crash = timeline.state.world, told["crash"]
        decision = timeline.decision(timeline.tick - 1)
        assert world.cause is not None
        assert decision is not None
        assert (crash["kind"], crash["tick"]) == (world.cause.kind, timeline.tick)
        assert crash["speed_kmh"] == pytest.approx(36.0 * math.hypot(*decision.move.offset), abs=0.06)
        assert (crash["death_risk"] is not None) == (world.cause.kind is Kind.PEDESTRIAN)
        assert "not simulated" in told["text"]
        kinds.add(world.cause.kind)
    assert {Kind.VEHICLE, Kind.PEDESTRIAN} <= kinds


@pytest.mark.parametrize("code", NARRATORS)
def test_random_and_again_are_opposite_questions(code: str) -> None:
    yes, no = YES_NO[code]
    timeline = driven(6, seed=77)
    again, drawn = answer(timeline, "chance", code), answer(timeline, "chance", code, "contrary")
    assert again["text"].startswith(yes)
    assert drawn["text"].startswith(no)
    assert "77" in again["text"]
    assert again["evidence"] == {"ticks": 6, "same": True, "run": True}


@pytest.mark.parametrize("code", NARRATORS)
def test_the_legend_has_the_marks_of_the_page(code: str) -> None:
    page = yaml.safe_load((prompts_folder() / "interface" / code / "page.yaml").read_text("utf-8"))
    told = answer(driven(0), "colours", code)
    assert told["marks"] == page["settings"]["marks"]
    assert all(meaning in told["text"] for meaning in page["settings"]["marks"].values())


def test_another_weather_than_the_one_there_is_denied() -> None:
    timeline = driven(4, seed=1, weather="rain", sensor="camera")
    assert answer(timeline, "weather", supposes="fog")["text"] == "No: there is no fog; the weather is rain."
    assert answer(driven(4, seed=1), "weather", supposes="fog")["text"] == "No: the weather is clear."
    assert "rain" in answer(timeline, "weather", supposes="rain")["text"]


def test_the_range_is_told_in_metres_and_cells() -> None:
    told = answer(driven(0, sensor="camera", weather="fog"), "range")
    assert (told["range_m"], told["range_cells"]) == (33.0, 6)
    assert re.search(r"^Up to 33 m, which is 6 cells \(", told["text"])
    assert "150 m" in answer(driven(0), "range")["text"]


def test_what_is_missed_is_counted_against_what_is_there() -> None:
    timeline = driven(6, seed=5, sensor="camera", weather="fog", potholes=20, vehicles=30)
    told = answer(timeline, "missed")
    assert len(told["missed"]) > 3
    assert f"I do not detect {len(told['missed'])}" in told["text"]
    assert told["things"] == sum(timeline.state.world.counts().values())
