"""How often each client may change something: a bucket for each that fills as time goes by."""

from __future__ import annotations

import math
import time
from collections import OrderedDict
from collections.abc import Callable

MOST_CLIENTS = 10_000
"""Clients that are remembered; whoever was longest silent is forgotten, by then with a full bucket."""


class Buckets:
    """Lets `per_minute` of each client through in a minute, and at most as many at once; None lets all."""

    def __init__(self, per_minute: int | None, now: Callable[[], float] = time.monotonic) -> None:
        self._most = per_minute
        self._now = now
        self._left: OrderedDict[str, tuple[float, float]] = OrderedDict()

    def take(self, client: str) -> int:
        """0 where one more may pass, which is counted; else the whole seconds until one may."""
        if self._most is None:
            return 0
        now = self._now()
        left, seen = self._left.get(client, (float(self._most), now))
        left = min(float(self._most), left + (now - seen) * self._most / 60)
        wait = 0 if left >= 1 else max(1, math.ceil((1 - left) * 60 / self._most))
        self._left[client] = (left if wait else left - 1, now)
        self._left.move_to_end(client)
        if len(self._left) > MOST_CLIENTS:
            self._left.popitem(last=False)
        return wait
