"""Corrections of what an earlier utterance did: it is taken back and done anew, or asked about."""

from __future__ import annotations

from dataclasses import replace

import pytest

from service.actions import dump
from service.grammar import Ambiguous, Language, Refused, Understood
from service.grammar.topic import Topic


def after(language: Language, said: str) -> Topic:
    """The topic after a sentence was done."""
    done = language.parse(said)
    assert isinstance(done, Understood)
    return Topic(actions=done.actions, steps=1)


@pytest.mark.parametrize(
    ("said", "correction", "meant"),
    [
        ("add five potholes", "no, three", "add three potholes"),
        ("add five potholes", "no, three, not five", "add three potholes"),
        ("add five potholes", "I meant three", "add three potholes"),
        ("add five potholes", "make that three", "add three potholes"),
        ("add five potholes", "no, cars", "add five cars"),
        ("raise the safety buffer by one", "no, two", "raise the safety buffer by two"),
        ("make it rain", "I meant snow", "make it snow"),
    ],
)
def test_a_correction_takes_back_what_was_done_and_does_it_anew(
    language: Language, said: str, correction: str, meant: str
) -> None:
    parsed = language.parse(correction, after(language, said))
    done = language.parse(meant)
    assert isinstance(parsed, Understood)
    assert isinstance(done, Understood)
    assert dump(parsed.actions) == [{"do": "undo"}, *dump(done.actions)]


def test_a_correction_of_a_correction_takes_back_both(language: Language) -> None:
    topic = replace(after(language, "add five potholes"), steps=2)
    parsed = language.parse("no, three", topic)
    assert isinstance(parsed, Understood)
    assert dump(parsed.actions)[0] == {"do": "undo", "steps": 2}


def test_what_did_nothing_is_not_taken_back(language: Language) -> None:
    parsed = language.parse("I meant snow", replace(after(language, "make it rain"), steps=0))
    assert isinstance(parsed, Understood)
    assert dump(parsed.actions) == [{"do": "set", "parameter": "weather", "value": "snow"}]


def test_a_whole_request_that_comes_on_top_is_asked_about(language: Language) -> None:
    parsed = language.parse("no, add three potholes", after(language, "add five potholes"))
    assert isinstance(parsed, Ambiguous)
    added = {"do": "add", "kind": "pothole", "count": 3}
    assert [dump(choice.actions) for choice in parsed.choices] == [[{"do": "undo"}, added], [added]]
    for choice in parsed.choices:
        again = language.parse(choice.text)
        assert isinstance(again, Understood)
        assert again.actions == choice.actions


@pytest.mark.parametrize("text", ["no, three", "I meant three", "make that three", "I meant the left lane"])
def test_without_anything_before_it_the_refusal_says_what_can_be_done(language: Language, text: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Refused)
    assert '"undo"' in parsed.message


@pytest.mark.parametrize("said", ["turn left", "pause", "what do you see", "load monday"])
def test_what_cannot_be_taken_back_is_not_offered(language: Language, said: str) -> None:
    assert isinstance(language.parse("no, three", after(language, said)), Refused)


def test_what_was_undone_already_is_not_offered_to_be_taken_back(language: Language) -> None:
    done = after(language, "add five potholes")
    assert isinstance(language.parse("no, three", Topic(actions=done.actions, undone=True)), Refused)
    plain = language.parse("no, add three potholes", Topic(actions=done.actions, undone=True))
    assert isinstance(plain, Understood)


@pytest.mark.parametrize(
    ("said", "text"),
    [
        ("add five potholes", "no, turn left"),
        ("add five potholes", "wait, add two cars"),
        ("make it rain", "no, make it snow"),
        ("add five potholes", "add three potholes"),
    ],
)
def test_what_stands_beside_the_last_request_or_in_its_place_is_done(
    language: Language, said: str, text: str
) -> None:
    assert isinstance(language.parse(text, after(language, said)), Understood)


def test_unknown_words_are_still_named(language: Language) -> None:
    parsed = language.parse("no, a quetzalcoatl", after(language, "add five potholes"))
    assert isinstance(parsed, Refused)
    assert parsed.unparsed == ("quetzalcoatl",)
