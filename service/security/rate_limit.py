"""Rate limit of changes: a token bucket for each client."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable

from service.rate_limit import TokenBucket

MAX_CLIENTS = 10_000
"""Clients that are remembered; the one silent longest is forgotten, by then with a full bucket."""


class RateLimiter:
    """Lets `per_minute` changes of each client through; None lets all through."""

    def __init__(self, per_minute: int | None, now: Callable[[], float] = time.monotonic) -> None:
        self._per_minute = per_minute
        self._now = now
        self._buckets: OrderedDict[str, TokenBucket] = OrderedDict()

    def take(self, client: str) -> int:
        """0 if one more change may pass, which is counted; otherwise the whole seconds until one may."""
        if self._per_minute is None:
            return 0
        bucket = self._buckets.get(client)
        if bucket is None:
            bucket = self._buckets[client] = TokenBucket(self._per_minute, self._now)
            if len(self._buckets) > MAX_CLIENTS:
                self._buckets.popitem(last=False)
        self._buckets.move_to_end(client)
        return bucket.take()
