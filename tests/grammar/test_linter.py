"""Planted defects are found, and the real data have none."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from service.grammar import Language, LanguageDataError, Refused
from tests.grammar.beside import FOLDER


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A folder with a copy of the language, to be spoilt."""
    shutil.copytree(FOLDER, tmp_path / "en")
    return tmp_path


def append(path: Path, text: str) -> None:
    path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")


def test_the_language_has_no_defects(language: Language) -> None:
    assert language.check() == []


@pytest.mark.parametrize(
    ("file", "text", "said"),
    [
        ("lexicon/values.yaml", "weather/x:\n  rain: drizzling\n  snow: drizzling\n", "'drizzling' is both"),
        ("lexicon/values.yaml", "colour: red, green\n", "nothing takes the concept colour"),
        ("intents/show.yaml", "  odd: {needs: nowhere, do: {do: pause}}\n", "needs nowhere"),
        ("intents/show.yaml", "  odd: {needs: view, takes: nowhere, do: {do: pause}}\n", "takes nowhere"),
        ("intents/show.yaml", "  odd: {needs: view}\n", "neither actions nor a question"),
        ("intents/show.yaml", "  odd: {needs: view, wants: log}\n", "no such fields: wants"),
        ("intents/show.yaml", "  pause: {needs: view, do: {do: pause}}\n", "pause is there twice"),
        ("lexicon/values.yaml", "weather/x:\n  rain: [damp, damp]\n", "'damp' is already among"),
        (
            "lexicon/values.yaml",
            "weather/x:\n  rain: [(damp|moist) air, damp air]\n",
            "'damp air' is already",
        ),
        ("lexicon/values.yaml", "weather/y:\n  rain: (a|b\n", "never closed"),
        ("lexicon/values.yaml", "weather/z:\n  rain: <nosuch> rain\n", "no macro is called"),
    ],
)
def test_a_planted_defect_stops_the_loading(copy: Path, file: str, text: str, said: str) -> None:
    append(copy / "en" / file, text)
    with pytest.raises(LanguageDataError, match=said):
        Language.load(folder=copy)


def test_a_saying_that_does_not_parse_is_found(copy: Path) -> None:
    append(copy / "en" / "intents/show.yaml", "  odd: {say: [sing a song], needs: view, do: {do: pause}}\n")
    assert any("sing a song" in defect for defect in Language.load(folder=copy).check())


def test_a_saying_that_is_refused_is_found_and_no_suggestion(copy: Path) -> None:
    """A refusal names suggestions, which are made of sayings: reading a refused one must not begin again."""
    impossible = "  odd: {say: [paint the log], needs: odd_word view, do: {do: step, ticks: -3}}\n"
    append(copy / "en" / "intents/show.yaml", impossible)
    append(copy / "en" / "lexicon/values.yaml", "odd_word: paint\n")
    language = Language.load(folder=copy, offered=lambda _: True)
    assert language.suggestions.nearest("paint the log", language.meanings("paint the log"))
    refused = language.parse("paint the log")
    assert isinstance(refused, Refused)
    assert "paint the log" not in refused.suggestions
    assert any("paint the log" in defect for defect in language.check())


def test_a_missing_language_says_where_it_was_sought(tmp_path: Path) -> None:
    with pytest.raises(LanguageDataError, match="no language"):
        Language.load("xx", tmp_path)


def test_a_frame_that_drops_what_it_takes_is_found(copy: Path) -> None:
    frame = "  odd: {needs: view, takes: weather, do: {do: show, view: $view}}\n"
    append(copy / "en" / "intents/show.yaml", frame)
    assert "frame odd takes weather and drops it" in Language.load(folder=copy).check()


def test_a_frame_may_say_what_it_drops(copy: Path) -> None:
    frame = "  odd: {needs: view, takes: weather, drops: weather, do: {do: show, view: $view}}\n"
    append(copy / "en" / "intents/show.yaml", frame)
    assert not any("drops" in defect for defect in Language.load(folder=copy).check())
