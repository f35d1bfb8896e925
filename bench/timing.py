"""Timing many small calls, and telling them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeVar

Item = TypeVar("Item")


@dataclass(frozen=True, slots=True)
class Times:
    """Sorted durations of single calls, in seconds."""

    seconds: list[float]

    def quantile(self, share: float) -> float:
        """The duration that this share of calls does not exceed, in microseconds."""
        return self.seconds[min(len(self.seconds) - 1, int(share * len(self.seconds)))] * 1e6

    def row(self, name: str) -> str:
        """One line of a table."""
        return (
            f"{name:<44} p50 {self.quantile(0.5):9.1f} µs   p99 {self.quantile(0.99):9.1f} µs   "
            f"max {self.seconds[-1] * 1e6:9.1f} µs   n {len(self.seconds)}"
        )


def timed(call: Callable[[Item], object], items: Iterable[Item]) -> Times:
    """How long `call` takes for each item."""
    seconds = []
    for item in items:
        start = time.perf_counter()
        call(item)
        seconds.append(time.perf_counter() - start)
    return Times(sorted(seconds))
