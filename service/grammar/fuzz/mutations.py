"""Changes a sentence so that its words mean something else, or so that they do not.

A mutation knows what it did: one that is `neutral` must leave the actions as they were, all others must not.
That holds whatever the grammar makes of the words, so the grammar is not its own judge. The words are in
`fuzz.yaml` of a language.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from service.grammar.fuzz.sayings import Saying

NEUTRAL = "polite"
"""The kind of mutation that must change nothing."""


@dataclass(frozen=True, slots=True)
class Mutant:
    """A changed sentence."""

    kind: str
    source: Saying
    text: str


class Mutations:
    """Makes mutants of sentences, each kind in its turn."""

    def __init__(self, words: Mapping[str, Sequence[str]], seed: int) -> None:
        """`words`: those that are put in, by the kind of mutation."""
        self._words = words
        self._chance = random.Random(seed)
        self._kinds: dict[str, Callable[[list[str]], list[str] | None]] = {
            kind: self._inserting(kind) for kind in words if kind not in ("numbers", "swapped", "numbered")
        }
        self._kinds |= {"number": self._other_number, "swap": self._swapped, "drop": self._dropped_number}

    @property
    def kinds(self) -> tuple[str, ...]:
        """The names of all kinds."""
        return tuple(self._kinds)

    def of(self, saying: Saying, kind: str) -> Mutant | None:
        """A mutant of a sentence; None where this kind has no place in it."""
        if '"' in saying.text:
            return None  # what is in quotation marks means itself
        words = self._kinds[kind](saying.text.rstrip(" .!?").split(" "))
        text = "" if words is None else " ".join(words)
        return None if words is None or text == saying.text else Mutant(kind, saying, text)

    def _inserting(self, kind: str) -> Callable[[list[str]], list[str] | None]:
        """Puts words of this kind in: at the end where "…" begins them, at the start where it ends them."""

        def insert(words: list[str]) -> list[str] | None:
            chosen = self._chance.choice(self._words[kind])
            if chosen.startswith("…"):
                return [*words, *chosen.removeprefix("…").split()]
            if chosen.endswith("…"):
                return [*chosen.removesuffix("…").split(), *words]
            at = self._chance.randrange(len(words) + 1)
            return [*words[:at], *chosen.split(), *words[at:]]

        return insert

    def _other_number(self, words: list[str]) -> list[str] | None:
        at = self._numbers(words)
        if not at:
            return None
        place = self._chance.choice(at)
        others = [each for each in self._words["numbers"] if each != words[place].casefold()]
        return [*words[:place], self._chance.choice(others), *words[place + 1 :]]

    def _dropped_number(self, words: list[str]) -> list[str] | None:
        at = self._numbers(words)
        if not at:
            return None
        place = self._chance.choice(at)
        return [*words[:place], *words[place + 1 :]]

    def _swapped(self, words: list[str]) -> list[str] | None:
        """One of the small words that decide ("to", "by") in the place of another."""
        swaps = [group.split() for group in self._words["swapped"]]
        found = [(at, group) for at, word in enumerate(words) for group in swaps if word.casefold() in group]
        if not found:
            return None
        at, group = self._chance.choice(found)
        others = [each for each in group if each != words[at].casefold()]
        return [*words[:at], self._chance.choice(others), *words[at + 1 :]]

    def _numbers(self, words: Sequence[str]) -> list[int]:
        return [at for at, word in enumerate(words) if word.casefold() in self._words["numbered"]]
