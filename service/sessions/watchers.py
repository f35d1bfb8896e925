"""Who watches a session: a small slot for each watcher, so that a slow one costs nothing.

A message is encoded once and shared by all slots. A watcher that has not read by the time its slot
is full loses what is in it, is told which ticks those were, and goes on from a full state.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass

SLOT_MESSAGES = 16
"""A watcher that keeps up never has more than a few waiting; stepping plays through as many."""


@dataclass(frozen=True, slots=True)
class Missed:
    """The ticks, first and last, that a slow watcher was not sent."""

    first_tick: int
    last_tick: int


class Gone:
    """The last thing a watcher hears: the session has been deleted."""


@dataclass(frozen=True, slots=True)
class Notice:
    """An encoded message and the tick it tells of."""

    tick: int
    data: bytes


class Watcher:
    """One reader's end. `next` waits for the next thing to send."""

    def __init__(self) -> None:
        self._waiting: list[Notice] = []
        self._missed_from: int | None = None
        self._last_tick = 0
        self._gone = False
        self._ready = asyncio.Event()

    def put(self, notice: Notice) -> None:
        """Hand over a message; never waits."""
        self._last_tick = notice.tick
        if self._missed_from is None:
            if len(self._waiting) < SLOT_MESSAGES:
                self._waiting.append(notice)
            else:
                self._missed_from = self._waiting[0].tick
                self._waiting.clear()
        self._ready.set()

    def end(self) -> None:
        """The session is no more."""
        self._gone = True
        self._ready.set()

    async def next(self) -> list[Notice] | Missed | Gone:
        """Messages in order; or that some were missed; or that there will be no more."""
        await self._ready.wait()
        self._ready.clear()
        if self._gone:
            return Gone()
        if self._missed_from is not None:
            missed = Missed(self._missed_from, self._last_tick)
            self._missed_from = None
            return missed
        notices, self._waiting = self._waiting, []
        return notices


class Watchers:
    """All watchers of one session."""

    def __init__(self) -> None:
        self._watchers: set[Watcher] = set()

    def __len__(self) -> int:
        return len(self._watchers)

    def join(self) -> Watcher:
        """A new watcher; it hears everything published from now on."""
        watcher = Watcher()
        self._watchers.add(watcher)
        return watcher

    def leave(self, watcher: Watcher) -> None:
        """It hears no more."""
        self._watchers.discard(watcher)

    def publish(self, tick: int, encode: Callable[[], bytes]) -> None:
        """Tell all; the message is not even made when nobody watches."""
        if not self._watchers:
            return
        notice = Notice(tick, encode())
        for watcher in self._watchers:
            watcher.put(notice)

    def end(self) -> None:
        """Tell all that the session is no more, and let them go."""
        for watcher in self._watchers:
            watcher.end()
        self._watchers.clear()
