"""Rings of values that nobody holds any more, looked for in small pieces.

Python looks through what is new when there are so many values more than there were. A tick drops about as
many as it makes, so that takes seconds; by then what all live sessions are made of is new, and looking
through 2,000 of them held ticks up for a tenth of a second. Here the new is looked through twenty times a
second, which takes a fraction of a millisecond, and the old where memory has grown, or after some minutes.
Ticks leave no rings; requests and closed connections do. What live sessions and their readers are known to
need is therefore no growth: with thousands of them each look through the old would hold ticks up, and find
nothing.
"""

from __future__ import annotations

import asyncio
import gc
import os
import time
from collections.abc import Callable
from pathlib import Path

EVERY_S = 0.05
"""From one look through what is new to the next."""

LOOKED_AT_S = 5.0
"""How often it is seen whether memory has grown."""

GROWN = 1.5
"""So many times what it was at the least, and the old is looked through as well."""

LATEST_S = 300.0
"""After so long in any case."""

BURST = 20_000
"""So many values more at once are looked through at once."""

SESSION_MB = 0.03
"""What a live session needs, about."""

READER_MB = 0.07
"""What each of its readers needs, about, with what is kept for it."""

_NEVER = 1_000_000_000
_STATUS = Path("/proc/self/statm")


def held_mb() -> float:
    """Memory this process holds; 0 where the system does not say."""
    try:
        return int(_STATUS.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
    except (OSError, ValueError, IndexError):
        return 0.0


class Sweep:
    """Decides what is looked through."""

    def __init__(
        self,
        now: Callable[[], float] = time.monotonic,
        memory_mb: Callable[[], float] = held_mb,
        needed_mb: Callable[[], float] = lambda: 0.0,
    ) -> None:
        """`needed_mb`: how much of the memory is known to be in use."""
        self._now, self._memory_mb, self._needed_mb = now, memory_mb, needed_mb
        self._looked_s = self._whole_s = now()
        self._least_mb = self._unknown_mb()

    def turn(self) -> int:
        """Look through what is due now; the generation that was: 0 the new, 2 all."""
        now = self._now()
        if now - self._looked_s >= LOOKED_AT_S:
            self._looked_s, unknown = now, self._unknown_mb()
            self._least_mb = min(self._least_mb, unknown)
            if unknown > self._least_mb * GROWN or now - self._whole_s >= LATEST_S:
                gc.collect()
                self._whole_s, self._least_mb = now, self._unknown_mb()
                return 2
        gc.collect(0)
        return 0

    def _unknown_mb(self) -> float:
        # Some are smaller than what they are taken for; that must not make any growth at all too much.
        held = self._memory_mb()
        return max(held - self._needed_mb(), held / 4)

    async def run(self) -> None:
        """Do so until this is cancelled."""
        while True:
            await asyncio.sleep(EVERY_S)
            self.turn()


def begin(sessions: Callable[[], int] = lambda: 0, readers: Callable[[], int] = lambda: 0) -> Sweep:
    """Leave what there is now out of it for good, and Python's own looking to bursts.

    `sessions` and `readers` tell how many are live.
    """
    # Grammar, schemas and routes are 300,000 objects that stay. Looking through them took 200 ms and more.
    gc.collect()
    gc.freeze()
    gc.set_threshold(BURST, _NEVER, _NEVER)
    return Sweep(needed_mb=lambda: sessions() * SESSION_MB + readers() * READER_MB)
