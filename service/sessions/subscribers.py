"""Subscribers of a session: each has a small queue, so that a slow one costs nothing.

A message is encoded once and shared by all queues. A subscriber whose queue is full loses what is in it, is
told which ticks it missed, and continues from a full state.
"""

from __future__ import annotations

import asyncio
import secrets
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from sim.fast_replace import fast_constructor

QUEUE_SIZE = 16
"""Messages in a queue. A subscriber that keeps up has a few; a step publishes as many at most."""


@dataclass(frozen=True, slots=True)
class MissedTicks:
    """The first and the last tick that a slow subscriber missed."""

    first_tick: int
    last_tick: int


class SessionDeleted:
    """The last thing that a subscriber gets."""


@dataclass(frozen=True, slots=True)
class StreamMessage:
    """An encoded message and its tick."""

    tick: int
    data: bytes
    number: int = 0


_message = fast_constructor(StreamMessage, "tick", "data", "number")


def add_event_id(data: bytes, event: str) -> bytes:
    """An encoded message with the id from which a client can resume."""
    return b'%b,"event":"%b"}' % (data[:-1], event.encode()) if data.endswith(b"}") else data


class Subscriber:
    """One client's end of the stream; `next` waits for the next thing to send.

    With `straight`, a client that waits in `next` with an empty queue is offered each message at once;
    messages that `straight` refuses are queued, in order.
    """

    __slots__ = ("_gone", "_last_tick", "_missed_from", "_straight", "_waiting", "_wake")

    def __init__(
        self, missed: Sequence[StreamMessage] = (), straight: Callable[[bytes], bool] | None = None
    ) -> None:
        """`missed`: messages to deliver first."""
        self._straight = straight
        self._waiting: list[StreamMessage] = list(missed)
        self._missed_from: int | None = None
        self._last_tick = 0
        self._gone = False
        self._wake: asyncio.Future[None] | None = None

    def put(self, notice: StreamMessage) -> None:
        """Queue a message, or deliver it at once; never waits."""
        self._last_tick = notice.tick
        wake, straight = self._wake, self._straight
        # Who waits in `next` has been given all before: nothing can be overtaken.
        if straight is not None and wake is not None and not wake.done() and straight(notice.data):
            return
        if self._missed_from is None:
            if len(self._waiting) < QUEUE_SIZE:
                self._waiting.append(notice)
            else:
                self._missed_from = self._waiting[0].tick
                self._waiting.clear()
        self._wake_up()

    def close(self) -> None:
        """Deliver `SessionDeleted` next."""
        self._gone = True
        self._wake_up()

    async def next(self) -> list[StreamMessage] | MissedTicks | SessionDeleted:
        """Queued messages in order, `MissedTicks` or `SessionDeleted`. For one caller at a time."""
        while not self._waiting and self._missed_from is None and not self._gone:
            self._wake = asyncio.get_running_loop().create_future()
            try:
                await self._wake
            finally:
                self._wake = None
        if self._gone:
            return SessionDeleted()
        if self._missed_from is not None:
            missed = MissedTicks(self._missed_from, self._last_tick)
            self._missed_from = None
            return missed
        notices, self._waiting = self._waiting, []
        return notices

    def _wake_up(self) -> None:
        if self._wake is not None and not self._wake.done():
            self._wake.set_result(None)


class Subscribers:
    """All subscribers of one session."""

    def __init__(self) -> None:
        self._subscribers: set[Subscriber] = set()
        # Numbers begin anew when the session is brought back; the token tells one count from another.
        self._token = secrets.token_hex(4)
        self._last = 0
        # As plain values, the latest last: rings are looked for in every notice that is kept.
        self._kept: deque[bytes] = deque(maxlen=QUEUE_SIZE)
        self._kept_ticks: deque[int] = deque(maxlen=QUEUE_SIZE)
        self._unsubscribed_count = QUEUE_SIZE

    @property
    def last_event_id(self) -> str:
        """The id of the latest message, to resume from."""
        return self.event_id(self._last)

    def event_id(self, number: int) -> str:
        """The id of a message by its number."""
        return f"{self._token}.{number}"

    def messages_since(self, event: str) -> list[StreamMessage] | None:
        """The messages after an id; None if some of them are not kept any more."""
        token, _, number = event.partition(".")
        if token != self._token or not number.isascii() or not number.isdecimal() or len(number) > 15:
            return None
        first, after = self._last - len(self._kept) + 1, int(number) + 1
        if not first <= after <= self._last + 1:
            return None
        kept = zip(range(first, self._last + 1), self._kept_ticks, self._kept, strict=True)
        return [StreamMessage(tick, data, each) for each, tick, data in kept if each >= after]

    def __len__(self) -> int:
        return len(self._subscribers)

    def subscribe(
        self, missed: Sequence[StreamMessage] = (), straight: Callable[[bytes], bool] | None = None
    ) -> Subscriber:
        """A new subscriber; it gets `missed`, then everything published from now on."""
        subscriber = Subscriber(missed, straight)
        self._unsubscribed_count = 0
        self._subscribers.add(subscriber)
        return subscriber

    def unsubscribe(self, subscriber: Subscriber) -> None:
        """Deliver nothing more to a subscriber."""
        self._subscribers.discard(subscriber)

    def publish(self, tick: int, encode: Callable[[], bytes]) -> None:
        """Encode and deliver a message; skips encoding when there is no subscriber, nor was one lately."""
        notice = self.prepare(tick, encode)
        if notice is not None:
            self.deliver(notice)

    def prepare(self, tick: int, encode: Callable[[], bytes]) -> StreamMessage | None:
        """The next message, encoded and kept, not delivered; None without subscribers now and lately."""
        number = self._last + 1
        if not self._subscribers:
            self._unsubscribed_count += 1
            if self._unsubscribed_count > QUEUE_SIZE:
                self._last = number
                self._kept.clear()
                self._kept_ticks.clear()
                return None
        notice = _message(tick, add_event_id(encode(), f"{self._token}.{number}"), number)
        self._last = (
            number  # not before: what could not be made has no number, and leaves no gap in what is kept
        )
        self._kept.append(notice.data)
        self._kept_ticks.append(tick)
        return notice

    def deliver(self, notice: StreamMessage) -> None:
        """Deliver a prepared message to all."""
        for subscriber in self._subscribers:
            subscriber.put(notice)

    def close(self) -> None:
        """Deliver `SessionDeleted` to all and forget them."""
        for subscriber in self._subscribers:
            subscriber.close()
        self._subscribers.clear()
