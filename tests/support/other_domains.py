"""Sentences that are none of the simulator's business: by hand, from patterns, and from lists of words.

The words are in `tests/data/language/other_domains/`; here is only how they are put together, always alike.
"""

from __future__ import annotations

import random
import string
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

from service.yaml_files import read_yaml

FOLDER = Path(__file__).parents[1] / "data" / "language" / "other_domains"

PATTERNS = ("patterns.yaml", "near_misses.yaml")
"""Files of patterns: by subject, what is said and what may stand in each slot."""

PER_SUBJECT = 90
"""How many sentences of one subject are made where nothing else is asked for."""


def by_hand() -> Iterator[str]:
    """The sentences written by hand, subject after subject."""
    for said in read_yaml(FOLDER / "sentences.yaml").values():
        yield from map(str, said)


def from_patterns(count: int = PER_SUBJECT, seed: int = 0) -> Iterator[str]:
    """As many different sentences of each subject, its patterns in turn."""
    for name in PATTERNS:
        for subject, grammar in read_yaml(FOLDER / name).items():
            yield from _generated(grammar, count, random.Random(f"{seed} {subject}"))


def _generated(grammar: Mapping[str, Any], count: int, chance: random.Random) -> list[str]:
    found: dict[str, None] = {}
    patterns = grammar["say"]
    for turn in range(count * 20):
        if len(found) == count:
            break
        found[_filled(patterns[turn % len(patterns)], grammar, chance)] = None
    return list(found)


def _filled(pattern: str, slots: Mapping[str, Any], chance: random.Random) -> str:
    """A pattern with every slot filled by one of the words for it."""
    named = [name for _, name, _, _ in string.Formatter().parse(pattern) if name]
    return pattern.format(**{name: chance.choice(str(slots[name]).split("|")) for name in named})


def short(count: int | None = None, seed: int = 0) -> list[str]:
    """Sentences of one to four words: idioms, and verbs with objects of other worlds, or some of these."""
    words = read_yaml(FOLDER / "words.yaml")
    pairs = product(words["frames"], words["verbs"].split(), words["objects"].split())
    made = [frame.format(verb=verb, object=each) for frame, verb, each in pairs]
    if count is not None:
        made = random.Random(seed).sample(made, count)
    return [*map(str, words["one"]), *map(str, words["idioms"]), *made]


def once(said: Sequence[str]) -> list[str]:
    """Each sentence once, whatever its capitals."""
    return list({each.casefold(): each for each in reversed(said)}.values())[::-1]


def sentences(count: int = PER_SUBJECT, brief: int | None = 3_000, seed: int = 0) -> list[str]:
    """All kinds of sentences: `count` of each subject, `brief` made of two words."""
    return once([*by_hand(), *from_patterns(count, seed), *short(brief, seed)])
