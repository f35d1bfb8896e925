"""A run of the fuzzer: what became of every mutant and pair by kind, and which are suspicious."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from service.actions import dump
from service.grammar.engine import Language
from service.grammar.fragments import INTERJECTION
from service.grammar.fuzz.excuses import excused
from service.grammar.fuzz.mutations import NEUTRAL, Mutant, Mutations
from service.grammar.fuzz.pairs import WRONG, all_pairs, random_pairs, verdict
from service.grammar.fuzz.report import Report
from service.grammar.fuzz.sayings import DETAIL, Saying, Sayings
from service.grammar.fuzz.vocabulary import Vocabulary, vocabulary_of
from service.grammar.parse_types import Ambiguous, Understood
from service.grammar.paths import NEGATION
from service.grammar.span_patterns import REPAIR
from service.grammar.topic import ALONE
from service.grammar.work_budget import MOST_STEPS, WorkBudget

PAIRS = ("pairs", "questions")
"""Kinds that join sentences: any two, and each question with each request."""

SLOW = MOST_STEPS // 2
"""Steps from which a sentence counts as slow."""


class Fuzzer:
    """Mutates and joins the sentences of one language."""

    def __init__(self, language: Language, code: str, seed: int, sayings: Sayings | None = None) -> None:
        """`sayings`: those of the language, where they were read already, which takes seconds."""
        self._language = language
        self._sayings = sayings or Sayings(language, code)
        self._seed = seed
        self._words: Vocabulary = vocabulary_of(code)
        self._joiners = self._words.joiners
        self._mutations = Mutations(self._words, seed) if self._words else None
        self._chance = random.Random(f"{seed} sample")
        self._known: set[str] = set()
        """every text that was read"""

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of change that the language has words for."""
        return (*(self._mutations.kinds if self._mutations else ()), *(PAIRS if self._joiners else ()))

    def run(
        self,
        count: int,
        kinds: Sequence[str],
        tell: Callable[[int], None] = lambda _: None,
        *,
        sample: int = 0,
    ) -> Report:
        """Reads about as many sentences, as many of each kind; `tell` is called after some of them.

        The report shows `sample` of the variants that acted.
        """
        report = Report(sample_size=sample)
        for kind in kinds:
            each = max(1, count // len(kinds))
            done = 0
            for _ in self._pairs(kind, each, report) if kind in PAIRS else self._mutants(kind, each, report):
                done += 1
                if done % 100 == 0:
                    tell(100)
            tell(each - done // 100 * 100)
        return report

    def _mutants(self, kind: str, count: int, report: Report) -> Iterator[None]:
        said, chance = self._sayings_for(kind), random.Random(f"{self._seed} {kind}")
        made = 0
        for _ in range(count * 8):
            if made == count or self._mutations is None:
                return
            mutant = self._mutations.of(chance.choice(said), kind)
            if mutant is None or mutant.text in self._known:
                continue
            self._known.add(mutant.text)
            made += 1
            self._read(mutant, report)
            yield

    def _sayings_for(self, kind: str) -> Sequence[Saying]:
        """The sayings in which a mutation of this kind surely means something else.

        A question forbids nothing, a second negation may undo the first, and what is taken back or left out
        may as well be something else.
        """
        if kind == NEUTRAL:  # thanks are one more, and what opens a sentence ("right, …") no longer does
            return [each for each in self._sayings.all if self._may_be_asked_for(each)]
        puts_in = self._mutations is not None and self._mutations.inserts(kind)
        said = self._sayings.requests if puts_in else self._sayings.all
        return [each for each in said if not self._is_aside(each)]

    def _may_be_asked_for(self, saying: Saying) -> bool:
        """Whether it is no manners itself, goes on with nothing, and calls nobody."""
        if any(action["do"] == "chat" or action.get("about") == DETAIL for action in saying.actions[-1:]):
            return False
        return INTERJECTION not in self._language.concepts(saying.text)

    def _is_aside(self, saying: Saying) -> bool:
        aside = (REPAIR, NEGATION)
        return any(concept.startswith(aside) for concept in self._language.concepts(saying.text))

    def _read(self, mutant: Mutant, report: Report) -> None:
        work = WorkBudget()
        parsed = self._language.parse(mutant.text, ALONE, work)
        got: list[Any] = []
        if work.spent > SLOW:
            became = "slow"
        elif not isinstance(parsed, Understood):
            became = "asked" if isinstance(parsed, Ambiguous) else "refused"
        else:
            got = dump(parsed.actions)
            became = self._judge(mutant, got, report)
            report.acts(mutant, became, got, self._chance)
        report.note(mutant.kind, became, mutant.text, mutant.source.text, got, mutant.change)

    def _judge(self, mutant: Mutant, got: Sequence[Any], report: Report) -> str:
        """What became of a mutant that acts."""
        same = got == list(mutant.source.actions)
        if same == (mutant.kind in self._words.loose):
            return "same" if same else "different"
        excuse = excused(mutant, self._words.excuses) if same else None
        if excuse is None:
            return "suspicious"
        report.excuses[excuse.because] += 1
        return "excused"

    def _pairs(self, kind: str, count: int, report: Report) -> Iterator[None]:
        said = self._sayings.joinable
        questions = [each for each in said if each.is_question]
        requests = [each for each in said if not each.is_question]
        if kind == "questions":
            pairs = all_pairs(questions, requests, self._joiners, count, self._seed)
        else:
            pairs = random_pairs(said, self._joiners, count, self._seed)
        for pair in pairs:
            became = verdict(self._language, pair)
            got: list[Any] = []
            if became in WRONG:
                parsed = self._language.parse(pair[2])
                got = dump(parsed.actions) if isinstance(parsed, Understood) else []
            report.note(kind, became, pair[2], pair[0].text, got)
            yield
