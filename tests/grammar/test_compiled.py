from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from service.cache_files import FOLDER_VARIABLE
from service.grammar import Language, LanguageDataError, Understood
from service.grammar import compiled as module
from service.grammar.compiled import load_language
from service.grammar.data import read_language
from service.grammar.lexicon_codec import pack, unpack
from service.resources import prompts_folder


@pytest.fixture
def german(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the smaller language, and a cache of its own."""
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path / "cache"))
    folder = tmp_path / "de"
    shutil.copytree(prompts_folder() / "language" / "de", folder)
    return folder


def forbid_building(monkeypatch: pytest.MonkeyPatch) -> None:
    def building(folder: Path) -> None:
        raise AssertionError(f"{folder} is read again")

    monkeypatch.setattr(module, "read_parts", building)


def test_a_language_is_the_same_from_its_compiled_form(german: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    built = load_language(german)
    forbid_building(monkeypatch)
    cached = load_language(german)
    assert phrases(cached) == phrases(built)
    assert cached.frames == built.frames
    assert list(cached.lexicon.typical.items()) == list(built.lexicon.typical.items())
    for part in ("numbers", "contractions", "typos", "parameters", "messages", "lanes", "sentences", "nouns"):
        assert getattr(cached, part) == getattr(built, part)
    for text in ("füge drei Schlaglöcher hinzu", "entferne das letzte Auto", "warum hast du gebremst?"):
        assert Language(cached).parse(text) == Language(built).parse(text)


def test_a_changed_file_is_read_again(german: Path) -> None:
    load_language(german)
    moves = german / "lexicon" / "verbs.yaml"
    moves.write_text(moves.read_text("utf-8").replace("v.add:\n", "v.add:\n  - schnurpse\n", 1), "utf-8")
    assert "schnurpse" in moves.read_text("utf-8")
    parsed = Language(load_language(german)).parse("schnurpse drei Schlaglöcher")
    assert isinstance(parsed, Understood)
    assert len(parsed.actions) == 1


def test_unfit_files_are_refused_also_where_fit_ones_are_kept(german: Path) -> None:
    load_language(german)
    (german / "intents" / "odd.yaml").write_text('frames: {odd: {needs: "v.nothing", do: []}}', "utf-8")
    for _ in range(2):
        with pytest.raises(LanguageDataError, match="odd"):
            load_language(german)


def test_packing_is_lossless_for_every_node() -> None:
    lexicon = read_language(prompts_folder() / "language" / "de").lexicon
    assert pack(unpack(pack(lexicon))) == pack(lexicon)


def phrases(data: object) -> dict[tuple[str, ...], str]:
    return {words: repr(senses) for words, senses in data.lexicon.phrases()}  # type: ignore[attr-defined]
