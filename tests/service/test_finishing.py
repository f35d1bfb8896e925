"""Work that is begun at once, and finished whatever becomes of whoever asked for it."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from service.sessions.finishing import apart, finished


async def test_what_never_waits_is_done_in_the_task_of_whoever_asks() -> None:
    async def work() -> asyncio.Task[Any] | None:
        return asyncio.current_task()

    tasks: set[asyncio.Task[Any]] = set()
    assert await finished(work(), tasks) is asyncio.current_task()
    assert not tasks


async def test_what_fails_at_once_fails_whoever_asks() -> None:
    async def work() -> None:
        raise LookupError("nowhere")

    with pytest.raises(LookupError, match="nowhere"):
        await finished(work(), set())


async def test_what_waits_goes_on_when_its_caller_has_gone() -> None:
    ready, done = asyncio.Event(), asyncio.Event()

    async def work() -> None:
        await ready.wait()
        await asyncio.sleep(0)
        done.set()

    tasks: set[asyncio.Task[Any]] = set()
    caller = asyncio.create_task(finished(work(), tasks))
    await asyncio.sleep(0)
    (going_on,) = tasks
    caller.cancel()
    with pytest.raises(asyncio.CancelledError):
        await caller
    assert not done.is_set()
    ready.set()
    await going_on
    assert done.is_set()
    assert not tasks


async def test_what_fails_later_fails_whoever_asks() -> None:
    ready: asyncio.Future[int] = asyncio.get_running_loop().create_future()

    async def work() -> int:
        return 1 + await ready

    caller = asyncio.create_task(finished(work(), set()))
    await asyncio.sleep(0)
    ready.set_exception(LookupError("nowhere"))
    with pytest.raises(LookupError, match="nowhere"):
        await caller


async def test_what_is_cancelled_itself_ends_as_cancelled_work_does() -> None:
    cleaned: list[str] = []

    async def work() -> None:
        try:
            await asyncio.Event().wait()
        finally:
            cleaned.append("up")

    tasks: set[asyncio.Task[Any]] = set()
    caller = asyncio.create_task(finished(work(), tasks))
    await asyncio.sleep(0)
    (going_on,) = tasks
    going_on.cancel()
    with pytest.raises(asyncio.CancelledError):
        await caller
    assert cleaned == ["up"]


async def test_time_limits_in_it_are_its_own() -> None:
    """A limit belongs to the task that it was set in: not to that of whoever asked first."""

    async def work() -> str:
        await apart()
        try:
            async with asyncio.timeout(0):
                await asyncio.Event().wait()
        except TimeoutError:
            return "over"
        return "never"

    assert await finished(work(), set()) == "over"
