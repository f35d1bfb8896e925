"""A few words with a question mark that name a thing or a value alone change nothing; wishes still do."""

from __future__ import annotations

import pytest

from service.grammar import Language, Refused, Understood


BARE = {
    "en": ["safe?", "fusion = ?", "fusion?", "rain?", "snow, right?", "left?", "stop?", "night?", "five potholes?"]
    + ["a car in lane 3?", "out of ten?", "100 runs?", "heavy traffic?", "the log?"],
    "de": ["Regen?", "Fusion?", "links?", "nachts?", "fünf Schlaglöcher?", "ein Auto auf Spur 3?"],
}
WISHES = {
    "en": ["could it rain?", "rain, please?", "may I have five potholes?", "add five potholes?", "how about rain?"]
    + ["can you stop recording?", "undo?", "rain", "how often do you crash in 200 runs?"],
    "de": ["kannst du es regnen lassen?", "Regen, bitte?", "Regen"],
}


@pytest.mark.parametrize("code", BARE)
def test_what_is_only_named_is_not_done(code: str) -> None:
    language = Language.load(code)
    for text in BARE[code]:
        parsed = language.parse(text)
        assert isinstance(parsed, Refused), text
        assert parsed.reason == "not_understood", text


def test_a_refusal_suggests_the_request_itself() -> None:
    language = Language.load("en")
    parsed = language.parse("five potholes?")
    assert isinstance(parsed, Refused)
    suggested, wanted = (language.parse(each) for each in (parsed.suggestions[0], "add five potholes"))
    assert isinstance(suggested, Understood)
    assert isinstance(wanted, Understood)
    assert suggested.actions == wanted.actions


@pytest.mark.parametrize("code", WISHES)
def test_what_is_wished_is_done(code: str) -> None:
    language = Language.load(code)
    for text in WISHES[code]:
        assert isinstance(language.parse(text), Understood), text
