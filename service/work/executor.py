"""The executor of work: on the event loop, in a thread or in a worker process, by its estimated cost.

What is small is done at once. What is larger leaves the event loop to others. What is larger still goes to a
worker process, where it is limited in time and memory, and ends when whoever asked hangs up. What would cost
more than a request may is refused before it starts.
"""

from __future__ import annotations

import asyncio
import os
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any, Final, Literal, ParamSpec, TypeVar

import structlog
from anyio import CapacityLimiter, to_thread

from service.problems import Stopped, TooMuchWork
from service.settings import Settings
from service.work.asker import CURRENT_ASKER, Asker
from service.work.codec import NotTransferableError, pack_call, unpack_result
from service.work.live_lane import LiveLane
from service.work.progress import HEARD
from service.work.queue import WorkQueue
from service.work.units import INLINE, THREAD
from service.work.worker import Worker, WorkerLostError

THREADS: Final = 1
"""Threads that compute at once: each delays the event loop a little."""

MOST_PROCESSES: Final = 8
"""Worker processes where the setting names no number, at most."""

Fate = Literal["done", "refused", "cancelled", "stopped", "lost"]
FATES: Final[tuple[Fate, ...]] = ("done", "refused", "cancelled", "stopped", "lost")
"""What becomes of dear work: `stopped` by the time limit, `lost` with its process."""

Given = ParamSpec("Given")
Result = TypeVar("Result")

_LOG = structlog.get_logger(__name__)


class WorkExecutor:
    """Runs the work of one service. All methods are for the event loop's thread."""

    def __init__(self, settings: Settings) -> None:
        count = settings.work_processes or min(MOST_PROCESSES, max(1, (os.cpu_count() or 2) - 1))
        workers = [Worker(settings.max_work_memory_mb) for _ in range(count)]
        self._settings = settings
        self._threads = CapacityLimiter(THREADS)
        self.queue = WorkQueue(workers, settings.max_client_work)
        self.live = LiveLane(Worker(settings.max_work_memory_mb))
        self.fates: Counter[str] = Counter()

    async def run(
        self, units: int, function: Callable[Given, Result], *args: Given.args, **named: Given.kwargs
    ) -> Result:
        """The result of a function that takes so many units of work, wherever it runs.

        A function that may run in a process, and all that it is given, can be pickled. Raises what it raises,
        and `TooMuchWork`, `TooMuchAtOnce` or `Stopped`.
        """
        self.check(units)
        if units <= INLINE:
            return function(*args, **named)
        if units <= THREAD:
            return await self.in_thread(function, *args, **named)
        return await self.in_process(units, function, *args, **named)

    def check(self, units: int) -> None:
        """Raise `TooMuchWork` where a request would cost more than one may."""
        most = self._settings.max_work
        if units > most:
            self.fates["refused"] += 1
            raise TooMuchWork(
                f"This takes about {units:,} units of work (cells of road × ticks × planner); at most "
                f"{most:,} are spent on one request (ROADTALK_MAX_WORK). Nothing was done."
            )

    async def in_thread(
        self, function: Callable[Given, Result], *args: Given.args, **named: Given.kwargs
    ) -> Result:
        """The result of a function, in one of the few threads that compute."""
        box: list[Any] = [partial(function, *args, **named)]
        await to_thread.run_sync(_call_in, box, limiter=self._threads)
        result: Result = box.pop()
        return result

    async def in_process(
        self, units: int, function: Callable[Given, Result], *args: Given.args, **named: Given.kwargs
    ) -> Result:
        """The result of a function in a worker process; in a thread where it cannot be sent to one."""
        call = partial(function, *args, **named)
        try:
            packed = await self.in_thread(pack_call, call, ())
        except NotTransferableError as error:
            _LOG.info("work cannot be sent to a process", work=function.__qualname__, error=str(error))
            return await self.in_thread(function, *args, **named)
        asker = CURRENT_ASKER.get()
        with self.queue.place(asker.client, units):
            answer = await self._while_asked(asker, packed)
        try:
            result: Result = await self.in_thread(unpack_result, answer)
        except MemoryError:
            raise self._lost() from None
        self.fates["done"] += 1
        return result

    def stop(self) -> None:
        """End all work in processes at once; no more is taken."""
        self.queue.stop()
        self.live.stop()

    async def _while_asked(self, asker: Asker, packed: bytes) -> bytes:
        """The answer of a worker; ended when whoever asked has gone. Raises `Stopped`."""
        work = asyncio.ensure_future(self._limited(asker.client, packed))
        if asker.gone is None:
            return await _owned(work)
        gone = asyncio.ensure_future(asker.gone())
        try:
            await asyncio.wait((work, gone), return_when=asyncio.FIRST_COMPLETED)
            if work.done():
                return work.result()
            self.fates["cancelled"] += 1
            raise Stopped
        finally:
            for each in (work, gone):
                each.cancel()
            await asyncio.wait((work, gone))

    async def _limited(self, client: str, packed: bytes) -> bytes:
        seconds = self._settings.max_work_s if client else None  # what is stored has to come back
        async with self.queue.worker(client) as worker:
            try:
                async with asyncio.timeout(seconds):
                    heard = HEARD.get()
                    return await (worker.call(packed) if heard is None else worker.call(packed, heard))
            except TimeoutError:
                self.fates["stopped"] += 1
                raise TooMuchWork(
                    f"This took more than {seconds:g} s, the most for one request (ROADTALK_MAX_WORK_S), "
                    "and was stopped. Nothing was done."
                ) from None
            except WorkerLostError as error:
                if self.queue.stopped:
                    raise Stopped from error
                raise self._lost() from error

    def _lost(self) -> TooMuchWork:
        self.fates["lost"] += 1
        most = self._settings.max_work_memory_mb
        return TooMuchWork(
            f"The process that did this ran out of memory or was ended; at most {most} MB are used "
            "(ROADTALK_MAX_WORK_MEMORY_MB). Nothing was done."
        )


def _call_in(box: list[Any]) -> None:
    """Replace a function in a box by its result; an idle thread keeps the box, and nothing in it."""
    box.append(box.pop()())


async def _owned(task: asyncio.Task[bytes]) -> bytes:
    """The result of a task that nobody else waits for: cancelled with whoever waits here."""
    try:
        return await task
    except asyncio.CancelledError:
        task.cancel()
        with suppress(asyncio.CancelledError):
            await task
        raise
