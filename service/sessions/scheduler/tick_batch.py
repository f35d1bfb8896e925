"""What a session tells, made and sent at once; or, in a turn of the clock, stage by stage.

Sessions that are due together are ticked one after the other, then all their messages are made, then all are
sent. A processor that goes on doing one kind of thing does it in four fifths of the time: what it needs for
that stays at hand. Nothing else happens in between, and each session tells all in its order. Leaves out
when the stages are: the clock knows that.
"""

from __future__ import annotations

from collections.abc import Callable

from service.sessions.subscribers import StreamMessage, Subscribers


class TickBatch:
    """What one session has not told yet. Empty whenever no turn of the clock is under way."""

    __slots__ = ("_encoded", "_holding", "_pending", "_subscribers")

    def __init__(self, subscribers: Subscribers) -> None:
        self._subscribers = subscribers
        self._holding = False
        self._pending: list[tuple[int, Callable[[], bytes]]] = []
        self._encoded: list[StreamMessage] = []

    def hold(self) -> None:
        """Ticks are not told until `make` and `send` are called."""
        self._holding = True

    def publish_tick(self, tick: int, encode: Callable[[], bytes]) -> None:
        """Tell of a tick, now or when its stage comes."""
        if self._holding:
            self._pending.append((tick, encode))
        else:
            self._subscribers.publish(tick, encode)

    def publish_now(self, tick: int, encode: Callable[[], bytes]) -> None:
        """Tell of something else at once, after all that is not told yet."""
        self.encode()
        self.send()
        self._subscribers.publish(tick, encode)

    def encode(self) -> None:
        """Make the messages of what was held. Raises what making one raises; those before it are made."""
        self._holding = False
        if self._pending:
            untold, self._pending = self._pending, []
            for tick, encode in untold:
                notice = self._subscribers.prepare(tick, encode)
                if notice is not None:
                    self._encoded.append(notice)

    def send(self) -> None:
        """Hand out what was made."""
        if self._encoded:
            made, self._encoded = self._encoded, []
            for notice in made:
                self._subscribers.deliver(notice)
