"""A limit on the work that is done on the event loop within one of its turns.

Ten requests that arrive together take the loop one after another within the same turn; each of them may be
quick, and their sum is what all others wait for.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Final

TURN_S: Final = 0.004
"""Work within one turn of the loop, in seconds; what has begun is finished."""


class TurnBudget:
    """Spreads pieces of work over turns of the loop. For the event loop's thread only."""

    def __init__(self) -> None:
        self._spent_s = 0.0
        self._renewing = False
        self._renewed = asyncio.Event()

    @asynccontextmanager
    async def piece(self) -> AsyncIterator[None]:
        """Do a piece of work without waiting, in a turn that has time for it."""
        while self._spent_s > TURN_S:
            self._renewed.clear()
            await self._renewed.wait()
        began = time.perf_counter()
        try:
            yield
        finally:
            self._spent_s += time.perf_counter() - began
            if not self._renewing:
                self._renewing = True
                asyncio.get_running_loop().call_soon(self._renew)

    def _renew(self) -> None:
        """Begin the budget of the next turn."""
        self._spent_s = 0.0
        self._renewing = False
        self._renewed.set()
