"""Protocols of a clock and of what it ticks, and figures of its lateness.

`service.sessions.scheduler.wheel_clock` is the clock of a running service; tests use one moved by hand.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

SLOT_S = 0.002
"""Deadlines nearer than this are served together."""


class Ticker(Protocol):
    """Something that is ticked."""

    @property
    def period_s(self) -> float:
        """Seconds from one tick to the next; up to `SLOT_S` means as often as possible."""

    def tick(self) -> None:
        """Run one tick; quick and without waiting."""

    def tick_failed(self, error: Exception) -> None:
        """Called when `tick` raised; the ticker is off the clock by then."""


class TickOutput(Protocol):
    """The messages of a ticker, which can be sent after other tickers have ticked."""

    def hold(self) -> None:
        """Hold back the messages of the next tick."""

    def encode(self) -> None:
        """Encode the messages held back."""

    def send(self) -> None:
        """Send the encoded messages."""


class Clock(Protocol):
    """The clock that sessions need."""

    def start(self) -> None:
        """Begin to tick; needs a running loop."""

    def stop(self) -> None:
        """Stop ticking."""

    def add(self, ticker: Ticker) -> None:
        """Tick a ticker every period, first one period from now, or a little later where many are due then.

        Adding it twice is the same as once.
        """

    def remove(self, ticker: Ticker) -> None:
        """Stop ticking a ticker; an unknown one is ignored."""

    def lateness(self) -> Lateness:
        """How late the latest ticks were."""


@dataclass(frozen=True, slots=True)
class Lateness:
    """How long after their deadlines the latest ticks began, in milliseconds."""

    ticks: int
    p50_ms: float
    p99_ms: float
    max_ms: float

    @staticmethod
    def from_samples(samples_s: Sequence[float]) -> Lateness:
        """The figures of samples in seconds."""
        if not samples_s:
            return Lateness(0, 0.0, 0.0, 0.0)
        ordered = sorted(samples_s)
        last = len(ordered) - 1
        return Lateness(
            len(ordered),
            round(ordered[last // 2] * 1e3, 3),
            round(ordered[math.ceil(last * 0.99)] * 1e3, 3),
            round(ordered[last] * 1e3, 3),
        )
