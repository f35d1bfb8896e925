"""Leaves out of a question what does not change it: "which car is most dangerous to us, in your opinion?".

The words stand in `prompts/questions/<code>/fillers.yaml`. What is left has to be a sentence of the grammar;
the answer says as what the question was read.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from service.question_matcher.phrases import any_of
from service.yaml_files import read_yaml

FILE = "fillers.yaml"
MAX_TRIED = 8
"""Readings of one text: each is parsed."""
LEAST_WORDS = 4
"""Words of a sentence that does not lean on the one before: "how come?" does."""
MAX_SINGLE = 4
"""Fillers up to which each is also left out alone."""
_SENTENCE = re.compile(r"(?<=[.!?;:\n])\s+|\s+[-\u2013\u2014]+\s+")
_STRAY = re.compile(r"\s*(?:,\s*)+(?=[,.;:!?]|$)|^[\s,.;:!-]+|(?<=,)\s*,")


class Fillers:
    """The fillers of one language."""

    def __init__(self, folder: Path) -> None:
        """`folder`: of `prompts/questions`. Its file is read at the first question."""
        self._folder = folder

    def without(self, text: str) -> tuple[str, ...]:
        """The text with fewer and fewer of its fillers, and its last sentence alone; never the text itself.

        A sentence that asks or supposes something is not left out, nor one that a few words lean on, or words
        that refer to it.
        """
        found = [*self._shorter(text)]
        *before, last = [each for each in _SENTENCE.split(text.strip()) if each.strip()] or [""]
        words = re.findall(r"[\w']+", last.casefold())
        whole = len(words) >= LEAST_WORDS and self._leaning.isdisjoint(words)
        if before and whole and not any(each.endswith("?") or self._supposes(each) for each in before):
            found += [last, *self._shorter(last)]
        return tuple(dict.fromkeys(each for each in found if each and each != text))[:MAX_TRIED]

    def _shorter(self, text: str) -> list[str]:
        fillers = [match.span() for match in self._pattern.finditer(text)]
        alone = [[each] for each in fillers] if 1 < len(fillers) <= MAX_SINGLE else []
        return [_cut(text, spans) for spans in [*alone, fillers] if spans]

    def _supposes(self, sentence: str) -> bool:
        return not self._supposing.isdisjoint(re.findall(r"[\w']+", sentence.casefold()))

    @cached_property
    def _data(self) -> Mapping[str, Any]:
        data: Mapping[str, Any] = read_yaml(self._folder / FILE)
        return data

    @cached_property
    def _leaning(self) -> frozenset[str]:
        return frozenset(self._data["leaning"])

    @cached_property
    def _supposing(self) -> frozenset[str]:
        return frozenset(self._data["supposing"])

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        return any_of(self._data["fillers"])


def _cut(text: str, spans: Sequence[tuple[int, int]]) -> str:
    """The text without some stretches, and without the commas that stood around them."""
    for start, end in reversed(spans):
        text = f"{text[:start]} {text[end:]}"
    while text != (text := _STRAY.sub("", text)):
        pass
    return re.sub(r"\s+(?=[,.;:!?])", "", " ".join(text.split()))
