"""The window's words in every language: the same texts, and sentences that are understood."""

from __future__ import annotations

from collections.abc import Iterator
from string import Formatter
from typing import Any

import pytest

from service.grammar import Language
from service.grammar.parse_types import Understood
from service.window import texts


def names(value: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], frozenset[str | None]]]:
    """Each text's keys, and the facts it names."""
    if isinstance(value, dict):
        for key, each in value.items():
            yield from names(each, (*path, key))
    elif isinstance(value, str):
        yield path, frozenset(name for _, name, _, _ in Formatter().parse(value) if name)


def of(code: str) -> dict[tuple[str, ...], frozenset[str | None]]:
    own = ("drawn", "names")
    return {path: facts for path, facts in names(texts._texts(code)) if not set(own) & set(path)}


@pytest.mark.parametrize("code", [code for code in texts.languages() if code != "en"])
def test_every_language_has_the_same_texts(code: str) -> None:
    assert of(code) == of("en")


@pytest.mark.parametrize("code", texts.languages())
def test_sentences_that_are_offered_are_understood(code: str) -> None:
    grammar, held = Language.load(code), texts._texts(code)
    for sentence in (*held["help"]["examples"], *held["console"]["first"]):
        assert isinstance(grammar.parse(sentence), Understood), sentence
