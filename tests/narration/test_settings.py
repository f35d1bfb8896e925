"""Every setting is asked about in several forms and answered with the value it has; options can be said."""

from __future__ import annotations

import random
from typing import Any, get_args

import pytest

from service.actions import Ask, Choosable, load
from service.grammar import Language, Understood
from service.narration import Narrator
from service.narration.sayings import Sayings
from service.narration.settings import Settings, setting_now
from service.sessions.facts import Asked
from sim.actions import Adjust, Parameter, Scenario, Set
from sim.config import Config
from sim.session.timeline import Timeline

LANGUAGE = Language.load()
WORDS: Any = LANGUAGE.data.sentences
FORMS = ("what is the {name}?", "tell me the {name}", "what is the current {name}", "what about the {name}?")
NAMED = {"dynamics": "motion model"}


def configs() -> list[Config]:
    draw = random.Random(5)
    return [
        Config(
            columns=draw.randint(3, 9),
            rows=draw.randint(8, 40),
            spawn_probability=draw.randint(0, 100) / 100,
            pothole_probability=draw.randint(0, 30) / 100,
            courtesy=draw.randint(0, 10) / 10,
            safety_buffer=draw.randint(0, 3),
            planner=draw.choice(("rules", "priority", "astar", "dijkstra", "bfs")),
            seed=draw.randint(0, 999),
        )
        for _ in range(8)
    ]


@pytest.mark.parametrize("name", get_args(Parameter))
def test_every_parameter_is_asked_in_three_forms(name: str) -> None:
    called = NAMED.get(name, WORDS["parameters"][name])
    for form in FORMS[:3]:
        parsed = LANGUAGE.parse(form.format(name=called))
        assert isinstance(parsed, Understood), form.format(name=called)
        assert parsed.actions == (Ask(about="setting", parameter=name),)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", get_args(Parameter))
def test_it_is_answered_with_the_value_of_the_session(name: str) -> None:
    narrator = Narrator.load()
    for config in configs():
        timeline = Timeline(config)
        for pace in (1.0, 4.0, "max"):
            fact = Asked(Ask(about="setting", parameter=name), timeline, playback_speed=pace)  # type: ignore[arg-type]
            answer = narrator.answer(fact)
            value = setting_now(name, config, pace)  # type: ignore[arg-type]
            assert answer["value"] == value
            if isinstance(value, int | float) and not isinstance(value, bool):
                assert f"{value:g}" in answer["text"]


@pytest.mark.parametrize("name", ["columns", "rows"])
def test_how_many_begins_with_the_number(name: str) -> None:
    config = Config(columns=6, rows=21)
    answer = Narrator.load().answer(Asked(Ask(about="setting", parameter=name), Timeline(config)))  # type: ignore[arg-type]
    assert answer["text"].startswith(f"{getattr(config, name)} ")


@pytest.mark.parametrize(
    ("asked", "holds"),
    [
        ({"parameter": "planner", "value": "astar"}, True),
        ({"parameter": "planner", "value": "dijkstra"}, False),
        ({"parameter": "courtesy", "value": 0.3}, True),
        ({"parameter": "courtesy", "value": 0.31}, False),
        ({"parameter": "weather", "value": "clear"}, True),
        ({"parameter": "weather", "value": "rain"}, False),
        ({"parameter": "traffic", "value": "normal"}, True),
        ({"parameter": "playback_speed", "value": 1}, True),
        ({"parameter": "sensor_noise", "value": 0.2}, False),
        ({"parameter": "target_speed_kmh", "value": 36}, True),
    ],
)
@pytest.mark.parametrize(("code", "yes", "no"), [("en", "Yes.", "No."), ("de", "Ja.", "Nein.")])
def test_yes_or_no_comes_first(asked: dict[str, Any], holds: bool, code: str, yes: str, no: str) -> None:
    timeline = Timeline(Config(planner="astar", courtesy=0.3))
    answer = Narrator.load(code).answer(Asked(Ask(about="setting", **asked), timeline))
    assert answer["holds"] is holds
    assert answer["text"].startswith(yes if holds else no)


@pytest.mark.parametrize("code", ["en", "de"])
@pytest.mark.parametrize("name", [*get_args(Parameter), *get_args(Choosable)])
def test_what_options_advise_to_say_does_what_they_are_about(code: str, name: str) -> None:
    sayings = Sayings.load(code)
    answer = Settings(sayings).answer(Asked(Ask(about="options", parameter=name), Timeline(Config())))
    example = sayings.words("settings", "examples").get(name)
    if example is None or example not in answer["text"]:
        assert not answer["options"] or len(answer["options"]) == 1
        return
    parsed = Language.load(code).parse(example)
    assert isinstance(parsed, Understood), example
    (action,) = parsed.actions
    match action:
        case Set() | Adjust():
            assert action.parameter == name
        case Scenario():
            assert getattr(action, name) is not None
        case _:
            assert {"show": "view", "prefer": "preference"}[action.do] == name


@pytest.mark.parametrize("code", ["en", "de"])
def test_the_general_answer_names_a_question_that_parses(code: str) -> None:
    example = Sayings.load(code).say("settings", "choose_example")
    parsed = Language.load(code).parse(example)
    assert isinstance(parsed, Understood)
    assert parsed.actions == (Ask(about="options", parameter="planner"),)


def test_what_has_options_alone_has_no_value() -> None:
    with pytest.raises(ValueError, match="options and no value"):
        load([{"do": "ask", "about": "setting", "parameter": "view"}])
