"""Splits a text that asks several things: "how far is the goal, and when do we get there?".

A part has to be a question by itself: one that leans on the part before it ("and was that needed?") is
known by its words and marked so. The words stand in `prompts/questions/<code>/parts.yaml`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from service.yaml_files import read_yaml

FILE = "parts.yaml"
MAX_PARTS = 3
LEAST_WORDS = 3
"""Words of a part that is read by itself: "and why?" is not."""
_SENTENCE = re.compile(r"(?<=[?!.;])\s+")
_WORD = re.compile(r"[\w']+")


@dataclass(frozen=True, slots=True)
class Part:
    """One of the questions of a text."""

    text: str
    is_stump: bool
    """whether it is too short to be asked by itself, as "and why?" is"""
    leans: bool
    """whether its words refer to the part before it"""
    leans_on_a_thing: bool
    """whether they do where that part names another thing than the vehicle"""
    asks_for_a_thing: bool
    """whether it asks which thing it is, as "what is in front of us?" does"""


class Parts:
    """The splitter of one language."""

    def __init__(self, folder: Path) -> None:
        """`folder`: of `prompts/questions`. Its file is read at the first question."""
        self._folder = folder

    def of(self, text: str) -> tuple[Part, ...]:
        """The questions of a text, two or more; empty where it is one, or holds what is no question."""
        sentences = [each for each in _SENTENCE.split(text.strip()) if _WORD.search(each)]
        texts = [part for sentence in sentences for part in self._split(sentence)]
        if not 1 < len(texts) <= MAX_PARTS or not all(map(self._asks, texts)):
            return ()
        return tuple(self._part(each, later=at > 0) for at, each in enumerate(texts))

    def _split(self, sentence: str) -> Sequence[str]:
        """A sentence where a question begins within it; whole where its beginning is none."""
        first, *rest = self._inner.split(sentence)
        return [first, *rest] if rest and self._opens(first) else [sentence]

    def _asks(self, text: str) -> bool:
        return self._opens(text) or text.endswith("?")

    def _opens(self, text: str) -> bool:
        first, then, *_ = [*(word.casefold() for word in _WORD.findall(text)), "", ""]
        beside = self._data.get("subordinate")
        if beside is not None and first in beside["openings"] and then in beside["before"]:
            return False
        return first in self._openings

    def _part(self, text: str, *, later: bool) -> Part:
        words = [word.casefold() for word in _WORD.findall(text)]
        is_stump = len(words) < LEAST_WORDS
        leans = later and (is_stump or not self._leaning.isdisjoint(words[1:]))
        leans_on_a_thing = later and not self._ego.isdisjoint(words)
        return Part(text, is_stump, leans, leans_on_a_thing, bool(words) and words[0] in self._asking_for_one)

    @cached_property
    def _data(self) -> Mapping[str, Any]:
        data: Mapping[str, Any] = read_yaml(self._folder / FILE)
        return data

    @cached_property
    def _openings(self) -> frozenset[str]:
        return frozenset(self._data["openings"])

    @cached_property
    def _leaning(self) -> frozenset[str]:
        return frozenset(self._data["leaning"])

    @cached_property
    def _ego(self) -> frozenset[str]:
        return frozenset(self._data["ego"])

    @cached_property
    def _asking_for_one(self) -> frozenset[str]:
        return frozenset(self._data["asking_for_one"])

    @cached_property
    def _inner(self) -> re.Pattern[str]:
        """What stands between two questions of a sentence, where the second begins behind it."""
        joiners = "|".join(map(re.escape, sorted(self._data["joiners"], key=lambda each: (-len(each), each))))
        openings = "|".join(map(re.escape, sorted(self._openings, key=lambda each: (-len(each), each))))
        return re.compile(
            rf"(?:\s*[,;:]\s*(?:(?:{joiners})\s+)?|\s+[-\u2013\u2014]+\s+|\s+(?:{joiners})\s+)(?=(?:{openings})\b(?!'))",
            re.IGNORECASE,
        )
