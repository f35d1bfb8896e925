"""Who watches a session: a small slot for each watcher, so that a slow one costs nothing.

A message is encoded once and shared by all slots. A watcher that has not read by the time its slot
is full loses what is in it, is told which ticks those were, and goes on from a full state.
"""

from __future__ import annotations

import asyncio
import secrets
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from sim.fast_replace import fast_constructor

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
    number: int = 0


_notice = fast_constructor(Notice, "tick", "data", "number")


def stamped(data: bytes, event: str) -> bytes:
    """An encoded message with the id that a reader can come back with."""
    return b'%b,"event":"%b"}' % (data[:-1], event.encode()) if data.endswith(b"}") else data


class Watcher:
    """One reader's end. `next` waits for the next thing to send.

    A reader may offer to take messages `straight`: whoever waits in `next` with nothing before it is
    offered each as it comes, and hears of those that were refused in `next`, in their order.
    """

    __slots__ = ("_gone", "_last_tick", "_missed_from", "_straight", "_waiting", "_wake")

    def __init__(
        self, missed: Sequence[Notice] = (), straight: Callable[[bytes], bool] | None = None
    ) -> None:
        """`missed`: what it is told first."""
        self._straight = straight
        self._waiting: list[Notice] = list(missed)
        self._missed_from: int | None = None
        self._last_tick = 0
        self._gone = False
        self._wake: asyncio.Future[None] | None = None

    def put(self, notice: Notice) -> None:
        """Hand over a message; never waits."""
        self._last_tick = notice.tick
        wake, straight = self._wake, self._straight
        # Who waits in `next` has been given all before: nothing can be overtaken.
        if straight is not None and wake is not None and not wake.done() and straight(notice.data):
            return
        if self._missed_from is None:
            if len(self._waiting) < SLOT_MESSAGES:
                self._waiting.append(notice)
            else:
                self._missed_from = self._waiting[0].tick
                self._waiting.clear()
        self._ready()

    def end(self) -> None:
        """The session is no more."""
        self._gone = True
        self._ready()

    async def next(self) -> list[Notice] | Missed | Gone:
        """Messages in order; or that some were missed; or that there will be no more. For one at a time."""
        while not self._waiting and self._missed_from is None and not self._gone:
            self._wake = asyncio.get_running_loop().create_future()
            try:
                await self._wake
            finally:
                self._wake = None
        if self._gone:
            return Gone()
        if self._missed_from is not None:
            missed = Missed(self._missed_from, self._last_tick)
            self._missed_from = None
            return missed
        notices, self._waiting = self._waiting, []
        return notices

    def _ready(self) -> None:
        if self._wake is not None and not self._wake.done():
            self._wake.set_result(None)


class Watchers:
    """All watchers of one session."""

    def __init__(self) -> None:
        self._watchers: set[Watcher] = set()
        # Numbers begin anew when the session is brought back; the token tells one count from another.
        self._token = secrets.token_hex(4)
        self._last = 0
        # As plain values, the latest last: rings are looked for in every notice that is kept.
        self._kept: deque[bytes] = deque(maxlen=SLOT_MESSAGES)
        self._kept_ticks: deque[int] = deque(maxlen=SLOT_MESSAGES)
        self._unheard = SLOT_MESSAGES

    @property
    def event(self) -> str:
        """The id of the latest message, for a reader to come back with."""
        return self.event_of(self._last)

    def event_of(self, number: int) -> str:
        """The id of a message by its number."""
        return f"{self._token}.{number}"

    def missed(self, event: str) -> list[Notice] | None:
        """What came after a message, if all of that is still kept; None if it is not."""
        token, _, number = event.partition(".")
        if token != self._token or not number.isascii() or not number.isdecimal() or len(number) > 15:
            return None
        first, after = self._last - len(self._kept) + 1, int(number) + 1
        if not first <= after <= self._last + 1:
            return None
        kept = zip(range(first, self._last + 1), self._kept_ticks, self._kept, strict=True)
        return [Notice(tick, data, each) for each, tick, data in kept if each >= after]

    def __len__(self) -> int:
        return len(self._watchers)

    def join(self, missed: Sequence[Notice] = (), straight: Callable[[bytes], bool] | None = None) -> Watcher:
        """A new watcher; it hears what it missed, and everything published from now on."""
        watcher = Watcher(missed, straight)
        self._unheard = 0
        self._watchers.add(watcher)
        return watcher

    def leave(self, watcher: Watcher) -> None:
        """It hears no more."""
        self._watchers.discard(watcher)

    def publish(self, tick: int, encode: Callable[[], bytes]) -> None:
        """Tell all; the message is not even made when nobody watches, nor has lately."""
        notice = self.made(tick, encode)
        if notice is not None:
            self.hand_out(notice)

    def made(self, tick: int, encode: Callable[[], bytes]) -> Notice | None:
        """The next message, made and kept but not yet told; None where nobody watches, nor has lately."""
        number = self._last + 1
        if not self._watchers:
            self._unheard += 1
            if self._unheard > SLOT_MESSAGES:
                self._last = number
                self._kept.clear()
                self._kept_ticks.clear()
                return None
        notice = _notice(tick, stamped(encode(), f"{self._token}.{number}"), number)
        self._last = (
            number  # not before: what could not be made has no number, and leaves no gap in what is kept
        )
        self._kept.append(notice.data)
        self._kept_ticks.append(tick)
        return notice

    def hand_out(self, notice: Notice) -> None:
        """Tell all a message that was made."""
        for watcher in self._watchers:
            watcher.put(notice)

    def end(self) -> None:
        """Tell all that the session is no more, and let them go."""
        for watcher in self._watchers:
            watcher.end()
        self._watchers.clear()
