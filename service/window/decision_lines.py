"""The window's log: the session's lines, with each decision in words between them, as the page has it.

Only the latest decision is looked at after each frame: of a clock that makes several ticks in a frame
not every decision can be read. Ticks that say the same share a line.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from service.sessions.log import LogEvent
from service.sessions.session import Session

KEPT: Final = 400
DECISION: Final = "moved"
"""The type of such a line, which decides its colour."""
AT_ONCE: Final = 16
"""More lines than one tick brings."""


@dataclass(frozen=True, slots=True)
class DecisionLine:
    """A decision in words; `first` and `last` are the ticks that say so."""

    first: int
    last: int
    text: str
    after: int
    """the number of the log's newest line when it was taken"""
    type: str = DECISION

    @property
    def tick(self) -> str:
        """The ticks as they are read."""
        return str(self.first) if self.first == self.last else f"{self.first}–{self.last}"


class DecisionLines:
    """Gathers decisions while the session goes on."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._lines: deque[DecisionLine] = deque(maxlen=KEPT)
        self._seen = session.timeline.tick
        self.changes = 0
        """raised when a line is added or taken away"""

    def look(self) -> None:
        """Note the decision that led to the present tick, if it is new; forget what was taken back."""
        tick = self._session.timeline.tick
        if tick == self._seen:
            return
        if tick < self._seen:
            self._lines = deque((each for each in self._lines if each.last < tick), maxlen=KEPT)
            self.changes += 1
        self._seen = tick
        found = self._session.latest_decision()
        if found is None:
            return
        decision, run = found
        text = self._session.narrator.decision(decision, run)
        last = self._lines[-1] if self._lines else None
        after = self._before(tick)
        self.changes += 1
        if last is not None and (last.text, last.last, last.after) == (text, tick - 2, after):
            self._lines[-1] = replace(last, last=tick - 1)
        elif last is None or last.last < tick - 1:
            self._lines.append(DecisionLine(tick - 1, tick - 1, text, after))

    def _before(self, tick: int) -> int:
        """The number of the log's newest line from before a tick: what came of a decision follows it."""
        for line in reversed(self._session.log.latest(AT_ONCE)):
            if line.tick < tick:
                return line.number
        return max(0, self._session.log.last_number - AT_ONCE)

    def among(self, lines: Sequence[LogEvent]) -> list[LogEvent | DecisionLine]:
        """The log's lines and the decisions, in the order in which they came."""
        found: list[LogEvent | DecisionLine] = []
        decisions = list(self._lines)
        at = 0
        for line in lines:
            while at < len(decisions) and decisions[at].after < line.number:
                found.append(decisions[at])
                at += 1
            found.append(line)
        return [*found, *decisions[at:]]
