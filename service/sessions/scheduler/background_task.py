"""Work that would hold up the clock, done in a thread and taken back in its place.

What is owed is taken as soon as it is done, or before anything else that asks for it first: so whatever is
written after it was begun comes after it, live as in a replay that never does anything beside.
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
    """At most one piece of work under way."""

    def __init__(self, take: Callable[[Result], None]) -> None:
        """`take`: given each result, on the event loop's thread."""
        self._on_result = take
        self._future: Future[Result] | None = None

    def start(self, work: Callable[[], Result]) -> None:
        """Do this in a thread; needs a running loop."""
        self.finish()
        loop = asyncio.get_running_loop()

        def wake(done: Future[Result]) -> None:
            with suppress(RuntimeError):  # the loop is gone, and nobody waits any more
                loop.call_soon_threadsafe(self._finish_if_current, done)

        self._future = _WORKERS.submit(work)
        self._future.add_done_callback(wake)

    @property
    def busy(self) -> bool:
        """Whether work is under way, so that `settle` would have to wait."""
        return self._future is not None and not self._future.done()

    def finish(self) -> None:
        """Take what is owed, waiting for it if it is not done yet."""
        owed, self._future = self._future, None
        if owed is not None:
            self._on_result(owed.result())

    def _finish_if_current(self, done: Future[Result]) -> None:
        if self._future is done:
            self.finish()
