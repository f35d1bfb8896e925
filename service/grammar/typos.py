"""Corrects one-edit typos in long words, and reports each.

The distance is Damerau's (one letter wrong, missing, extra, or two swapped). A word is only repaired when it
is unknown, long enough, not a real word that merely looks like one of ours (`typos.yaml` lists those), and
one candidate alone is near it. Number words are never guessed: "eigth" might cost a pothole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class TypoRules:
    """What is never repaired, and how long words must be (letters), from `typos.yaml`."""

    shortest_written: int
    shortest_meant: int
    never: frozenset[str]
    capital_names: bool = False
    """whether a word with a capital in the midst of a sentence is a name, which is never repaired"""

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> TypoRules:
        """From the YAML's mapping."""
        return cls(
            int(data["shortest_written"]),
            int(data["shortest_meant"]),
            frozenset(str(data["never"]).split()),
            bool(data.get("capital_names", False)),
        )


_ENDS = ".!?:;\"'(“"
"""Marks after which a sentence or a quotation begins."""


class Typos:
    """Finds the word meant."""

    def __init__(
        self,
        rules: TypoRules,
        words: Iterable[str],
        number_words: frozenset[str],
        same: Callable[[str, str], bool],
    ) -> None:
        """`same` says whether two words of the vocabulary mean the same (then either will do)."""
        self._rules = rules
        self._numbers = number_words
        self._same = same
        self._by_shape: dict[str, list[str]] = {}
        self.words = frozenset(words)
        """the vocabulary"""
        for word in self.words:
            if len(word) >= rules.shortest_meant:
                for shape in _shapes(word):
                    self._by_shape.setdefault(shape, []).append(word)

    def is_name(self, written: str, before: str) -> bool:
        """Whether a word is a name by its capital; `before`: what is written before it in the sentence."""
        begins = not before.strip() or before.rstrip()[-1] in _ENDS
        return self._rules.capital_names and written.istitle() and not begins

    def repair(self, word: str) -> str | None:
        """The one word meant by an unknown word, or None."""
        near = self.near(word)
        if not near:
            return None
        best = min(near, key=lambda other: (other[-1] != word[-1], len(other) != len(word), other))
        return best if all(other == best or self._same(best, other) for other in near) else None

    def near(self, word: str) -> list[str]:
        """The words that an unknown word may be, in alphabetical order; none where a number is near."""
        if len(word) < self._rules.shortest_written or len(word) > 30 or word in self._rules.never:
            return []
        near = {other for shape in _shapes(word) for other in self._by_shape.get(shape, ())}
        near = {other for other in near if within_one_edit(word, other)}
        return [] if near & self._numbers else sorted(near)


def _shapes(word: str) -> set[str]:
    """The word and every word that is one letter shorter: two words one edit apart share one."""
    return {word, *(word[:at] + word[at + 1 :] for at in range(len(word)))}


def within_one_edit(a: str, b: str) -> bool:
    """Whether two words are equal or one Damerau edit apart."""
    if a == b:
        return True
    if abs(len(a) - len(b)) > 1:
        return False
    start = 0
    while start < min(len(a), len(b)) and a[start] == b[start]:
        start += 1
    if len(a) == len(b):
        swapped = a[start : start + 2] == b[start : start + 2][::-1] and a[start + 2 :] == b[start + 2 :]
        return swapped or a[start + 1 :] == b[start + 1 :]
    longer, shorter = (a, b) if len(a) > len(b) else (b, a)
    return longer[start + 1 :] == shorter[start:]
