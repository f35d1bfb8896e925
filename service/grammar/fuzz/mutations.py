"""Changes a sentence so that its words mean something else, or so that they do not.

A mutation knows what it did: one that is `neutral` must leave the actions as they were, all others must not.
That holds whatever the grammar makes of the words, so the grammar is not its own judge. The words are in
`fuzz.yaml` of a language.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from service.grammar.fuzz.sayings import Saying
from service.grammar.fuzz.vocabulary import Vocabulary

NEUTRAL = "polite"
"""The kind of mutation that must change nothing."""

NUMBER, DROPPED = "number", "drop "
"""The kind that replaces a number; what the names of kinds begin with that leave a word out."""

SENTENCE, AMOUNT = "…", "#"
"""Marks in words that are put in: where the sentence stands, and a number of it."""

MARKS = ",;."
"""Marks that may end a word that is replaced."""

Changed = tuple[list[str], str]
"""The words of a mutant, and those that were put in or taken out."""


@dataclass(frozen=True, slots=True)
class Mutant:
    """A changed sentence."""

    kind: str
    source: Saying
    text: str
    change: str = ""
    """the words that were put in, or taken out"""


class Mutations:
    """Makes mutants of sentences, each kind in its turn."""

    def __init__(self, words: Vocabulary, seed: int) -> None:
        """`words`: what sentences are changed with."""
        self._words = words
        self._chance = random.Random(seed)
        self._kinds: dict[str, Callable[[list[str]], Changed | None]] = {
            kind: self._inserting(kind) for kind in words.insert
        }
        for kind in words.replace:
            self._kinds[kind] = self._replacing(kind)
            if kind not in words.kept:
                self._kinds[DROPPED + kind] = self._dropping(kind)
        if words.numbered:
            self._kinds |= {NUMBER: self._other_number, DROPPED + NUMBER: self._dropped_number}

    @property
    def kinds(self) -> tuple[str, ...]:
        """The names of all kinds."""
        return tuple(self._kinds)

    def inserts(self, kind: str) -> bool:
        """Whether a kind puts words in; the others replace or leave out words that are there."""
        return kind in self._words.insert

    def of(self, saying: Saying, kind: str) -> Mutant | None:
        """A mutant of a sentence; None where this kind has no place in it."""
        if '"' in saying.text:
            return None  # what is in quotation marks means itself
        changed = self._kinds[kind](saying.text.rstrip(" .!?").split(" "))
        if changed is None:
            return None
        text = " ".join(changed[0])
        return None if text == saying.text else Mutant(kind, saying, text, changed[1])

    def _inserting(self, kind: str) -> Callable[[list[str]], Changed | None]:
        """Puts words of this kind in, at their mark, or anywhere where they have none."""

        def insert(words: list[str]) -> Changed | None:
            chosen = self._chance.choice(self._words.insert[kind])
            if SENTENCE in chosen:
                return self._around(chosen, words)
            if AMOUNT in chosen:
                return self._beside_number(chosen, words)
            at = self._chance.randrange(len(words) + 1)
            return [*words[:at], *chosen.split(), *words[at:]], chosen

        return insert

    def _around(self, chosen: str, words: list[str]) -> Changed | None:
        """The sentence with words before or after it; "{ing}" stands for its verb in that form."""
        before, _, after = chosen.partition(SENTENCE)
        said = words
        for form in ("ing", "past"):
            if "{" + form + "}" in before:
                forms = self._words.forms.get(words[0].casefold())
                if forms is None:
                    return None
                before, said = before.replace("{" + form + "}", forms[form]), words[1:]
        return [*before.split(), *said, *after.split()], chosen

    def _beside_number(self, chosen: str, words: list[str]) -> Changed | None:
        at = self._numbers(words)
        if not at:
            return None
        place = self._chance.choice(at)
        said = [words[place] if each == AMOUNT else each for each in chosen.split()]
        return [*words[:place], *said, *words[place + 1 :]], chosen

    def _replacing(self, kind: str) -> Callable[[list[str]], Changed | None]:
        """Puts one phrase of a list in the place of another of it."""

        def replace(words: list[str]) -> Changed | None:
            found = self._found(kind, words)
            if not found:
                return None
            at, end, group = self._chance.choice(found)
            said = " ".join(words[at:end])
            bare = said.rstrip(MARKS)
            chosen = self._chance.choice([each for each in group if each != bare.casefold()])
            mark = said[len(bare) :]
            return [*words[:at], *(chosen + mark).split(), *words[end:]], f"{bare.casefold()} > {chosen}"

        return replace

    def _dropping(self, kind: str) -> Callable[[list[str]], Changed | None]:
        """Leaves out a phrase of the lists."""

        def drop(words: list[str]) -> Changed | None:
            found = self._found(kind, words)
            if not found:
                return None
            at, end, _ = self._chance.choice(found)
            return [*words[:at], *words[end:]], " ".join(words[at:end]).rstrip(MARKS).casefold()

        return drop

    def _found(self, kind: str, words: Sequence[str]) -> list[tuple[int, int, Sequence[str]]]:
        """Where phrases of the lists of a kind stand, the longest at each place."""
        folded = [word.casefold().rstrip(MARKS) for word in words]
        found: dict[int, tuple[int, int, Sequence[str]]] = {}
        for group in self._words.replace[kind]:
            for phrase in group:
                parts = phrase.split()
                for at in range(len(folded) - len(parts) + 1):
                    end = at + len(parts)
                    if folded[at:end] == parts and end > found.get(at, (0, 0, ()))[1]:
                        found[at] = at, end, group
        return list(found.values())

    def _other_number(self, words: list[str]) -> Changed | None:
        at = self._numbers(words)
        if not at:
            return None
        place = self._chance.choice(at)
        others = [each for each in self._words.numbers if each != words[place].casefold()]
        chosen = self._chance.choice(others)
        return [*words[:place], chosen, *words[place + 1 :]], f"{words[place]} > {chosen}"

    def _dropped_number(self, words: list[str]) -> Changed | None:
        at = self._numbers(words)
        if not at:
            return None
        place = self._chance.choice(at)
        return [*words[:place], *words[place + 1 :]], words[place]

    def _numbers(self, words: Sequence[str]) -> list[int]:
        return [at for at, word in enumerate(words) if word.casefold() in self._words.numbered]
