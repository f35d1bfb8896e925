"""Cases in words: what happens, on what little road, and what would have saved it."""

from __future__ import annotations

import json
from copy import deepcopy
from functools import cache
from typing import Any

import pytest

from service.evaluations.cases import case_link, case_scenario, explain_cases
from service.narration import falsification_words
from service.scenarios.evaluation import first_state
from service.scenarios.file import read_scenario
from sim.config import Config
from sim.evaluate.executor import CancelledError
from sim.falsify import Case, Falsification
from sim.falsify.search import falsify
from sim.falsify.world import drive
from tests.support.broken_planner import registered

CONFIG = Config(columns=6, rows=14)


@cache
def searched(planner: str, config: Config) -> tuple[Falsification, dict[str, Any]]:
    spec = Falsification(planner=planner, worlds=60, config=config, seed=3)
    found = falsify(spec)
    assert found is not None
    return spec, found


def search(planner: str, config: Config = CONFIG) -> tuple[Falsification, dict[str, Any]]:
    """What a search finds, to be changed by whoever asks: the same each time."""
    spec, found = searched(planner, config)
    return spec, deepcopy(found)


def test_a_stuck_case_says_how_it_is_stuck_and_what_is_needed() -> None:
    spec, found = search("priority")
    explain_cases(found, "en", lambda: False)
    why = found["cases"][0]["case"]["why"]
    assert why.startswith("Priority rules: Stuck")
    assert "without any one of them it arrives" in why or "without it, it arrives" in why
    assert f"a way of {found['cases'][0]['least']} ticks" in why
    told = falsification_words("en").paragraphs(spec, found)
    assert told[0].startswith("Priority rules failed in")
    assert "Drawn at random" in told[0]
    assert told[1] == f"1. {why}"


def test_a_crash_says_what_was_hit_whose_fault_it_was_and_what_would_have_saved_it() -> None:
    _, found = search(registered())
    explain_cases(found, "en", lambda: False)
    crash = next(each for each in found["cases"] if each["outcome"] == "crash")
    why = crash["case"]["why"]
    assert "went forward" in why or "drove" in why or "moved" in why, why
    assert "nobody moves into another" in why
    assert "A*" in why.rpartition("Planners that arrive here: ")[2]


@pytest.mark.parametrize("planner", ["priority", "broken"])
def test_german_says_the_same_without_a_word_of_english(planner: str) -> None:
    spec, found = search(registered() if planner == "broken" else planner)
    explain_cases(found, "de", lambda: False)
    for each in found["cases"]:
        assert "befahrbar" in each["case"]["why"]
        assert " the " not in each["case"]["why"]
    assert "obwohl sie befahrbar sind" in falsification_words("de").paragraphs(spec, found)[0]


def test_a_planner_that_never_fails_is_told_with_its_hardest_world() -> None:
    spec, found = search("bfs", CONFIG.with_parts(attentive=0.0))  # nobody reacts, so its forecast holds
    told = falsification_words("en").paragraphs(spec, found)
    assert told[0].startswith("Quickest failed in none of 60 worlds")
    assert told[1].startswith("The hardest world it arrived in is drawn from seed")


def test_a_case_whose_road_is_drawn_otherwise_has_no_link() -> None:
    _, found = search("priority")
    case = Case.from_json(found["cases"][0]["case"])
    assert case_link(case, case.tick) is not None
    other = case.config.with_parts(seed=case.config.seed + 1)
    assert (
        case_link(
            Case.from_json({**case.to_json(), "config": {**case.to_json()["config"], "seed": other.seed}}), 0
        )
        is None
    )


@pytest.mark.parametrize("planner", ["priority", "rules"])
def test_a_case_is_a_scenario_file_that_begins_as_it_does(planner: str) -> None:
    _, found = search(planner)
    explain_cases(found, "en", lambda: False)
    assert found["cases"]
    for each in found["cases"]:
        case = Case.from_json(each["case"])
        scenario = read_scenario(json.dumps(each["scenario"]))
        assert (scenario.name, scenario.planner) == (case.name, planner)
        assert case.why.startswith(scenario.reason[:900])
        state = first_state(scenario)
        assert state.world.digest() == case.world.digest()
        assert (end := drive(state)[-1].world).digest() == case.digest
        assert end.outcome is case.outcome


def test_a_planner_of_another_package_has_no_scenario_file() -> None:
    _, found = search(registered())
    assert case_scenario(Case.from_json(found["cases"][0]["case"])) is None


def test_a_cancel_ends_the_telling() -> None:
    _, found = search("priority")
    with pytest.raises(CancelledError):
        explain_cases(found, "en", lambda: True)
