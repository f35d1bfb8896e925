"""The examples that the question matcher's classifiers are learnt from, and their digest."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from service.question_matcher.kinds import read_kinds
from service.question_matcher.situations import Situation
from service.yaml_files import read_yaml

EXAMPLES, ASKED, WORDS = "examples.yaml", "asked.yaml", "words.yaml"


class Example(NamedTuple):
    """A question that is learnt from."""

    text: str
    kinds: tuple[str, ...]
    """those that answer it, the best first"""
    situation: Situation | None = None
    """what the session was like in which it was asked, where that is known"""


def sources_of(folder: Path) -> str:
    """The digests of what is learnt from and of the words of slots."""
    return f"{learnt_from(folder)} {hashlib.sha256((folder / WORDS).read_bytes()).hexdigest()}"


def learnt_from(folder: Path) -> str:
    """The digest of what is learnt from: the questions and the names of the kinds."""
    files = [folder / name for name in (EXAMPLES, ASKED) if (folder / name).exists()]
    parts = [*(file.read_bytes() for file in files), *(name.encode() for name in read_kinds(folder))]
    return hashlib.sha256(b"\n".join(parts)).hexdigest()


def examples_of(folder: Path) -> list[Example]:
    """The questions that were written for one kind each."""
    data: Mapping[str, Sequence[str]] = read_yaml(folder / EXAMPLES)
    return [Example(text, (kind,)) for kind, texts in data.items() for text in texts]


def asked_of(folder: Path) -> list[Example]:
    """The questions of people who knew nothing of the kinds; a language may have none.

    The file lists them by situation, and then by the kinds that answer them, the best first: "why_move, why".
    """
    if not (folder / ASKED).exists():
        return []
    data: Mapping[Situation, Mapping[str, Sequence[str]]] = read_yaml(folder / ASKED)
    return [
        Example(text, tuple(kinds.split(", ")), situation)
        for situation, by_kinds in data.items()
        for kinds, texts in by_kinds.items()
        for text in texts
    ]
