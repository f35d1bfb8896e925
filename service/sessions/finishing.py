"""Work that is finished whatever becomes of whoever asked for it, and costs no task where it never waits.

A change whose caller goes away must not stop halfway, so it is done in a task of its own; but starting one,
and hearing of its end, takes three turns of the event loop. Most changes wait for nothing, or for the disk
alone: they are begun at once, in the task of whoever asks, and only what is left at the first wait is given
a task. Work must not come to know the task it begins in before that (as time limits and scopes do): `apart`
is waited for first.
"""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine, Generator
from typing import Any, TypeVar

Found = TypeVar("Found")


async def finished(work: Coroutine[Any, Any, Found], tasks: set[asyncio.Task[Any]]) -> Found:
    """What the work answers; while it goes on in a task of its own, that is among `tasks`."""
    try:
        waits_for = work.send(None)
    except StopIteration as end:
        found: Found = end.value
        return found
    task = asyncio.ensure_future(_rest(work, waits_for))
    tasks.add(task)
    task.add_done_callback(tasks.discard)
    # A task that is cancelled before its first turn never comes to the work it has.
    task.add_done_callback(lambda _: work.close())
    return await asyncio.shield(task)


async def apart() -> None:
    """From here on, work is in a task of its own."""
    await asyncio.sleep(0)


async def _rest(work: Coroutine[Any, Any, Found], waits_for: Any) -> Found:
    found: Found = await _Rest(work, waits_for)
    return found


class _Rest:
    """What is left of work that has come to its first wait."""

    __slots__ = ("_waits_for", "_work")

    def __init__(self, work: Coroutine[Any, Any, Any], waits_for: Any) -> None:
        self._work = work
        self._waits_for = waits_for

    def __await__(self) -> Generator[Any, Any, Any]:
        work, waits_for = self._work, self._waits_for
        try:
            while True:
                try:
                    yield waits_for
                except BaseException as thrown:  # a task that is cancelled throws that into its work
                    waits_for = work.throw(thrown)
                else:
                    waits_for = work.send(None)
        except StopIteration as end:
            return end.value
