"""What became of the sentences of a run: counts by kind, the suspicious ones, and a sample of acts."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from service.grammar.fuzz.mutations import Mutant
from service.grammar.fuzz.pairs import VERDICTS, WRONG

COLUMNS = ("same", "different", "asked", "refused", "excused", "suspicious", "slow")
"""What may become of a mutant; `excused` means the same for a reason that is told."""

MOST_KEPT = 200
"""How many suspicious sentences of one kind a report keeps."""


@dataclass(slots=True)
class Report:
    """What became of the sentences of a run."""

    counts: dict[str, Counter[str]] = field(default_factory=dict)
    """by kind: how many came to each verdict"""
    excuses: Counter[str] = field(default_factory=Counter[str])
    """by reason: how many variants mean the same for it"""
    suspicious: list[dict[str, Any]] = field(default_factory=list)
    """kind, text, source and actions of those that should have come to another"""
    sample: list[dict[str, Any]] = field(default_factory=list)
    """as many variants that acted as are wanted, drawn evenly, to be read by a person"""
    sample_size: int = 0
    acted: int = 0
    """how many variants acted"""

    def total(self, verdict: str | None = None) -> int:
        """How many sentences came to a verdict; all where none is named."""
        return sum(n for c in self.counts.values() for each, n in c.items() if verdict in (None, each))

    def note(
        self, kind: str, verdict: str, text: str, source: str, actions: Sequence[Any], change: str = ""
    ) -> None:
        """Counts one sentence, and keeps it where it is suspicious."""
        counts = self.counts.setdefault(kind, Counter())
        counts[verdict] += 1
        if verdict in ("suspicious", *WRONG) and counts[verdict] <= MOST_KEPT:
            self.suspicious.append(
                {
                    "kind": kind,
                    "verdict": verdict,
                    "text": text,
                    "source": source,
                    "change": change,
                    "actions": list(actions),
                }
            )

    def acts(self, mutant: Mutant, verdict: str, actions: Sequence[Any], chance: random.Random) -> None:
        """Counts a variant that acts and may take it into the sample: each is in it with equal chance."""
        self.acted += 1
        at = len(self.sample) if len(self.sample) < self.sample_size else chance.randrange(self.acted)
        if at >= self.sample_size:
            return
        shown = {
            "kind": mutant.kind,
            "verdict": verdict,
            "text": mutant.text,
            "source": mutant.source.text,
            "actions": list(actions),
        }
        self.sample[at : at + 1] = [shown]


def render(report: Report, *, listed: bool = True) -> str:
    """The counts as a table, the reasons why some mean the same, and what is suspicious or sampled."""
    columns = list(dict.fromkeys((*COLUMNS, *VERDICTS)))
    columns = [name for name in columns if report.total(name) or name in ("suspicious", *WRONG)]
    lines = [f"{'kind':<18}{'sentences':>10}" + "".join(f"{name:>11}" for name in columns)]
    for kind, counts in (*report.counts.items(), ("all", sum(report.counts.values(), Counter[str]()))):
        lines.append(f"{kind:<18}{counts.total():>10}" + "".join(f"{counts[name]:>11}" for name in columns))
    if report.excuses:
        lines += ["", "excused:"]
        lines += [f"{count:>8}  {because}" for because, count in report.excuses.most_common()]
    for each in report.suspicious if listed else ():
        lines += ["", f"{each['kind']}, {each['verdict']}: {each['text']}", f"  of  {each['source']}"]
        lines.append(f"  got {each['actions']}")
    for each in report.sample:
        lines += ["", f"acted, {each['kind']}: {each['text']}", f"  of  {each['source']}"]
        lines.append(f"  got {each['actions']}")
    return "\n".join(lines)
