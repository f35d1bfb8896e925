"""A whole run, phase by phase, each as often as it takes: what comes of it, told as it comes."""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from types import FrameType

from tests.contract.running import LINE_S, Report, Tally, Tool

FEWEST = 10
"""Examples of a round: the last one is not made of a handful."""


@dataclass(frozen=True)
class Part:
    """One phase."""

    phase: str
    cases: int = 0
    """at least so many; 0: one round, however many those are"""
    examples: int = 10
    """for each call, or scenarios, in the first round"""


@dataclass
class Whole:
    """The run, and what it has found so far."""

    tool: Tool
    parts: Sequence[Part]
    seed: int = 1
    seconds: float | None = None
    complete: bool = False
    tally: Tally = field(default_factory=Tally)
    cases: dict[str, int] = field(default_factory=dict)
    took: dict[str, float] = field(default_factory=dict)
    found: list[Report] = field(default_factory=list)
    """reports in which there is something"""
    _line_at: float = 0.0

    @property
    def violations(self) -> int:
        """Failures and errors."""
        return sum(
            max(len(each.failures) + len(each.errors), len(each.tally.violations)) for each in self.found
        )

    def go(self) -> None:
        """All parts, unless it is stopped by a signal or has had its time."""
        before = signal.signal(signal.SIGTERM, _interrupt)
        try:
            until = float("inf") if self.seconds is None else time.monotonic() + self.seconds
            self.complete = all(self._part(part, until) for part in self.parts)
        except KeyboardInterrupt:  # between two rounds
            pass
        finally:
            signal.signal(signal.SIGTERM, before)

    def _part(self, part: Part, until: float) -> bool:
        """One phase; whether it came to its end."""
        self.cases[part.phase], self.took[part.phase] = 0, 0.0
        examples, seed, began = part.examples, self.seed, time.monotonic()
        while True:
            report = self.tool.run(
                [part.phase],
                seed=seed,
                examples=examples,
                until=until,
                follow=lambda tally: self._progress(part, tally, began),
            )
            self.tally += report.tally
            self.cases[part.phase] += report.cases
            self.took[part.phase] += report.seconds
            if not report.clean:
                self.found.append(report)
            if not report.complete:
                return False
            missing = part.cases - self.cases[part.phase]
            if missing <= 0:
                return True
            # As many as the rounds so far have shown to be needed, and some.
            examples = max(FEWEST, round(1.1 * examples * missing / max(1, report.cases)))
            seed += 1

    def _progress(self, part: Part, tally: Tally, began: float) -> None:
        shown = sys.stderr.isatty()
        now = time.monotonic()
        if not shown and now - self._line_at < LINE_S:
            return
        self._line_at = now
        done = self.cases[part.phase] + tally.answers
        wanted = f" of {part.cases}" if part.cases else ""
        pace = done / max(now - began, 0.1)
        found = self.tally.violations.total() + tally.violations.total()
        told = f"{part.phase}: {done}{wanted} answers, {pace:.0f}/s, {found} violations so far"
        print(f"\r\x1b[K{told}" if shown else told, end="" if shown else "\n", file=sys.stderr, flush=True)

    def tell(self, calls: Iterable[str]) -> None:
        """The totals; `calls` are those there are."""
        if sys.stderr.isatty():
            print(file=sys.stderr)
        for report in self.found:
            print(report.output)
        for phase, cases in self.cases.items():
            took = self.took[phase]
            print(f"{phase:<9} {cases:>6} cases in {took:.0f} s, {cases / max(took, 0.1):.0f}/s")
        by_status = ", ".join(f"{status}: {count}" for status, count in sorted(self.tally.statuses.items()))
        print(f"answers by status: {by_status}")
        left = sorted(set(calls) - set(self.tally.calls))
        if left and self.complete:
            print(f"not called: {', '.join(left)}")
        for violation, count in self.tally.violations.most_common():
            print(f"violated {count} times: {violation}")
        stopped = "" if self.complete else ", stopped before its end"
        print(
            f"{sum(self.cases.values())} cases, {self.cases.get('stateful', 0)} of them stateful, on "
            f"{len(self.tally.calls)} calls in {sum(self.took.values()):.0f} s{stopped}: "
            f"{self.server_errors} server errors, {self.violations} violations"
        )

    @property
    def server_errors(self) -> int:
        """Answers that blame the service."""
        return sum(count for status, count in self.tally.statuses.items() if status >= 500)


def _interrupt(_: int, __: FrameType | None) -> None:
    raise KeyboardInterrupt
