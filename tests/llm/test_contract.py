"""The contract as a model is told it, and that no answer whatever gets past it."""

from __future__ import annotations

import json
import re
from typing import Any, get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.actions import ACTIONS, Action, Ask, dump, load
from service.llm.answer_parser import MAX_ACTIONS, parse_answer
from service.llm.failures import ModelFailure, Reason
from service.llm.prompts import load_prompt
from service.llm.schema import FORBIDDEN, MAY, schema
from sim.session.settings import AS_IT_IS

DEFS: dict[str, Any] = ACTIONS.json_schema()["$defs"]
FREE_TEXT = {
    ("Where", "id"),
    ("Which", "id"),
    ("Landmark", "id"),
    ("Set", "value"),
    ("Ask", "value"),
    ("Evaluate", "scenario_name"),
    ("Drive", "ego"),
    ("SetMode", "ego"),
    ("Style", "style"),
}
"""Fields of a model's actions that take any text: each is checked by `reading`."""
PARTS_OF_FORBIDDEN = {"PhraseParameter"}
"""Types that only forbidden actions name."""


def test_every_action_is_either_offered_or_forbidden_on_purpose() -> None:
    assert {"teach", "load", "save"} <= FORBIDDEN
    assert {"teach", "forget", "load", "save", "trigger", "cancel"} >= FORBIDDEN
    names = set(re.findall(r'^\{do: "(\w+)"', schema(), re.MULTILINE))
    assert names == MAY


def test_every_type_that_is_named_is_described() -> None:
    named = set(re.findall(r": \(?([A-Z]\w+)", schema())) - {"Action"}
    assert named == set(re.findall(r"^type (\w+)", schema(), re.MULTILINE))
    assert "$ref" not in schema()
    assert len(schema()) < 12_000


def test_no_other_field_takes_any_text() -> None:
    found = {
        (name, field)
        for name, part in DEFS.items()
        for field, value in part.get("properties", {}).items()
        for one in (value, *value.get("anyOf", ()))
        if one.get("type") == "string" and not {"const", "enum"} & set(one)
    }
    forbidden = {name for name, part in DEFS.items() if _do(part) in FORBIDDEN} | PARTS_OF_FORBIDDEN
    assert {(name, field) for name, field in found if name not in forbidden} == FREE_TEXT


def _do(part: dict[str, Any]) -> str | None:
    value: str | None = part.get("properties", {}).get("do", {}).get("const")
    return value


def test_the_words_of_parameters_are_those_the_simulation_knows() -> None:
    for parameter, value in AS_IT_IS.items():
        said = json.dumps({"actions": [{"do": "set", "parameter": parameter, "value": value}]})
        assert len(parse_answer(said, "")) == 1


def test_the_examples_of_the_prompt_are_what_it_asks_for() -> None:
    prompt = load_prompt("interpret").text
    examples = re.findall(r'^\{"said": "(.*)"\} → (.*)$', prompt, re.MULTILINE)
    assert len(examples) >= 4
    assert schema() in prompt
    for said, answer in examples:
        if answer == '{"actions": []}':
            with pytest.raises(ModelFailure, match="nothing"):
                parse_answer(answer, said)
        else:
            assert dump(parse_answer(answer, said)) == json.loads(answer)["actions"]


texts = st.sampled_from(
    ["add", "teach", "load", "ask", "what_if", "pothole", "pothole-3", "rain", "weather", "é"]
)
leaves = st.none() | st.booleans() | st.integers() | st.floats() | texts | st.text(max_size=5)
keys = st.sampled_from(
    ["do", "kind", "count", "where", "id", "about", "change", "parameter", "value", "actions"]
)
values = st.recursive(
    leaves,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(keys, inner, max_size=5),
    max_leaves=20,
)
likely = st.lists(
    st.fixed_dictionaries(
        {"do": st.sampled_from(sorted(MAY | FORBIDDEN))},
        optional={
            "kind": st.just("pothole"),
            "count": st.just(1) | leaves,
            "where": st.fixed_dictionaries({"id": texts}),
            "about": st.just("what_if"),
            "change": st.lists(
                st.just({"do": "load", "name": "x"}) | st.just({"do": "pause"}) | values, max_size=3
            ),
            "name": texts,
        },
    ),
    max_size=10,
)


def inside(actions: tuple[Action, ...]) -> list[Action]:
    found = list(actions)
    for action in actions:
        if isinstance(action, Ask):
            found += inside(action.change or ())
    return found


def outcome(answer: str, said: str) -> tuple[Action, ...] | Reason:
    """What is read, or why nothing is; anything else that is raised fails the test."""
    try:
        return parse_answer(answer, said)
    except ModelFailure as failure:
        return failure.reason


@given(st.one_of(likely.map(lambda actions: {"actions": actions}), values), st.text(max_size=20))
def test_nothing_gets_past(answer: Any, said: str) -> None:
    found = outcome(json.dumps(answer), said)
    if isinstance(found, str):
        assert found in get_args(Reason)
        return
    every = inside(found)
    assert {action.do for action in every} <= MAY
    assert 0 < len(every) <= MAX_ACTIONS
    assert load(dump(found)) == found


@given(st.text() | st.text(alphabet='{}[]"`json\n:,ado0.-'))
def test_no_text_at_all_makes_it_raise_anything_else(answer: str) -> None:
    assert outcome(answer, answer) in ("unreadable", "no_action")


@pytest.mark.parametrize("action", [{"do": "drive", "move": "left"}, {"do": "mode", "mode": "manual"}])
def test_an_ego_that_was_not_said_is_not_believed(action: dict[str, str]) -> None:
    answer = json.dumps({"actions": [{**action, "ego": "av-2"}]})
    with pytest.raises(ModelFailure) as refused:
        parse_answer(answer, "go left")
    assert refused.value.reason == "not_said"
    assert dump(parse_answer(answer, "av-2, go left"))[0]["ego"] == "av-2"
