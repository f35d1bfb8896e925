"""The sentences beside the data mean what they say; near misses are refused; pairs differ."""

from __future__ import annotations

from service.grammar import Ambiguous, Language, Refused
from service.grammar.evaluation import same
from tests.grammar.beside import beside, meaning


def test_every_sentence_beside_the_data_means_what_is_written(language: Language) -> None:
    entries = beside("means")
    wrong = [
        (say, got)
        for entry in entries
        for say in entry["say"]
        if not same(got := meaning(language, say), entry["do"])
    ]
    assert sum(len(entry["say"]) for entry in entries) > 1000
    assert not wrong


def test_every_near_miss_is_refused(language: Language) -> None:
    sentences = beside("refuse")
    assert len(sentences) > 150
    assert [say for say in sentences if not isinstance(language.parse(say), Refused)] == []


def test_every_ambiguity_is_asked_about(language: Language) -> None:
    sentences = beside("ask")
    assert sentences
    assert [say for say in sentences if not isinstance(language.parse(say), Ambiguous)] == []


def test_minimal_pairs(language: Language) -> None:
    pairs = beside("pairs")
    assert len(pairs) >= 60
    wrong = [
        (pair[side], got)
        for pair in pairs
        for side in ("a", "b")
        if not same(got := meaning(language, pair[side]), pair[f"{side}_do"])
    ]
    assert not wrong
