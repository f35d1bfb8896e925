""" "How far is it?" after a question about a thing is of that thing; by itself, of the goal."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.grammar import Language
from service.grammar.follow_up import read_in_conversation
from service.grammar.parse_types import Understood
from service.grammar.topic import ALONE, Topic

GOAL = Ask(about="status")


def asked(language: Language, text: str) -> tuple[object, ...]:
    parsed = language.parse(text, ALONE)
    assert isinstance(parsed, Understood), text
    return parsed.actions


@pytest.mark.parametrize("first", ["where is the nearest car", "which car is the most dangerous"])
@pytest.mark.parametrize("then", ["how far is it", "how far away is it", "how close is it"])
def test_it_is_the_thing_that_was_asked_about(language: Language, first: str, then: str) -> None:
    of_thing = asked(language, first)
    assert asked(language, then) == (GOAL,)
    assert asked(language, f"{first} and {then}?") == of_thing
    topic = Topic(actions=of_thing, asked=of_thing)  # type: ignore[arg-type]
    parsed = read_in_conversation(language, then, topic, language.parse(then, topic))
    assert isinstance(parsed, Understood)
    assert parsed.actions == of_thing


def test_it_stands_for_nothing_where_the_goal_is_named(language: Language) -> None:
    of_thing = asked(language, "where is the nearest car")
    topic = Topic(actions=of_thing, asked=of_thing)  # type: ignore[arg-type]
    said = "how far is it to the goal"
    parsed = read_in_conversation(language, said, topic, language.parse(said, topic))
    assert isinstance(parsed, Understood)
    assert parsed.actions == (GOAL,)
    assert asked(language, "where are you and how far is it") == (GOAL, GOAL)


def test_each_question_of_a_text_supposes_its_own(language: Language) -> None:
    parsed = language.parse("what tick is it and where are you", ALONE)
    assert isinstance(parsed, Understood)
    assert (parsed.actions, parsed.supposes) == ((GOAL, GOAL), ("tick", None))
