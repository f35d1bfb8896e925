"""What a refusal names, and what it suggests: the smallest stretch, and sentences of the same intent."""

from __future__ import annotations

import pytest

from service.actions.table import traits_of
from service.grammar import Language, Refused, Understood
from tests.grammar.beside import beside


@pytest.fixture(scope="module")
def german() -> Language:
    return Language.load("de")


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("add five potholes and make me a sandwich", "make me a sandwich"),
        ("put three cones on the moon", "on the moon"),
        ("add two cars in the sky and three potholes", "in the sky"),
        ("please add a big red truck in lane 3", "big red"),
        ("add a car every full moon", "every full moon"),
        ("add five potholes unless it rains", "unless it rains"),
        ("turn left at the second traffic light", "at the second traffic light"),
        ("remove the cars that are red", "that are red"),
        ("order a pizza and pause", "order a pizza"),
        ("honk the horn", "honk the horn"),
        ("more cowbell", "cowbell"),
    ],
)
def test_the_smallest_stretch_is_named(language: Language, text: str, named: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Refused)
    assert parsed.unparsed == (named,)


@pytest.mark.parametrize(
    ("text", "named", "first"),
    [
        ("füge 5 Autos hinzu und mach mir ein Brot", "mach mir ein Brot", "füge 5 Autos hinzu"),
        ("stell drei Kegel auf den Mond", "auf den Mond", "stell drei Kegel"),
        ("halte in Hamburg an", "in Hamburg", "halte an"),
        ("füge fünf Schlaglöcher hinzu, außer es regnet", "außer es regnet", "füge fünf Schlaglöcher hinzu"),
    ],
)  # fmt: skip
def test_in_german_too(german: Language, text: str, named: str, first: str) -> None:
    parsed = german.parse(text)
    assert isinstance(parsed, Refused)
    assert parsed.unparsed == (named,)
    assert parsed.suggestions[0] == first


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("add five potholes and make me a sandwich", "add five potholes"),
        ("put three cones on the moon", "put three cones"),
        ("add five sandwiches", "add five potholes"),
        ("add two cars in the sky and three potholes", "add two cars and three potholes"),
        ("why is the sky blue", "why did you do that"),
        ("what if nobody had yielded to temptation?", "what if nobody had yielded?"),
    ],
)
def test_what_is_left_or_the_like_is_suggested(language: Language, text: str, first: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Refused)
    assert parsed.suggestions[0] == first


@pytest.mark.parametrize(
    "text",
    ["full screen", "honk the horn", "delete my account", "reset my password", "fly", "go to sleep",
     "undo my last email", "make me a sandwich"],
)  # fmt: skip
def test_nothing_is_suggested_where_nothing_is_like_it(language: Language, text: str) -> None:
    parsed = language.parse(text)
    assert isinstance(parsed, Refused)
    assert parsed.suggestions == ()


def test_what_shall_not_be_done_is_not_suggested(language: Language) -> None:
    for text in ("don't add any potholes", "never add five potholes on the moon"):
        parsed = language.parse(text)
        assert isinstance(parsed, Refused)
        assert [say for say in parsed.suggestions if "add" in say] == []


def test_suggestions_parse_and_lose_nothing_that_was_not_spoken_of(language: Language) -> None:
    seen = 0
    for text in beside("refuse"):
        parsed = language.parse(text)
        if not isinstance(parsed, Refused):
            continue
        said = {concept for each in language.meanings(text) for concept, _ in each.all}
        for suggestion in parsed.suggestions:
            meant = language.parse(suggestion)
            assert isinstance(meant, Understood), (text, suggestion)
            seen += 1
            if any(traits_of(action).loses for action in meant.actions):
                own = {concept for each in language.meanings(suggestion) for concept, _ in each.all}
                assert len(own & said) > 1, (text, suggestion)
    assert seen > 20
