"""Where work runs, what is refused, and what ends it: with real worker processes."""

from __future__ import annotations

import asyncio
import os
import threading
from collections.abc import Iterator

import pytest

from service.problems import Stopped, TooMuchWork
from service.settings import Settings
from service.work.asker import CURRENT_ASKER, Asker, of_nobody
from service.work.executor import WorkExecutor
from service.work.units import INLINE, THREAD
from service.work.worker import Worker
from tests.support import dear_calls


@pytest.fixture
def work() -> Iterator[WorkExecutor]:
    executor = WorkExecutor(Settings(database="memory:", work_processes=1, max_work=10_000_000))
    yield executor
    executor.stop()


def where() -> tuple[int, int]:
    return os.getpid(), threading.get_ident()


async def test_small_work_runs_at_once_larger_in_a_thread_large_in_a_process(work: WorkExecutor) -> None:
    here = where()
    assert await work.run(INLINE, where) == here
    process, thread = await work.run(THREAD, where)
    assert (process == here[0], thread == here[1]) == (True, False)
    assert (await work.run(THREAD + 1, where))[0] != here[0]
    assert work.fates == {"done": 1}


async def test_what_costs_too_much_is_refused_with_the_figure_and_the_setting(work: WorkExecutor) -> None:
    ran: list[int] = []
    with pytest.raises(TooMuchWork, match=r"12,345,678 units.*10,000,000.*ROADTALK_MAX_WORK"):
        await work.run(12_345_678, ran.append, 1)
    assert (ran, work.fates) == ([], {"refused": 1})


async def test_what_cannot_be_sent_to_a_process_runs_in_a_thread(work: WorkExecutor) -> None:
    assert await work.run(THREAD + 1, lambda: os.getpid()) == os.getpid()


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch) -> asyncio.Event:
    """Set when a call is sent to a process."""
    event, call = asyncio.Event(), Worker.call

    async def noted(self: Worker, packed: bytes) -> bytes:
        event.set()
        return await call(self, packed)

    monkeypatch.setattr(Worker, "call", noted)
    return event


async def test_work_ends_when_whoever_asked_has_gone(work: WorkExecutor, begun: asyncio.Event) -> None:
    gone = asyncio.Event()
    CURRENT_ASKER.set(Asker("client", gone.wait))
    running = asyncio.create_task(work.run(THREAD + 1, dear_calls.never_end))
    await begun.wait()
    gone.set()
    with pytest.raises(Stopped):
        await running
    assert work.fates == {"cancelled": 1}
    assert (work.queue.running, work.queue.waiting) == (0, 0)
    CURRENT_ASKER.set(Asker("client"))
    assert await work.run(THREAD + 1, dear_calls.add, 1, 2) == 3


async def test_work_is_limited_in_time_but_not_the_services_own() -> None:
    work = WorkExecutor(Settings(database="memory:", work_processes=1, max_work_s=0.05))
    CURRENT_ASKER.set(Asker("client"))
    try:
        with pytest.raises(TooMuchWork, match=r"0\.05 s.*ROADTALK_MAX_WORK_S"):
            await work.run(THREAD + 1, dear_calls.never_end)
        with of_nobody():
            assert await work.run(THREAD + 1, dear_calls.add, 1, 2) == 3
    finally:
        work.stop()


async def test_a_process_that_is_lost_is_told_with_the_limit_of_memory(work: WorkExecutor) -> None:
    with pytest.raises(TooMuchWork, match=r"1024 MB.*ROADTALK_MAX_WORK_MEMORY_MB"):
        await work.run(THREAD + 1, dear_calls.die)
    with pytest.raises(TooMuchWork, match="ROADTALK_MAX_WORK_MEMORY_MB"):
        await work.run(THREAD + 1, dear_calls.take_memory, 2_000)


async def test_a_stop_ends_work_at_once_and_takes_no_more(work: WorkExecutor, begun: asyncio.Event) -> None:
    running = asyncio.create_task(work.run(THREAD + 1, dear_calls.never_end))
    await begun.wait()
    work.stop()
    with pytest.raises(Stopped):
        await running
    with pytest.raises(Stopped):
        await work.run(THREAD + 1, dear_calls.add, 1, 2)
