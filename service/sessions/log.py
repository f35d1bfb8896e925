"""A session's log: what happened, in numbered lines; the latest few hundred are kept.

Numbers are absolute and start at 1, so that a reader can ask for what came after the last line it
saw and be told when lines have been dropped meanwhile. Most lines come back when the session does; those
that nothing in the store stands for (`passing`) do not, and then were never there.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from itertools import islice

from sim.types import Cell


@dataclass(frozen=True, slots=True)
class LogEvent:
    """One line: what happened at a tick, in a type for programs and a sentence for people."""

    number: int
    tick: int
    type: str
    text: str
    ids: tuple[str, ...] = ()
    cell: Cell | None = None


class EventLog:
    """The latest events, oldest first."""

    def __init__(self, kept: int) -> None:
        self._events: deque[LogEvent] = deque(maxlen=kept)
        self._last = 0
        self._transient_count = 0
        self._transient: set[int] = set()
        self._before: deque[LogEvent] = deque()
        """lines that would still be held if there were no passing ones"""

    @property
    def last_number(self) -> int:
        """Number of the newest line; 0 before the first."""
        return self._last

    @property
    def first_number(self) -> int:
        """Number of the oldest line that can still be read."""
        return self._last - len(self._events) + 1

    @property
    def capacity(self) -> int:
        """How many lines are kept at most."""
        return self._events.maxlen or 0

    def skip(self, lines: int) -> None:
        """Count lines that are written nowhere: so many have followed them that they are dropped already."""
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
        passing: bool = False,
    ) -> LogEvent:
        """Write one line."""
        self._last += 1
        event = LogEvent(self._last, tick, kind, text, ids, cell)
        if passing:
            self._transient_count += 1
            self._transient.add(event.number)
        if self._transient:
            self._make_room()
        self._events.append(event)
        return event

    def durable_lines(self) -> tuple[int, list[LogEvent]]:
        """How many lines there would be without passing ones, and those of them that would be held."""
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
        """Up to `limit` lines that follow `number`, oldest first."""
        skipped = max(0, number - self.first_number + 1)
        return list(islice(self._events, skipped, skipped + limit))

    def latest(self, limit: int) -> list[LogEvent]:
        """The newest `limit` lines, oldest first."""
        return self.after(max(0, self._last - limit), limit)
