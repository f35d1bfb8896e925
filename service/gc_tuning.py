"""Garbage collection in small pieces, so that no tick waits for a full collection.

Python collects a generation once it has grown by so much. A tick allocates about as much as it frees, so by
then everything that live sessions are made of is young, and a collection looks through all of it. Here the
young generation is collected twenty times a second, and everything only when memory has grown by much: that
takes 0.2 to 0.3 s, in which nobody is answered.

The longest pause with 1,000 live sessions is 7 ms of processor time this way, 81 ms with `gc.freeze` and high
thresholds alone, and 210 ms with Python's defaults; the clock promises ticks within 20 ms (`python -m
bench.live`).

Ticks leave no cycles; requests and closed connections do. Memory that live sessions and their readers are
known to need does not count as growth.
"""

from __future__ import annotations

import asyncio
import gc
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

EVERY_S = 0.05
"""Interval between collections of the young generation."""

MEMORY_CHECK_S = 5.0
"""Interval between checks whether memory has grown."""

GROWTH = 1.5
"""Growth of memory, as a factor, at which everything is collected."""

LEAST_GROWTH_MB = 256.0
"""Growth of memory below which nothing but the young generation is collected: old rings may lie so long."""

FULL_EVERY_S = 300.0
"""Interval after which less than `GROWTH` is enough for a full collection."""

BURST = 20_000
"""Allocations in one piece of work after which Python itself collects the young generation."""

SESSION_MB = 0.03
"""Memory of a live session, approximate."""

READER_MB = 0.07
"""Memory of each of its readers, approximate."""

_NEVER = 1_000_000_000
_STATUS = Path("/proc/self/statm")


def resident_mb() -> float:
    """Resident memory of this process; 0 where the system does not say."""
    try:
        return int(_STATUS.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
    except (OSError, ValueError, IndexError):
        return 0.0


class Collector:
    """Decides what is collected, and when."""

    def __init__(
        self,
        now: Callable[[], float] = time.monotonic,
        memory_mb: Callable[[], float] = resident_mb,
        needed_mb: Callable[[], float] = lambda: 0.0,
    ) -> None:
        """`needed_mb` is the memory that is known to be in use."""
        self._now, self._memory_mb, self._needed_mb = now, memory_mb, needed_mb
        self._checked_s = self._full_s = now()
        self._least_mb = self._unknown_mb()

    def collect(self) -> int:
        """Collects what is due now; the generation that was collected: 0 (young) or 2 (all)."""
        now = self._now()
        if now - self._checked_s >= MEMORY_CHECK_S:
            self._checked_s, unknown = now, self._unknown_mb()
            self._least_mb = min(self._least_mb, unknown)
            grown = unknown > self._least_mb * GROWTH or now - self._full_s >= FULL_EVERY_S
            if grown and unknown >= self._least_mb + LEAST_GROWTH_MB:
                gc.collect()
                self._full_s, self._least_mb = now, self._unknown_mb()
                return 2
        gc.collect(0)
        return 0

    def _unknown_mb(self) -> float:
        # Some sessions need less than is assumed, which must not make any growth at all too much.
        held = self._memory_mb()
        return max(held - self._needed_mb(), held / 4)

    async def run(self) -> None:
        """Collects until it is cancelled."""
        while True:
            await asyncio.sleep(EVERY_S)
            self.collect()


@contextmanager
def no_collection() -> Iterator[None]:
    """Collects no garbage inside, and leaves all there is then out of later collections.

    For work whose values nearly all stay, such as imports.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.freeze()
            gc.enable()


def begin(sessions: Callable[[], int] = lambda: 0, readers: Callable[[], int] = lambda: 0) -> Collector:
    """Freezes all present objects and leaves only bursts to Python's own collections.

    `sessions` and `readers` return how many are live.
    """
    # Grammar, schemas and routes are 300,000 objects that stay. Looking through them took 200 ms and more,
    # and finds next to nothing now.
    gc.freeze()
    gc.set_threshold(BURST, _NEVER, _NEVER)
    return Collector(needed_mb=lambda: sessions() * SESSION_MB + readers() * READER_MB)
