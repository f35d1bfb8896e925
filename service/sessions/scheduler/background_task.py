"""A background task that runs in a thread, with its result taken in order.

The result is taken as soon as it is there, or when `finish` is called before something else is written: what
is written after the task began comes after its result, live as in a replay that uses no threads.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from typing import Generic, TypeVar

Result = TypeVar("Result")

_WORKERS = ThreadPoolExecutor(max_workers=1, thread_name_prefix="later")


class BackgroundTask(Generic[Result]):
    """At most one piece of work at a time."""

    def __init__(self, take: Callable[[Result], None]) -> None:
        """`take`: called with each result, on the event loop's thread."""
        self._on_result = take
        self._future: Future[Result] | None = None

    def start(self, work: Callable[[], Result]) -> None:
        """Run work in a thread; needs a running loop."""
        self.finish()
        loop = asyncio.get_running_loop()

        def wake(done: Future[Result]) -> None:
            with suppress(RuntimeError):  # the loop is gone, and nobody waits any more
                loop.call_soon_threadsafe(self._finish_if_current, done)

        self._future = _WORKERS.submit(work)
        self._future.add_done_callback(wake)

    @property
    def busy(self) -> bool:
        """Whether work is under way, so that `finish` would block."""
        return self._future is not None and not self._future.done()

    def finish(self) -> None:
        """Take the result of the work, blocking until it is there."""
        owed, self._future = self._future, None
        if owed is not None:
            self._on_result(owed.result())

    def _finish_if_current(self, done: Future[Result]) -> None:
        if self._future is done:
            self.finish()
