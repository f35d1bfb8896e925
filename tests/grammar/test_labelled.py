"""Labelled sentences by other authors: no wrong action, ever, and nearly all exact."""

from __future__ import annotations

import random
import string
from functools import cache

import pytest

from service.actions import dump
from service.grammar import Language, Understood
from service.grammar.evaluation import Labelled, Report, evaluate, read_labelled, render, same
from tests.grammar.beside import HERE


@cache
def evaluated(language: Language, file: str) -> Report:
    """What became of each sentence of a file."""
    return evaluate(language, HERE / file)


@pytest.mark.parametrize(
    ("file", "least_exact"),
    [
        ("dev.jsonl", 0.99),
        ("fresh_a.jsonl", 0.98),
        ("fresh_b.jsonl", 0.88),
        ("fresh_c.jsonl", 0.98),
        ("fresh_d.jsonl", 0.98),
        ("fresh_e.jsonl", 0.97),
        ("fresh_f.jsonl", 0.99),
        ("fresh_g.jsonl", 0.94),
        ("fresh_i.jsonl", 0.98),
        ("fresh_j.jsonl", 0.99),
    ],
)
def test_no_wrong_action_and_nearly_all_exact(language: Language, file: str, least_exact: float) -> None:
    report = evaluated(language, file)
    assert report.total("wrong") == 0, render(report)
    assert report.total("exact") >= least_exact * report.total(), render(report)


@pytest.mark.parametrize("file", sorted(path.name for path in HERE.glob("*.jsonl")))
def test_what_must_be_refused_or_asked_about_is(language: Language, file: str) -> None:
    counts = evaluated(language, file).counts
    for intent in ("(refuse)", "(clarify)"):
        assert counts[intent]["exact"] == counts[intent].total() > 0


def typo(word: str, chance: random.Random) -> str:
    """The word with one random edit: a letter dropped, doubled by another, changed, or two swapped."""
    at = chance.randrange(len(word) - 1)
    letter = chance.choice(string.ascii_lowercase)
    return chance.choice(
        [
            word[:at] + word[at + 1 :],
            word[:at] + letter + word[at:],
            word[:at] + letter + word[at + 1 :],
            word[:at] + word[at + 1] + word[at] + word[at + 2 :],
        ]
    )


def misspelt(row: Labelled, language: Language, chance: random.Random) -> str | None:
    """The sentence with a typo in one long word that makes no other known word, or None."""
    words = row.text.split(" ")
    long = [at for at, word in enumerate(words) if len(word) >= 6 and word.isalpha()]
    if not long:
        return None
    at = chance.choice(long)
    changed = typo(words[at], chance)
    if language.data.knows(changed.lower()) or changed == words[at]:
        return None
    return " ".join([*words[:at], changed, *words[at + 1 :]])


def test_a_typo_never_makes_a_wrong_action(language: Language) -> None:
    chance = random.Random(20)
    rows = [row for row in read_labelled(HERE / "dev.jsonl") if not _names_something(row)]
    tried = read = 0
    for row in rows * 3:
        text = misspelt(row, language, chance)
        if text is None:
            continue
        tried += 1
        parsed = language.parse(text)
        if isinstance(parsed, Understood):
            read += 1
            assert row.actions, text
            assert same(dump(parsed.actions), row.actions), text
            assert parsed.corrections, text
    assert tried > 300
    assert read > tried / 2


def _names_something(row: Labelled) -> bool:
    """Names are kept as written, typos and all."""
    return any(action["do"] in ("save", "load") for action in row.actions)
