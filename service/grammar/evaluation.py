"""Evaluates a language on labelled sentences: exact, wrong, refused, asked, intent by intent.

A sentence's label is the list of its actions (empty: it must be refused) or that it must be asked
about. Actions are compared as JSON values, numbers to a relative 1e-6. A wrong action counts as
`wrong`; a refusal or a question where actions were meant is a miss, but harmless.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from service.actions import dump
from service.grammar.engine import Language
from service.grammar.parse_types import Ambiguous, Parse, Understood

TOLERANCE = 1e-6
Verdict = Literal["exact", "wrong", "refused", "clarified"]


@dataclass(frozen=True, slots=True)
class Labelled:
    """A sentence and what it means."""

    text: str
    actions: list[dict[str, Any]]
    clarify: bool = False

    @property
    def intent(self) -> str:
        """What the label is counted under: its actions' names, or `(refuse)`, or `(clarify)`."""
        if self.clarify:
            return "(clarify)"
        names = [_name(action) for action in self.actions]
        return (names[0] if len(set(names)) == 1 else "(several)") if names else "(refuse)"


@dataclass(frozen=True, slots=True)
class Failure:
    """A sentence that was not read as labelled."""

    labelled: Labelled
    verdict: Verdict
    got: list[dict[str, Any]]


@dataclass(slots=True)
class Report:
    """The counts, by intent, and every failure."""

    counts: dict[str, Counter[str]] = field(default_factory=dict)
    failures: list[Failure] = field(default_factory=list)

    def total(self, verdict: Verdict | None = None) -> int:
        """How many sentences had this verdict (all sentences, when none is named)."""
        return sum(n for c in self.counts.values() for v, n in c.items() if verdict in (None, v))


def read_labelled(path: Path) -> list[Labelled]:
    """The sentences of a JSON-lines file. Raises `ValueError`, naming the line, when one is malformed."""
    rows = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip():
            continue
        try:
            value = json.loads(line)
            rows.append(Labelled(value["text"], value["actions"], bool(value.get("clarify", False))))
        except (KeyError, TypeError, json.JSONDecodeError) as error:
            raise ValueError(f"{path}, line {number}: not a labelled sentence ({error})") from error
    return rows


def evaluate(language: Language, path: Path) -> Report:
    """Reads every sentence of a JSON-lines file and compares."""
    return evaluate_all(language, read_labelled(path))


def evaluate_all(language: Language, rows: Iterable[Labelled]) -> Report:
    """Reads every sentence and compares."""
    report = Report()
    for row in rows:
        parsed = language.parse(row.text)
        verdict = judge(row, parsed)
        report.counts.setdefault(row.intent, Counter())[verdict] += 1
        right = verdict == "exact" or (verdict == "clarified" and row.clarify)
        if not right:
            got = dump(parsed.actions) if isinstance(parsed, Understood) else []
            report.failures.append(Failure(row, verdict, got))
    return report


def judge(row: Labelled, parsed: Parse) -> Verdict:
    """What became of one sentence."""
    if isinstance(parsed, Ambiguous):
        return "exact" if row.clarify else "clarified"
    if isinstance(parsed, Understood):
        meant = bool(row.actions) and not row.clarify
        return "exact" if meant and same(dump(parsed.actions), row.actions) else "wrong"
    return "exact" if not row.actions and not row.clarify else "refused"


def same(a: Any, b: Any) -> bool:
    """Whether two JSON values are equal, numbers to a relative 1e-6."""
    if isinstance(a, bool) or isinstance(b, bool):
        return a is b
    if isinstance(a, int | float) and isinstance(b, int | float):
        return abs(a - b) <= TOLERANCE * max(abs(a), abs(b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
    return bool(a == b)


def render(report: Report, *, failures: bool = True) -> str:
    """The report as a table, and a list of failures."""
    columns = ("exact", "wrong", "refused", "clarified")
    lines = [f"{'intent':<24}{'sentences':>10}" + "".join(f"{name:>11}" for name in columns)]
    for intent in sorted(report.counts):
        counts = report.counts[intent]
        lines.append(f"{intent:<24}{counts.total():>10}" + "".join(f"{counts[name]:>11}" for name in columns))
    totals = "".join(f"{sum(c[name] for c in report.counts.values()):>11}" for name in columns)
    lines.append(f"{'all':<24}{report.total():>10}{totals}")
    for failure in report.failures if failures else ():
        lines += ["", f"{failure.verdict}: {failure.labelled.text}"]
        lines.append(f"  meant {json.dumps(failure.labelled.actions)}")
        if failure.got:
            lines.append(f"  got   {json.dumps(failure.got)}")
    return "\n".join(lines)


def _name(action: dict[str, Any]) -> str:
    return f"ask {action['about']}" if action["do"] == "ask" else str(action["do"])
