"""What is said back means what was done: any actions → one sentence → the same actions."""

from __future__ import annotations

import pytest

from service.actions import load
from service.grammar import Language, Understood
from service.grammar.corpus import sentences
from service.grammar.sentences import Unsayable, number, quoted
from tests.support.random_actions import failures


def test_random_actions_come_back(language: Language) -> None:
    assert failures(language, range(1_000)) == []


def test_what_the_language_says_of_itself_is_understood(language: Language) -> None:
    said = list(sentences(language.sentences))
    assert len(said) > 350
    assert [text for text in said if not isinstance(language.parse(text), Understood)] == []


@pytest.mark.parametrize(
    "actions",
    [
        [],
        [{"do": "remove", "kind": "everything", "count": 3}],
        [{"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "vehicle-2"}}],
        [{"do": "add", "kind": "pothole", "count": 1, "where": {"cell": [1, 2], "lane": 3}}],
        [{"do": "adjust", "parameter": "traffic", "direction": "up"}],
        [{"do": "adjust", "parameter": "planner", "factor": 2.0}],
        [{"do": "set", "parameter": "planner", "value": "mine"}],
        [{"do": "set", "parameter": "weather", "value": 5}],
        [{"do": "set", "parameter": "columns", "value": "many"}],
    ],
)
def test_what_no_sentence_means_is_not_said(language: Language, actions: list[dict[str, object]]) -> None:
    with pytest.raises(Unsayable):
        language.sentence(load(actions))


@pytest.mark.parametrize(
    ("value", "said"),
    [(5, "5"), (5.0, "5"), (0.1 + 0.2, "0.30000000000000004"), (1e-05, "0.00001"), (1e16, "1" + "0" * 16)],
)
def test_numbers_are_written_out(value: float, said: str) -> None:
    assert number(value) == said
    assert float(said) == value


def test_quotation_marks_in_names_are_escaped() -> None:
    assert quoted('the "big" one') == '"the \\"big\\" one"'
    assert quoted("a\\b") == '"a\\\\b"'
