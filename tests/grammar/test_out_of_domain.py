"""Nothing that is not for the simulator does anything to it."""

from __future__ import annotations

from service.actions import dump
from service.grammar import Language
from service.grammar.parse_types import Ambiguous, Understood
from tests.support.other_domains import by_hand, sentences

HARMLESS = frozenset(("chat", "load"))
"""A line of small talk; and a name that nobody gave, which is refused when it is looked up."""

KNOWN = frozenset(
    (
        "take the car to the garage",
        "it's your turn",
        "how come she left",
        "resume my friends",
        "are you bored?",
    )
)
"""Sentences that may be meant for the simulator as well."""


def test_nothing_out_of_domain_is_acted_on(language: Language) -> None:
    said = sentences(count=60, brief=1_000)
    assert len(said) >= 6_000
    acted = [
        (text, dump(parsed.actions))
        for text in said
        if isinstance(parsed := language.parse(text), Understood)
        and text not in KNOWN
        and not (len(parsed.actions) == 1 and parsed.actions[0].do in HARMLESS)
    ]
    assert acted == []


def test_hardly_anything_out_of_domain_is_asked_about(language: Language) -> None:
    said = list(by_hand())
    assert len(said) >= 600
    assert [text for text in said if isinstance(language.parse(text), Ambiguous)] == []


def test_the_same_seed_makes_the_same_sentences() -> None:
    assert sentences(count=2, brief=5, seed=4) == sentences(count=2, brief=5, seed=4)
    assert sentences(count=2, brief=5, seed=4) != sentences(count=2, brief=5, seed=5)
