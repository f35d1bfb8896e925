"""The event log of a session: numbered lines, of which the latest few hundred are kept.

Numbers are absolute and start at 1, so that a client can ask for the lines after the last one it has seen and
can tell when lines were dropped. A restart restores all lines except transient ones, which no
stored entry stands for.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from itertools import islice

from sim.types import Cell


@dataclass(frozen=True, slots=True)
class LogEvent:
    """One line: an event at a tick, with a type for programs and a sentence for people."""

    number: int
    tick: int
    type: str
    text: str
    ids: tuple[str, ...] = ()
    cell: Cell | None = None


class EventLog:
    """The latest lines, oldest first."""

    def __init__(self, kept: int) -> None:
        self._events: deque[LogEvent] = deque(maxlen=kept)
        self._last = 0
        self._transient_count = 0
        self._transient: set[int] = set()
        self._before: deque[LogEvent] = deque()
        """lines that would still be kept without the transient ones"""

    @property
    def last_number(self) -> int:
        """The number of the newest line; 0 before the first."""
        return self._last

    @property
    def first_number(self) -> int:
        """The number of the oldest line that is kept."""
        return self._last - len(self._events) + 1

    @property
    def capacity(self) -> int:
        """The largest number of lines that are kept."""
        return self._events.maxlen or 0

    def skip(self, lines: int) -> None:
        """Count lines without writing them, for lines that would have been dropped by now."""
        if lines:
            self._last += lines
            self._events.clear()
            self._before.clear()
            self._transient.clear()

    def add(
        self,
        tick: int,
        kind: str,
        text: str,
        ids: tuple[str, ...] = (),
        cell: Cell | None = None,
        *,
        transient: bool = False,
    ) -> LogEvent:
        """Append a line; `transient`: it is transient."""
        self._last += 1
        event = LogEvent(self._last, tick, kind, text, ids, cell)
        if transient:
            self._transient_count += 1
            self._transient.add(event.number)
        if self._transient:
            self._make_room()
        self._events.append(event)
        return event

    def durable_lines(self) -> tuple[int, list[LogEvent]]:
        """The number of lines without transient ones, and those of them that would be kept."""
        held = [*self._before, *(event for event in self._events if event.number not in self._transient)]
        return self._last - self._transient_count, held

    def _make_room(self) -> None:
        if len(self._events) == self._events.maxlen:
            oldest = self._events[0]
            if oldest.number in self._transient:
                self._transient.remove(oldest.number)
            else:
                self._before.append(oldest)
        while len(self._before) > len(self._transient):
            self._before.popleft()

    def after(self, number: int, limit: int) -> list[LogEvent]:
        """Up to `limit` lines after line `number`, oldest first."""
        skipped = max(0, number - self.first_number + 1)
        return list(islice(self._events, skipped, skipped + limit))

    def latest(self, limit: int) -> list[LogEvent]:
        """The newest `limit` lines, oldest first."""
        return self.after(max(0, self._last - limit), limit)
