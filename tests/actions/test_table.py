"""The table of actions agrees with those who do them, and its columns with each other."""

from __future__ import annotations

from typing import get_args

import pytest

from service.actions import ACTION_TYPES, QUESTIONS, Action, Ask, QuestionName, load
from service.actions.table import (
    BY_VERB,
    ActionTraits,
    ModelUse,
    WhatIf,
    is_world_action,
    traits_of,
    types_where,
    verb,
)
from service.narration.answers import Answers
from service.narration.sayings import Sayings
from service.sessions.action_handlers import HANDLERS
from sim.actions import WorldAction


def test_every_action_has_a_verb_of_its_own_and_a_row() -> None:
    assert len(BY_VERB) == len(ACTION_TYPES)
    assert {verb(kind) for kind in ACTION_TYPES} == set(BY_VERB)


def test_actions_of_the_world_are_those_of_the_simulator() -> None:
    assert set(types_where(lambda traits: traits.changes_world)) == set(get_args(WorldAction))


def test_what_is_offered_is_handled() -> None:
    assert set(types_where(lambda traits: traits.offered)) == set(HANDLERS)


@pytest.mark.parametrize("traits", BY_VERB.values(), ids=BY_VERB)
def test_columns_agree(traits: ActionTraits) -> None:
    assert traits.undo_step or not traits.changes_world, "a change of the world can be undone"
    assert traits.changes_session or not traits.undo_step, "a step of undo is stored"
    assert not (traits.is_question and traits.changes_session), "a question changes nothing"
    # They change nothing, and occupy the service for long or end such work.
    costs = traits in (BY_VERB["evaluate"], BY_VERB["evaluation"], BY_VERB["find_worst"])
    assert (traits.changes_session or costs) == (traits.model is not ModelUse.ALWAYS), (
        "a model may cause without asking what changes nothing, and only that"
    )
    assert not traits.additive or traits.amendable


def test_a_model_is_offered_no_new_action_by_default() -> None:
    assert ActionTraits().model is ModelUse.NEVER


def test_questions_and_phrases_stand_in_no_what_if() -> None:
    for name, traits in BY_VERB.items():
        assert (traits.what_if is WhatIf.INVALID) == (
            name in ("ask", "chat", "teach", "forget", "trigger", "cancel")
        )


@pytest.mark.parametrize(
    ("values", "world"),
    [
        ({"do": "set", "parameter": "planner", "value": "astar"}, True),
        ({"do": "set", "parameter": "playback_speed", "value": 2}, False),
        ({"do": "adjust", "parameter": "playback_speed", "direction": "up"}, False),
        ({"do": "pause"}, False),
        ({"do": "reset"}, True),
    ],
)
def test_playback_speed_is_of_no_world(values: dict[str, object], world: bool) -> None:
    (action,) = load([values])
    assert is_world_action(action) is world


def test_every_question_has_traits_and_an_answerer() -> None:
    assert set(QUESTIONS) == set(get_args(QuestionName)) == set(Answers(Sayings.load())._by_question)


NAMING: dict[str, tuple[str, ...]] = {
    "history": ("between", "tick", "until"),
    "outlook": ("safe", "move"),
    "blame": ("fault", "tick"),
    "planners": ("here", "planners"),
    "sight": ("range",),
    "world": ("pace",),
}
"""Of a question of several about the same, one, and what it names."""


@pytest.mark.parametrize("about", QUESTIONS)
def test_questions_take_their_keys_and_no_others(about: QuestionName) -> None:
    values: dict[str, object] = {
        "move": "left",
        "tick": 1,
        "change": [{"do": "pause"}],
        "kind": "pothole",
        "metric": "steps",
        "count": 1,
        "parameter": "courtesy",
        "value": 0.5,
        "term": "tick",
        "fact": "livelock",
        "what": "why" if about == "other" else "between",
        "until": 5,
        "ticks": 3,
        "seconds": 1.5,
        "instead": "right",
        "how": "shorter",
        "which": {"kind": "vehicle", "nearest": True},
        "planners": ["astar"],
        "planner": "astar",
    }
    if about in NAMING:
        values |= {"what": NAMING[about][0]}
    traits = QUESTIONS[about]
    named = {key: values[key] for key in NAMING.get(about, traits.may) if key in values} | (
        {"what": values["what"]} if "what" in traits.may else {}
    )
    if "ticks" in named:  # ticks are counted back, or named
        del named["ticks"]
    named.pop("seconds", None)
    if about in ("why", "why_not", "what_if"):  # the moment may be named instead of a tick
        named.pop("what", None)
    if about in ("scene", "other"):  # of one kind, or the nearest of it; of where another one goes
        del named["count"]
    if about == "what_if":  # a move in the past, or a change, or more or fewer of a kind
        del named["move"], named["kind"]
    if about == "outlook":  # seconds and ticks belong to what comes next
        named.pop("ticks", None)
    (asked,) = load([{"do": "ask", "about": about, **named}])
    assert isinstance(asked, Ask)
    assert traits_of(asked).is_question
    for key in values.keys() - set(traits.may):
        with pytest.raises(ValueError, match=f"'{key}' does not belong"):
            load([{"do": "ask", "about": about, **{name: values[name] for name in (*traits.must, key)}}])
    for key in traits.must:
        others = {name: values[name] for name in traits.must if name != key}
        with pytest.raises(ValueError, match=f"needs '{key}'"):
            load([{"do": "ask", "about": about, **others}])


@pytest.mark.parametrize(
    ("keys", "fits"),
    [
        ({"about": "what_if", "move": "left"}, True),
        ({"about": "what_if"}, False),
        ({"about": "what_if", "move": "left", "change": [{"do": "pause"}]}, False),
        ({"about": "what_if", "change": [{"do": "drive", "move": "stay"}], "count": 5}, True),
        ({"about": "what_if", "move": "left", "count": 5}, False),
        ({"about": "why", "tick": 3, "ticks": 3}, False),
        ({"about": "why", "ticks": 3, "seconds": 3.0}, False),
        ({"about": "other", "what": "why", "which": {"nearest": True}}, False),
        ({"about": "other", "what": "summary", "which": {"kind": "vehicle"}}, False),
        ({"about": "other", "what": "going", "which": {"id": "vehicle-1"}}, True),
    ],
)
def test_what_contradicts_itself_is_no_question(keys: dict[str, object], fits: bool) -> None:
    values = [{"do": "ask", **keys}]
    if fits:
        assert load(values)
    else:
        with pytest.raises(ValueError, match=r"say|does not belong|has no"):
            load(values)


@pytest.mark.parametrize(
    ("keys", "fits"),
    [
        ({"what": "summary"}, True),
        ({"what": "summary", "tick": 3}, False),
        ({"what": "since", "tick": 3}, True),
        ({"what": "since", "ticks": 3}, True),
        ({"what": "since"}, False),
        ({"what": "since", "tick": 3, "ticks": 3}, False),
        ({"what": "between", "tick": 3, "until": 3}, True),
        ({"what": "between", "tick": 3, "until": 2}, False),
        ({"what": "seen", "until": 2}, False),
        ({"what": "riskiest"}, True),
        ({"what": "riskiest", "tick": 3}, False),
        ({"what": "similar", "count": 3, "tick": 3}, True),
        ({"what": "similar", "ticks": 3}, False),
        ({"what": "safe", "about": "outlook", "move": "left"}, True),
        ({"what": "safe", "about": "outlook"}, False),
        ({"what": "stuck", "about": "outlook", "move": "left"}, False),
        ({"what": "character", "about": "planners", "planner": "astar"}, True),
        ({"what": "character", "about": "planners", "planners": ["astar"]}, False),
        ({"what": "own", "about": "planners", "tick": 3}, True),
        ({"what": "summary", "about": "blame"}, False),
        ({"what": "weather", "about": "sight"}, True),
        ({"what": "coming", "about": "outlook", "ticks": 3}, True),
        ({"what": "coming", "about": "outlook", "seconds": 1.5}, True),
        ({"what": "coming", "about": "outlook"}, False),
        ({"what": "risk", "about": "outlook", "ticks": 3}, False),
        ({"what": "since", "seconds": 1.5}, True),
        ({"what": "waited", "tick": 3}, False),
        ({"what": "runner_up", "tick": 3}, True),
        ({"what": "pace", "about": "sight"}, False),
    ],
)
def test_questions_name_what_they_need_and_nothing_more(keys: dict[str, object], fits: bool) -> None:
    values = [{"do": "ask", "about": "history", **keys}]
    if fits:
        load(values)
        return
    with pytest.raises(ValueError, match=r"names|ends after|does not belong|say one of"):
        load(values)


def test_an_action_has_traits_whatever_it_holds() -> None:
    actions: tuple[Action, ...] = load([{"do": verb(kind)} for kind in ACTION_TYPES if _is_bare(kind)])
    assert all(traits_of(action) is BY_VERB[action.do] for action in actions)


def _is_bare(kind: type) -> bool:
    try:
        kind()
    except (TypeError, ValueError):
        return False
    return True
