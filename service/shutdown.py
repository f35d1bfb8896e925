"""A stop that ends, also where what is to be let go of hangs: a silent server, a disk that stands still.

All that was acknowledged is in the store already; what is lost by not waiting is where clocks stood. Leaves
out how requests under way are waited for, which the server does.
"""

from __future__ import annotations

import asyncio
import os
import signal
import threading
from collections.abc import Coroutine
from typing import Any

import structlog

_LOG = structlog.get_logger(__name__)

STOP_S = 0.3
"""How long sessions, model and store together may take to be let go of."""

PROCESS_S = 1.6
"""How long the whole process may take to end, from when its server begins to."""


class Deadline:
    """Ends the process if it does not end by itself: a thread that hangs in a call cannot be told to."""

    def __init__(self, seconds: float = PROCESS_S) -> None:
        self._timer = threading.Timer(seconds, self._passed)
        self._timer.daemon = True

    def begin(self) -> None:
        """The stop begins now."""
        if not self._timer.ident:
            self._timer.start()

    def lift(self) -> None:
        """It has ended by itself."""
        self._timer.cancel()

    @staticmethod
    def _passed() -> None:
        _LOG.error("the process did not end by itself and was ended")
        os._exit(1)


async def within(seconds: float, closing: Coroutine[Any, Any, None]) -> bool:
    """Whether something was done in time; if not, it is told to end and left alone.

    Raises what it raised.
    """
    task = asyncio.ensure_future(closing)
    done, _ = await asyncio.wait([task], timeout=seconds)
    if done:
        task.result()
        return True
    # Not waited for any more: undoing what it was about may hang on the same thing.
    task.cancel()
    _LOG.error("the stop was not waited for", seconds=seconds)
    return False


def stop_when_hung_up() -> None:
    """Let a terminal that is closed (SIGHUP) stop the service as SIGTERM does; `nohup` is heeded.

    Python would end on the spot: nothing acknowledged is lost, but nobody is told.
    """
    hangup = getattr(signal, "SIGHUP", None)
    if hangup is not None and signal.getsignal(hangup) is signal.SIG_DFL:
        signal.signal(hangup, lambda *_: signal.raise_signal(signal.SIGTERM))
