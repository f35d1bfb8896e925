"""A run of the fuzzer: what became of every mutant and pair by kind, and which are suspicious."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from service.actions import dump
from service.grammar.engine import Language
from service.grammar.fuzz.mutations import NEUTRAL, Mutant, Mutations
from service.grammar.fuzz.pairs import VERDICTS, WRONG, all_pairs, random_pairs, verdict
from service.grammar.fuzz.sayings import Saying, Sayings
from service.grammar.parse_types import Ambiguous, Understood
from service.grammar.paths import NEGATION
from service.grammar.span_patterns import REPAIR
from service.grammar.topic import ALONE
from service.grammar.work_budget import MOST_STEPS, WorkBudget
from service.resources import prompts_folder
from service.yaml_files import read_yaml

PAIRS = ("pairs", "questions")
"""Kinds that join sentences: any two, and each question with each request."""

COLUMNS = ("same", "different", "asked", "refused", "suspicious", "slow")
SLOW = MOST_STEPS // 2
"""Steps from which a sentence counts as slow."""

MOST_KEPT = 200
"""How many suspicious sentences of one kind a report keeps."""


@dataclass(slots=True)
class Report:
    """What became of the sentences of a run."""

    counts: dict[str, Counter[str]] = field(default_factory=dict)
    """by kind: how many came to each verdict"""
    suspicious: list[dict[str, Any]] = field(default_factory=list)
    """kind, text, source and actions of those that should have come to another"""

    def total(self, verdict: str | None = None) -> int:
        """How many sentences came to a verdict; all where none is named."""
        return sum(n for c in self.counts.values() for each, n in c.items() if verdict in (None, each))

    def note(self, kind: str, verdict: str, text: str, source: str, actions: Sequence[Any]) -> None:
        """Counts one sentence, and keeps it where it is suspicious."""
        counts = self.counts.setdefault(kind, Counter())
        counts[verdict] += 1
        if verdict in ("suspicious", *WRONG) and counts[verdict] <= MOST_KEPT:
            self.suspicious.append(
                {"kind": kind, "verdict": verdict, "text": text, "source": source, "actions": list(actions)}
            )


def words_of(code: str) -> Mapping[str, list[str]]:
    """What the fuzzer puts into sentences of a language; empty where it has no such file."""
    path = prompts_folder() / "language" / code / "fuzz.yaml"
    return {key: list(map(str, value)) for key, value in read_yaml(path).items()} if path.is_file() else {}


class Fuzzer:
    """Mutates and joins the sentences of one language."""

    def __init__(self, language: Language, code: str, seed: int) -> None:
        words = dict(words_of(code))
        self._language = language
        self._sayings = Sayings(language, code)
        self._seed = seed
        self._joiners = words.pop("joiners", [])
        self._mutations = Mutations(words, seed) if words else None

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of change that the language has words for."""
        return (*(self._mutations.kinds if self._mutations else ()), *(PAIRS if self._joiners else ()))

    def run(self, count: int, kinds: Sequence[str], tell: Callable[[int], None] = lambda _: None) -> Report:
        """Reads about as many sentences, as many of each kind; `tell` is called after some of them."""
        report = Report()
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
        known: set[str] = set()
        for _ in range(count * 4):
            if len(known) == count or self._mutations is None:
                return
            mutant = self._mutations.of(chance.choice(said), kind)
            if mutant is None or mutant.text in known:
                continue
            known.add(mutant.text)
            self._read(mutant, report)
            yield

    def _sayings_for(self, kind: str) -> Sequence[Saying]:
        """The sayings in which a mutation of this kind surely means something else.

        A question forbids nothing, a second negation may undo the first, and what is taken back or left out
        may as well be something else.
        """
        if kind == NEUTRAL:
            return [
                each for each in self._sayings.all if each.actions[-1]["do"] != "chat"
            ]  # thanks are one more
        said = self._sayings.all if kind in ("number", "swap", "drop") else self._sayings.requests
        aside = (REPAIR, NEGATION)
        return [
            each for each in said if not any(c.startswith(aside) for c in self._language.concepts(each.text))
        ]

    def _read(self, mutant: Mutant, report: Report) -> None:
        work = WorkBudget()
        parsed = self._language.parse(mutant.text, ALONE, work)
        if work.spent > SLOW:
            report.note(mutant.kind, "slow", mutant.text, mutant.source.text, ())
        elif not isinstance(parsed, Understood):
            became = "asked" if isinstance(parsed, Ambiguous) else "refused"
            report.note(mutant.kind, became, mutant.text, mutant.source.text, ())
        else:
            got = dump(parsed.actions)
            same = got == list(mutant.source.actions)
            right = same == (mutant.kind == NEUTRAL)
            became = ("same" if same else "different") if right else "suspicious"
            report.note(mutant.kind, became, mutant.text, mutant.source.text, got)

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


def render(report: Report, *, listed: bool = True) -> str:
    """The counts as a table, and a list of what is suspicious."""
    columns = list(dict.fromkeys((*COLUMNS, *VERDICTS)))
    lines = [f"{'kind':<14}{'sentences':>10}" + "".join(f"{name:>11}" for name in columns)]
    for kind, counts in (*report.counts.items(), ("all", sum(report.counts.values(), Counter[str]()))):
        lines.append(f"{kind:<14}{counts.total():>10}" + "".join(f"{counts[name]:>11}" for name in columns))
    for each in report.suspicious if listed else ():
        lines += ["", f"{each['kind']}, {each['verdict']}: {each['text']}", f"  of  {each['source']}"]
        lines.append(f"  got {each['actions']}")
    return "\n".join(lines)
