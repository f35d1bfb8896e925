"""Rate limits by client: a token bucket for each."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable

from service.rate_limit import TokenBucket

MAX_CLIENTS = 10_000
"""Clients that are remembered; the one silent longest is forgotten, by then with a full bucket."""


class RateLimiter:
    """Lets `per_minute` of each client through; None lets all through."""

    def __init__(self, per_minute: int | None, now: Callable[[], float] = time.monotonic) -> None:
        self._per_minute = per_minute
        self._now = now
        self._buckets: OrderedDict[str, TokenBucket] = OrderedDict()

    def take(self, client: str) -> int:
        """0 if one more may pass, which is counted; otherwise the whole seconds until one may."""
        if self._per_minute is None:
            return 0
        bucket = self._buckets.get(client)
        if bucket is None:
            bucket = self._buckets[client] = TokenBucket(self._per_minute, self._now)
            if len(self._buckets) > MAX_CLIENTS:
                self._buckets.popitem(last=False)
        self._buckets.move_to_end(client)
        return bucket.take()

    def wait_s(self, client: str) -> int:
        """Whole seconds until one more of a client may pass; counts nothing."""
        bucket = self._buckets.get(client)
        return 0 if bucket is None else bucket.wait_s()
