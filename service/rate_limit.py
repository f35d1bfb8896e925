"""Rate limits by token buckets: one for the language model, one for each client that changes something."""

from __future__ import annotations

import math
import time
from collections.abc import Callable


class TokenBucket:
    """Lets `per_minute` through in a minute, and at most as many at once."""

    __slots__ = ("_left", "_max", "_now", "_seen")

    def __init__(self, per_minute: int, now: Callable[[], float] = time.monotonic) -> None:
        """`now` is a clock in seconds that never goes back."""
        self._max = float(per_minute)
        self._left = self._max
        self._now = now
        self._seen = now()

    def take(self) -> int:
        """0 if one more may pass, which is counted; otherwise the whole seconds until one may."""
        wait_s = self.wait_s()
        if not wait_s:
            self._left -= 1
        return wait_s

    def wait_s(self) -> int:
        """Whole seconds until one more may pass; counts nothing."""
        now = self._now()
        per_second = self._max / 60
        self._left = min(self._max, self._left + (now - self._seen) * per_second)
        self._seen = now
        return 0 if self._left >= 1 else max(1, math.ceil((1 - self._left) / per_second))
