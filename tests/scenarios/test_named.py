"""Evaluations of what has a name: shipped scenarios and saved moments, by typed action and by sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from service.actions import Evaluate, Varied, dump
from service.actions.evaluation import ScenarioParts
from service.evaluations.named import name_key
from service.evaluations.request import evaluation_of
from service.grammar import Language
from service.grammar.parse_types import Understood
from service.grammar.topic import Topic
from service.narration import evaluation_words
from service.scenarios import NAMES, named_scenario
from service.scenarios.evaluation import evaluation_of_scenario
from sim.config import Config
from sim.evaluate import Evaluation, EvaluationError
from sim.state import SimState
from sim.transition import step
from sim.world.notation import write

CONFIG = Config(planner="priority", seed=7)


def of(name: str, saved: dict[str, SimState] | None = None, **parts: Any) -> Evaluation:
    return evaluation_of(Evaluate(scenario_name=name, **parts), CONFIG, saved=saved or {})


def problem(name: str, **parts: Any) -> tuple[str, str]:
    with pytest.raises(EvaluationError) as refused:
        of(name, **parts)
    (found,) = refused.value.problems
    return found.field, found.code


@pytest.mark.parametrize("name", NAMES)
def test_a_shipped_scenario_is_evaluated_as_by_its_command(name: str) -> None:
    spec = of(name, runs=20, planners=("astar", "priority"))
    assert spec == evaluation_of_scenario(named_scenario(name), 20, ("astar", "priority"))
    assert spec.scenario_name == name
    assert Evaluation.from_json(spec.to_json()) == spec


@pytest.mark.parametrize("name", ["Rush Hour", "rush_hour", " rush-hour ", "RUSH  HOUR"])
def test_names_are_compared_without_their_spelling(name: str) -> None:
    assert of(name).config.vehicles == 40
    assert name_key(name) == "rush-hour"


def test_without_a_planner_the_one_that_drives_is_meant() -> None:
    assert of("maze").planners == ("priority",)


def test_a_saved_moment_is_the_road_as_it_was_and_comes_before_a_scenario() -> None:
    state = SimState.start(replace(CONFIG, vehicles=3, potholes=0))
    later = step(state).state
    saved = {"Monday demo": state, "maze": later}
    spec = of("monday-demo", saved)
    assert spec.world == write(state.world)
    assert (spec.seed, spec.scenario_name, spec.rules) == (7, "monday-demo", ())
    assert of("maze", saved).world == write(later.world)


def test_conditions_may_be_said_with_a_name() -> None:
    spec = of("maze", scenario=ScenarioParts(weather="fog", sensor="camera"))
    assert (spec.config.layout, spec.config.weather, spec.config.sensor) == ("maze", "fog", "camera")
    assert of("maze", scenario=ScenarioParts(vehicles=3)).config.vehicles == 3
    cases = of("gap-in-the-wall", vary=Varied(weather=("fog", "clear"))).cases
    assert [case.said for case in cases] == [{"weather": "fog"}, {"weather": "clear"}]


def test_what_does_not_go_together_is_refused() -> None:
    assert problem("flat-earth") == ("scenario_name", "must_be_one_of")
    assert problem("maze", road="this") == ("road", "is_that_of_the_scenario")
    assert problem("maze", scenario=ScenarioParts(layout="walls")) == ("scenario", "must_be_a_list_of")
    assert problem("gap-in-the-wall", scenario=ScenarioParts(potholes=3)) == ("scenario", "must_be_a_list_of")
    assert problem("maze", runs=0) == ("episodes", "must_be_between")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    ("code", "text"), [("en", "run scenario {} 100 times"), ("de", "fahre das Szenario {} 100 mal")]
)
def test_every_shipped_scenario_has_words(name: str, code: str, text: str) -> None:
    language = Language.load(code)
    for said in (name, name.replace("-", " "), f'"{name}"'):
        parsed = language.parse(text.format(said))
        assert isinstance(parsed, Understood), said
        assert dump(parsed.actions) == [{"do": "evaluate", "runs": 100, "scenario_name": name}]


@pytest.mark.parametrize("name", ["night shift", "20 cars", "rain-and-fog"])
def test_a_name_that_was_given_is_found_without_quotation_marks(name: str) -> None:
    language = Language.load("en")
    topic = Topic(names=frozenset([name]))
    parsed = language.parse(f"run the scenario {name} 30 times with A*", topic)
    assert isinstance(parsed, Understood)
    (action,) = dump(parsed.actions)
    assert name_key(action.pop("scenario_name")) == name_key(name)
    assert action == {"do": "evaluate", "runs": 30, "planners": ["astar"]}


def test_words_that_are_no_name_stay_what_they_are() -> None:
    parsed = Language.load("en").parse("run 100 episodes in a maze", Topic(names=frozenset(["maze"])))
    assert isinstance(parsed, Understood)
    assert dump(parsed.actions) == [{"do": "evaluate", "runs": 100, "scenario": {"layout": "maze"}}]


def test_the_name_is_told() -> None:
    told = evaluation_words("en")
    assert told.title(of("maze")) == "Evaluation: 100 runs of “maze” with Priority rules, in a maze"
    assert "on one and the same road" in told.started(of("gap-in-the-wall"), "job")
    assert "„maze“" in evaluation_words("de").title(of("maze"))
