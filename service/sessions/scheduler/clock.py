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
    """Something that lives by ticks."""

    @property
    def period_s(self) -> float:
        """Seconds from one tick to the next; up to `SLOT_S` means as often as can be."""

    def tick(self) -> None:
        """One tick, quick and without waiting."""

    def tick_failed(self, error: Exception) -> None:
        """Told when `tick` raised; the ticker is off the clock by then."""


class TickOutput(Protocol):
    """What a ticker has to tell, where it can be told after others have ticked as well."""

    def hold(self) -> None:
        """What the next tick has to tell waits for `make` and `send`."""

    def encode(self) -> None:
        """Make what was held ready."""

    def send(self) -> None:
        """Tell it."""


class Clock(Protocol):
    """What sessions need of a clock; tests use one moved by hand."""

    def start(self) -> None:
        """Begin to serve deadlines; needs a running loop."""

    def stop(self) -> None:
        """Serve no more."""

    def add(self, ticker: Ticker) -> None:
        """Tick it every period, first one period from now, or some later where many are due then.

        Once there, adding again is no matter.
        """

    def remove(self, ticker: Ticker) -> None:
        """Tick it no more. Unknown tickers are no matter."""

    def lateness(self) -> Lateness:
        """How punctual the latest ticks were."""


@dataclass(frozen=True, slots=True)
class Lateness:
    """How long after their deadlines the latest ticks began, in milliseconds."""

    ticks: int
    p50_ms: float
    p99_ms: float
    max_ms: float

    @staticmethod
    def from_samples(samples_s: Sequence[float]) -> Lateness:
        """The figures of some ticks' lateness in seconds."""
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
