"""How often the model's server is asked: a bucket that fills as time goes by. Knows no requests."""

from __future__ import annotations

from collections.abc import Callable
from math import ceil


class Bucket:
    """Lets `per_minute` through in a minute, and at most as many at once."""

    def __init__(self, per_minute: int, clock: Callable[[], float]) -> None:
        """`clock` tells seconds and never goes back."""
        self._most = float(per_minute)
        self._per_second = per_minute / 60
        self._clock = clock
        self._left = self._most
        self._seen = clock()

    def take(self) -> bool:
        """Whether one more may pass now; if so, it is counted."""
        self._fill()
        if self._left < 1:
            return False
        self._left -= 1
        return True

    @property
    def wait_s(self) -> int:
        """Whole seconds until one more may pass."""
        self._fill()
        return max(0, ceil((1 - self._left) / self._per_second))

    def _fill(self) -> None:
        now = self._clock()
        self._left = min(self._most, self._left + (now - self._seen) * self._per_second)
        self._seen = now
