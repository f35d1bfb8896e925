"""Graceful shutdown with a deadline: it ends although a server is silent or a disk stands still.

Everything acknowledged is in the store already; what is lost by not waiting is where clocks stood. uvicorn
waits for the requests under way.
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
"""Seconds for closing sessions, model and store together."""

PROCESS_S = 1.6
"""Seconds for the process to end, from when its server begins to."""


class Deadline:
    """Ends the process if it does not end by itself: a thread that hangs in a call cannot be stopped."""

    def __init__(self, seconds: float = PROCESS_S) -> None:
        self._timer = threading.Timer(seconds, self._end_process)
        self._timer.daemon = True

    def begin(self) -> None:
        """Starts the timer."""
        if not self._timer.ident:
            self._timer.start()

    def lift(self) -> None:
        """Stops the timer: the process ends by itself."""
        self._timer.cancel()

    @staticmethod
    def _end_process() -> None:
        _LOG.error("the process did not end by itself and was ended")
        os._exit(1)


async def within(seconds: float, closing: Coroutine[Any, Any, None]) -> bool:
    """Waits for a coroutine; false if it was not done in time and was cancelled. Raises what it raised."""
    task = asyncio.ensure_future(closing)
    done, _ = await asyncio.wait([task], timeout=seconds)
    if done:
        task.result()
        return True
    # Not waited for after that: undoing what it was about may hang on the same thing.
    task.cancel()
    _LOG.error("the stop was not waited for", seconds=seconds)
    return False


def stop_when_hung_up() -> None:
    """Makes SIGHUP (a terminal that is closed) stop the service as SIGTERM does; `nohup` is respected.

    Python would end on the spot: nothing acknowledged is lost, but clients get no close frame.
    """
    hangup = getattr(signal, "SIGHUP", None)
    if hangup is not None and signal.getsignal(hangup) is signal.SIG_DFL:
        signal.signal(hangup, lambda *_: signal.raise_signal(signal.SIGTERM))
