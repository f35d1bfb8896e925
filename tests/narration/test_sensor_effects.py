"""What limits sensors, how weather is simulated, whether a sensor is to blame: against tables and re-runs."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import comb
from typing import Any

import pytest

from service.actions import Ask
from service.narration.answers import FACTS_OF_THE_SESSION
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.sensing import reach
from sim.explain.sight_limits import sight_limits
from sim.perceive.parameters import SUITES
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.statistics import tries_to_claim
from sim.transition import step
from sim.types import Kind, Outcome
from tests.narration.test_asked_of_this_drive import failed
from tests.narration.test_course import NARRATORS, crashed, driven
from tests.support.narration_checks import looks_like_sentences

WEATHERS, LIGHTS = ("clear", "rain", "fog", "snow"), ("day", "dusk", "night", "dawn")


def asked(timeline: Timeline, what: Any, supposes: str = "", code: str = "en", **more: Any) -> dict[str, Any]:
    about: Any = "world" if what in FACTS_OF_THE_SESSION else "sight"
    found: dict[str, Any] = NARRATORS[code].answer(
        Asked(Ask(about=about, what=what, **more), timeline, supposes)
    )
    return found


def test_what_limits_more_is_what_reaches_farther_without() -> None:
    seen = set()
    for sensor in SUITES:
        for weather in WEATHERS:
            for light in LIGHTS:
                for kind in (Kind.VEHICLE, Kind.POTHOLE):
                    config = Config(sensor=sensor).with_parts(weather=weather, time_of_day=light)
                    found = sight_limits(config, kind)
                    assert found is not None
                    clear = reach(replace(config, weather="clear"))
                    day = reach(replace(config, time_of_day="day"))
                    assert clear is not None
                    assert day is not None
                    assert (found.in_clear, found.by_day) == (clear.half[kind], day.half[kind])
                    assert found.now <= min(found.in_clear, found.by_day)
                    if found.limit in ("weather", "light"):
                        assert (found.in_clear > found.by_day) is (found.limit == "weather")
                    if weather == "clear" and light == "day":
                        assert found.limit == "neither"
                    seen.add(found.limit)
    assert seen >= {"weather", "light", "neither"}
    assert sight_limits(Config()) is None


@pytest.mark.parametrize("code", NARRATORS)
def test_answers_are_short_whole_sentences(code: str) -> None:
    sessions = (
        driven(2, seed=1),
        driven(2, seed=2, sensor="camera", weather="snow", slip_probability=0.2),
        driven(2, seed=3, sensor="fusion", weather="fog", time_of_day="night"),
        crashed(),
    )
    for timeline in sessions:
        for what in ("limits", "model", "coping", "sensor_choice", "sensor_fault", *FACTS_OF_THE_SESSION):
            supposes = "95 5" if what == "runs_needed" else "fog night" if what == "limits" else ""
            told = asked(timeline, what, supposes, code)
            looks_like_sentences(told["text"])
            assert len(told["text"].split()) <= 65, told["text"]
            assert "{" not in told["text"] + told["question"]


def test_how_a_condition_is_simulated_is_the_table_of_it() -> None:
    timeline = driven(1, seed=1, sensor="camera")
    for condition in ("fog", "rain", "snow", "night", "dusk"):
        told = asked(timeline, "model", condition)
        for spec in SUITES["fusion"]:
            table: list[tuple[str, Any]] = [*spec.weather.items(), *spec.light.items()]
            effect = dict(table)[condition]
            assert told["effects"][spec.name]["reach"] == effect.reach
            assert f"{spec.name} {round(100 * effect.reach, 1):g} %" in told["text"]
    assert asked(timeline, "model")["condition"] == "fog"
    assert asked(driven(1, seed=1, weather="rain"), "model")["condition"] == "rain"


def test_a_named_device_is_told_of_in_place_of_the_own_sensor() -> None:
    timeline = driven(1, seed=1, sensor="fusion", weather="fog", time_of_day="night")
    camera = sight_limits(replace(timeline.config, sensor="camera"))
    told = asked(timeline, "limits", "fog night camera")
    assert camera is not None
    assert told["limit"] == camera.limit
    assert "camera" in told["text"]
    assert "camera" not in asked(timeline, "limits", "fog night")["text"]


def test_what_does_not_hold_is_said() -> None:
    told = asked(driven(1, seed=1, sensor="camera", weather="rain"), "limits", "fog night")
    assert told["text"].startswith("Not all of that holds now: it is the rain and daylight.")


@pytest.mark.parametrize("value", [None, "camera"])
def test_a_sensor_is_to_blame_where_the_perfect_one_arrives(value: str | None) -> None:
    timeline = failed()
    told = asked(timeline, "sensor_fault", value=value)
    state = SimState.start(timeline.config.with_parts(sensor="perfect"))
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    (again,) = told["driven_again"]
    assert (again["outcome"], again["ticks"]) == (state.world.outcome, state.world.tick)
    assert told["text"].startswith("Yes:" if state.world.outcome is Outcome.SUCCESS else "No:")


def test_a_sensor_that_was_not_in_use_or_shows_all_is_not_to_blame() -> None:
    timeline = failed()
    assert asked(timeline, "sensor_fault", value="radar")["text"].startswith(
        "No: that was not in use (radar)"
    )
    assert asked(crashed(), "sensor_fault")["text"].startswith("No: my sensor is perfect")
    running = driven(2, seed=1, sensor="camera")
    assert asked(running, "sensor_fault")["text"].startswith("There is nothing to blame it for")


def test_ranges_are_those_of_the_conditions_that_are_named() -> None:
    timeline = driven(1, seed=1, sensor="camera")
    told = asked(timeline, "sensors", "fog night")
    for name in SUITES:
        found = reach(timeline.config.with_parts(sensor=name, weather="fog", time_of_day="night"))
        assert found is not None
        label = next(key for key in told["half_detected_m"] if key.startswith(name))
        assert told["half_detected_m"][label] == found.half[Kind.VEHICLE] * timeline.config.cell_m
    assert told["supposed"] == {"weather": "fog", "time_of_day": "night"}
    assert "supposed" not in asked(timeline, "sensors")


def test_runs_for_a_claim_are_the_fewest_by_the_exact_test() -> None:
    def at_most(hits: int, tries: int, rate: Fraction) -> Fraction:
        return sum(
            (comb(tries, each) * rate**each * (1 - rate) ** (tries - each) for each in range(hits + 1)),
            Fraction(0),
        )

    for percent, sure in ((5, 95), (1, 95), (10, 90), (20, 99), (50, 50)):
        rate, doubt = Fraction(percent, 100), 1 - Fraction(sure, 100)
        for hits in range(3):
            runs = tries_to_claim(percent / 100, sure / 100, hits)
            if (percent, sure) != (50, 50):  # there the bound is met exactly, which floats may miss
                assert at_most(hits, runs, rate) <= doubt < at_most(hits, runs - 1, rate)
    timeline = driven(0)
    assert asked(timeline, "runs_needed", "95 5")["text"].startswith("59 runs on independently drawn roads")
    assert asked(timeline, "runs_needed", "100 5")["runs"] is None


def test_a_tick_that_has_not_been_is_not_offered() -> None:
    timeline = driven(5, seed=1)
    assert "go back to tick 3" in asked(timeline, "stepping", "3")["text"]
    assert "this is tick 5" in asked(timeline, "stepping", "20")["text"]
