"""Refusals: which words were not understood, and what can be said instead."""

from __future__ import annotations

from collections.abc import Sequence

from pydantic import ValidationError

from service.actions import load
from service.grammar.accounting import restored
from service.grammar.clause import Clause
from service.grammar.fragments import Fragment
from service.grammar.lattice import GLUE
from service.grammar.noun_phrases import Amount
from service.grammar.parse_types import Reason, Refused
from service.grammar.subordinate import read_all
from service.grammar.suggestions import meanings_of, turned_round
from service.grammar.unparsed_span import Gap, GapFinder
from service.grammar.utterance import Utterance
from service.grammar.work_budget import BudgetExceededError

MAX_UNPARSED = 8
"""How many stretches not understood a refusal names."""


class Refusing(Utterance):
    """Makes the refusals of one utterance."""

    def _impossible(self, clauses: Sequence[Clause]) -> Refused:
        """The refusal of actions whose values cannot be."""
        for clause in clauses:
            try:
                load(clause.actions)
            except ValidationError as error:
                phrase = self._written(clause.start, clause.end)
                return self._refusal("impossible", self._why_impossible(error, phrase), (phrase,))
        return self._refusal("impossible", self._messages["impossible"].format(phrase=self._text))

    def _why_impossible(self, error: ValidationError, phrase: str) -> str:
        """The message for values that cannot be; where a number is too small or too large, with its limit."""
        for each in error.errors(include_url=False):
            for bound, key in (("ge", "too_small"), ("le", "too_large")):
                limit = each.get("ctx", {}).get(bound)
                if limit is not None and key in self._messages:
                    told = f"{limit:,}".replace(",", self._messages.get("thousands", ","))
                    return self._messages[key].format(phrase=phrase, limit=told)
        return self._messages["impossible"].format(phrase=phrase)

    def _impossible_number(self, phrase: str, values: Sequence[object]) -> Refused:
        """The refusal of a request with a number that no count or place can be."""
        parts = any(isinstance(each, Amount) and isinstance(each.count, float) for each in values)
        key = "not_whole" if parts and "not_whole" in self._messages else "impossible"
        return self._refusal("impossible", self._messages[key].format(phrase=phrase), (phrase,))

    def _gap(self, unknown: Sequence[int], failed: Fragment | None) -> Gap | None:
        """The smallest stretches that hold what is unknown, or make a part fail, and what is left without."""
        if not self._suggests:
            return None
        finder = GapFinder(
            self._plain,
            self._tokens,
            self._lattice,
            lambda text, work: self._language.read(text, self._topic, work, asking=False),
            self._language.data.lexicon.leads_on,
        )
        return finder.find(unknown, failed)

    def _lost(self, part: Fragment) -> list[str]:
        """The markers of a part with what they stand with, where the part would be read without them."""
        inside = [each for each in self._lattice.withheld if part.start <= each.start < part.end]
        for tried in [*((each,) for each in inside[:MAX_UNPARSED]), inside]:
            with restored(self._lattice, tried, part.end):
                try:
                    read = read_all(self._lattice, 0, self._lattice.size, self._divide)
                except BudgetExceededError:
                    return []
            if not isinstance(read, Fragment) and (read.failed is None or read.failed.start > part.start):
                return [self._written(each.start, min(each.end, part.end)) for each in tried]
        return []

    def _refusal(
        self,
        reason: Reason,
        message: str,
        unparsed: tuple[str, ...] = (),
        understood: tuple[str, ...] = (),
        gap: Gap | None = None,
    ) -> Refused:
        suggestions: tuple[str, ...] = ()
        if self._suggests and reason != "negation":
            meanings, turned = meanings_of(self._lattice), turned_round(self._lattice)
            suggestions = self._language.suggestions.nearest(self._plain, meanings, harmless=turned, gap=gap)
        return Refused(self._text, reason, message, unparsed, understood, suggestions)

    def _stretches(self, unknown: list[int]) -> list[str]:
        """The stretches with unknown words; unknown words with only glue between them are one."""
        stretches: list[tuple[int, int]] = []
        marked = {each.start: each.end for each in self._lattice.withheld}
        for at in unknown:
            if at in marked:
                stretches.append((at, marked[at]))
                continue
            if stretches and self._only_glue(stretches[-1][1], at):
                stretches[-1] = (stretches[-1][0], at + 1)
            else:
                stretches.append((at, at + 1))
        return [self._written(start, end) for start, end in stretches]

    def _only_glue(self, start: int, end: int) -> bool:
        return all(
            any(edge.sense.concept == GLUE for edge in self._lattice.edges[at]) for at in range(start, end)
        )


def is_impossible(value: object) -> bool:
    """Whether a value is a number that no count or place can be: negative, or a part of a thing."""
    if isinstance(value, Amount):
        return isinstance(value.count, float) and not value.count.is_integer()
    return isinstance(value, int | float) and value < 0


def shorten(phrase: str, limit: int = 80) -> str:
    """A phrase as a message quotes it."""
    return phrase if len(phrase) <= limit else phrase[: limit - 1] + "…"
