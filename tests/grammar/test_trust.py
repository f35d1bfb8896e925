"""Sentences in which one word decides: what they say is done, asked about or refused, nothing else."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from service.actions import dump
from service.grammar import Ambiguous, Language, Refused, Understood
from service.yaml_files import read_yaml

DATA = Path(__file__).parent / "data"


def wrong_acts(language: Language, path: Path) -> tuple[list[tuple[str, Any]], int]:
    """Sentences of a file that are acted on otherwise than written, and how many sentences there are."""
    wrong: list[tuple[str, Any]] = []
    count = 0
    for kind in read_yaml(path).values():
        told = [(text, None) for text in kind.get("never", ())]
        told += [(text, json.loads(actions)) for text, actions in kind.get("means", ())]
        count += len(told)
        for text, actions in told:
            parsed = language.parse(text)
            if not isinstance(parsed, Understood) or dump(parsed.actions) == actions:
                continue
            if any(action.do != "chat" for action in parsed.actions):  # small talk does nothing
                wrong.append((text, dump(parsed.actions)))
    return wrong, count


def test_no_sentence_is_acted_on_otherwise_than_it_says(language: Language) -> None:
    wrong, count = wrong_acts(language, DATA / "trust_en.yaml")
    assert count > 300
    assert wrong == []


def test_no_german_sentence_is_acted_on_otherwise_than_it_says() -> None:
    wrong, count = wrong_acts(Language.load("de"), DATA / "de" / "trust.yaml")
    assert count > 100
    assert wrong == []


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("pause for five seconds", "for five seconds"),
        ("use A* for 20 ticks", "for 20 ticks"),
        ("make it rain and pause for 5 seconds", "for 5 seconds"),
        ("stop that truck", "that truck"),
        ("use lidar at night", "at night"),
    ],
)
def test_a_refusal_names_the_words_that_have_no_use(language: Language, text: str, named: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Refused)
    assert parsed.unparsed == (named,)


def test_what_is_said_not_to_be_there_is_asked_about(language: Language) -> None:
    parsed = language.parse("five potholes and no cars")
    assert isinstance(parsed, Ambiguous)
    assert [len(choice.actions) for choice in parsed.choices] == [2, 1]


def test_each_action_is_aligned_with_its_words(language: Language) -> None:
    text = "add two cars in lane 3 and make it rain"
    parsed = language.parse(text)
    assert isinstance(parsed, Understood)
    said = [[text[start:end] for start, end in spans] for spans in parsed.alignment]
    assert said[0] == ["add two cars", "lane 3"]
    assert said[1][-1].endswith("rain")


def test_an_action_of_several_is_aligned_with_its_own_thing(language: Language) -> None:
    text = "add two cars and three cones"
    parsed = language.parse(text)
    assert isinstance(parsed, Understood)
    said = [" ".join(text[start:end] for start, end in spans) for spans in parsed.alignment]
    assert "two cars" in said[0]
    assert "cones" not in said[0]
    assert "three cones" in said[1]
    assert "cars" not in said[1]
