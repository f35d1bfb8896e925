"""A time that is set by hand, for the scheduler's clock."""

from __future__ import annotations


class Time:
    def __init__(self) -> None:
        self.now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


class Counter:
    """Remembers when it was ticked."""

    def __init__(self, time: Time, period_s: float, fails: bool = False) -> None:
        self.time, self.period_s, self.fails = time, period_s, fails
        self.ticks: list[float] = []
        self.failures: list[Exception] = []

    def tick(self) -> None:
        self.ticks.append(self.time.now_s)
        if self.fails:
            raise RuntimeError("no road")

    def tick_failed(self, error: Exception) -> None:
        self.failures.append(error)
