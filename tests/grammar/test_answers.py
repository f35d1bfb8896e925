"""Answers to questions with choices, and sentences that lean on the one before."""

from __future__ import annotations

import pytest

from service.actions import dump
from service.grammar import Ambiguous, Language, Refused, Understood
from service.grammar.answers import Answer, NoChoice, NoSuchChoice, read_answer
from service.grammar.follow_up import read_in_conversation
from service.grammar.parse_types import Parse
from service.grammar.topic import Topic


def answer(language: Language, asked: str, text: str) -> Answer | None:
    question = language.parse(asked)
    assert isinstance(question, Ambiguous)
    literal = not isinstance(language.parse(text), Refused)
    return read_answer(language, text, question.choices, literal=literal)


@pytest.mark.parametrize(
    ("asked", "text", "meant"),
    [
        ("add potholes", "ten", "add ten potholes"),
        ("add potholes", "2", "add two potholes"),
        ("add potholes", "the second one", "add three potholes"),
        ("add potholes", "the last one please", "add ten potholes"),
        ("add potholes", "make it a dozen", "add 12 potholes"),
        ("faster", "the vehicle", "make the vehicle drive faster"),
        ("faster", "the playback", "make the simulation faster"),
        ("faster", "2", "make the vehicle drive faster"),
        ("add two cones in the other lane", "left", "add two cones in the left lane"),
        ("add two cones in the other lane", "right", "add two cones in the right lane"),
        ("add two cones in the other lane", "lane 3", "add two cones in lane 3"),
        ("remove any car", "all", "remove every car"),
    ],
)
def test_an_answer_picks_a_choice_or_says_another_amount(
    language: Language, asked: str, text: str, meant: str
) -> None:
    done = language.parse(meant)
    assert isinstance(done, Understood)
    assert answer(language, asked, text) == done.actions


@pytest.mark.parametrize("text", ["never mind", "neither", "none of them", "no", "cancel that", "forget it"])
def test_a_question_can_be_dropped(language: Language, text: str) -> None:
    assert answer(language, "faster", text) is NoChoice.DROPPED


def test_a_number_beyond_the_choices_is_no_choice(language: Language) -> None:
    assert answer(language, "faster", "the fifth one") == NoSuchChoice(5)
    assert answer(language, "faster", "7") == NoSuchChoice(7)


def test_yes_says_nothing_of_several_choices_and_takes_the_only_one(language: Language) -> None:
    assert answer(language, "faster", "yes") is NoChoice.UNCLEAR
    question = language.parse("faster")
    assert isinstance(question, Ambiguous)
    only = question.choices[:1]
    assert read_answer(language, "yes, please", only) == only[0].actions


@pytest.mark.parametrize(
    "text", ["add two cars", "turn left", "pause", "where are you?", "both", "bake a cake"]
)
def test_a_request_of_its_own_and_what_could_be_two_are_no_answers(language: Language, text: str) -> None:
    assert answer(language, "add potholes", text) is None


def after(language: Language, said: str, text: str) -> Parse:
    done = language.parse(said)
    assert isinstance(done, Understood)
    changing = not said.endswith("?")
    topic = Topic(actions=done.actions, said=said, steps=int(changing))
    return read_in_conversation(language, text, topic, language.parse(text, topic))


@pytest.mark.parametrize(
    ("said", "text", "meant"),
    [
        ("add two cars in the left lane", "and in lane 5", "add two cars in lane 5"),
        ("add two cars", "and in lane 5", "add two cars in lane 5"),
        ("add two cars in lane 5", "the same in the right lane", "add two cars in the right lane"),
        ("why didn't you go left?", "and right?", "why didn't you go right"),
        ("why didn't you go left?", "and straight ahead?", "why didn't you go straight"),
        ("are there any potholes?", "and cars?", "are there any cars"),
    ],
)
def test_a_sentence_goes_on_with_the_one_before(language: Language, said: str, text: str, meant: str) -> None:
    parsed, done = after(language, said, text), language.parse(meant)
    assert isinstance(parsed, Understood)
    assert isinstance(done, Understood)
    assert parsed.actions == done.actions


@pytest.mark.parametrize(
    ("said", "text", "meant"),
    [
        ("add two cars", "I said three", "add three cars"),
        ("add two cars in lane 2", "in lane 5 instead", "add two cars in lane 5"),
        ("turn left", "no, I meant right", "turn right"),
        ("turn left", "right, I mean", "turn right"),
        ("add two cars", "make it cones", "add two cones"),
    ],
)
def test_a_correction_takes_back_first(language: Language, said: str, text: str, meant: str) -> None:
    parsed, done = after(language, said, text), language.parse(meant)
    assert isinstance(parsed, Understood)
    assert isinstance(done, Understood)
    assert dump(parsed.actions) == [{"do": "undo"}, *dump(done.actions)]


@pytest.mark.parametrize(
    ("said", "text"),
    [
        ("where are you?", "and left?"),
        ("what do you see?", "what about right?"),
        ("add two cars", "and quickly"),
        ("add two cars", "I said banana"),
        ("add two cars", "no thanks"),
    ],
)
def test_what_does_not_fit_the_one_before_never_acts(language: Language, said: str, text: str) -> None:
    assert not isinstance(after(language, said, text), Understood)


def test_a_part_that_is_there_twice_is_asked_about(language: Language) -> None:
    parsed = after(language, "add three cars in lane 3", "I said five")
    assert isinstance(parsed, Ambiguous)
    assert len(parsed.choices) == 2
