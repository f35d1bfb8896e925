"""Rings of values that nobody holds any more, looked for in small pieces.

Python looks through what is new when there are so many values more than there were. A tick drops about as
many as it makes, so that takes seconds; by then what all live sessions are made of is new, and looking
through 2,000 of them held ticks up for a tenth of a second. Here the new is looked through twenty times a
second, which takes a fraction of a millisecond, and the old where memory has grown, or after some minutes.
Ticks leave no rings; requests and closed connections do.
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
        self, now: Callable[[], float] = time.monotonic, memory_mb: Callable[[], float] = held_mb
    ) -> None:
        self._now, self._memory_mb = now, memory_mb
        self._looked_s = self._whole_s = now()
        self._least_mb = memory_mb()

    def turn(self) -> int:
        """Look through what is due now; the generation that was: 0 the new, 2 all."""
        now = self._now()
        if now - self._looked_s >= LOOKED_AT_S:
            self._looked_s, held = now, self._memory_mb()
            self._least_mb = min(self._least_mb, held)
            if held > self._least_mb * GROWN or now - self._whole_s >= LATEST_S:
                gc.collect()
                self._whole_s, self._least_mb = now, self._memory_mb()
                return 2
        gc.collect(0)
        return 0

    async def run(self) -> None:
        """Do so until this is cancelled."""
        while True:
            await asyncio.sleep(EVERY_S)
            self.turn()


def begin() -> Sweep:
    """Leave what there is now out of it for good, and Python's own looking to bursts."""
    # Grammar, schemas and routes are 300,000 objects that stay. Looking through them took 200 ms and more.
    gc.collect()
    gc.freeze()
    gc.set_threshold(BURST, _NEVER, _NEVER)
    return Sweep()
