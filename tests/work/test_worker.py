"""Worker processes: real ones, that answer, are killed, die, or need too much memory."""

from __future__ import annotations

import asyncio
import os
import threading
from collections.abc import Iterator
from subprocess import Popen

import pytest

from service.problems import Invalid, PreconditionFailed
from service.work.codec import NotTransferableError, pack_call, run_call, unpack_result
from service.work.worker import Worker, WorkerLostError
from sim.session.errors import EditError
from tests.support import dear_calls


@pytest.fixture
def worker() -> Iterator[Worker]:
    worker = Worker(1_024)
    yield worker
    worker.kill()


async def test_it_answers_call_after_call_in_one_process_of_its_own(worker: Worker) -> None:
    first = unpack_result(await worker.call(pack_call(dear_calls.process_id, ())))
    again = unpack_result(await worker.call(pack_call(dear_calls.process_id, ())))
    assert first == again == worker.pid
    assert first != os.getpid()
    assert unpack_result(await worker.call(pack_call(dear_calls.add, (2, 3)))) == 5


async def test_it_yields_the_processor_to_the_service(worker: Worker) -> None:
    assert unpack_result(await worker.call(pack_call(dear_calls.niceness, ()))) >= os.nice(0)


async def test_a_cancelled_call_ends_its_process_and_the_next_one_has_another(worker: Worker) -> None:
    before = unpack_result(await worker.call(pack_call(dear_calls.process_id, ())))
    call = asyncio.ensure_future(worker.call(pack_call(dear_calls.never_end, ())))
    await asyncio.sleep(0)
    call.cancel()
    with pytest.raises(asyncio.CancelledError):
        await call
    await asyncio.to_thread(reaped)
    with pytest.raises(ProcessLookupError):
        os.kill(before, 0)
    assert unpack_result(await worker.call(pack_call(dear_calls.process_id, ()))) != before


def reaped() -> None:
    """Waits for the processes that were killed."""
    for thread in threading.enumerate():
        if thread.name == "reaper":
            thread.join()


async def test_killing_waits_for_no_process(worker: Worker, monkeypatch: pytest.MonkeyPatch) -> None:
    await worker.call(pack_call(dear_calls.process_id, ()))
    waited, wait = threading.Event(), Popen.wait

    def wait_later(process: Popen[bytes], timeout: float | None = None) -> int:
        waited.wait(10)
        return wait(process, timeout)

    monkeypatch.setattr(Popen, "wait", wait_later)
    worker.kill()  # would not return within ten seconds
    assert [thread.name for thread in threading.enumerate()].count("reaper") == 1
    waited.set()
    await asyncio.to_thread(reaped)


async def test_a_process_that_dies_is_told_and_replaced(worker: Worker) -> None:
    with pytest.raises(WorkerLostError):
        await worker.call(pack_call(dear_calls.die, ()))
    assert unpack_result(await worker.call(pack_call(dear_calls.add, (1, 1)))) == 2


async def test_memory_is_limited() -> None:
    worker = Worker(400)
    try:
        assert unpack_result(await worker.call(pack_call(dear_calls.take_memory, (10,)))) > 0
        with pytest.raises(MemoryError):
            unpack_result(await worker.call(pack_call(dear_calls.take_memory, (800,))))
    finally:
        worker.kill()


def test_what_a_call_raises_comes_back_whole() -> None:
    def raised(how: str) -> Exception:
        with pytest.raises(Exception) as found:  # noqa: PT011 - of several kinds
            unpack_result(run_call(pack_call(dear_calls.refuse, (how,))))
        return found.value

    invalid, stale, edit = raised("invalid"), raised("stale"), raised("edit")
    assert isinstance(invalid, Invalid)
    assert (invalid.detail, invalid.errors[0].field) == ("no", "here")
    assert isinstance(stale, PreconditionFailed)
    assert stale.headers == {"ETag": '"3"'}
    assert isinstance(edit, EditError)
    assert (edit.code, edit.facts["lane"]) == ("no_such_lane", 9)


def test_what_cannot_be_sent_is_said_before_it_is() -> None:
    with pytest.raises(NotTransferableError):
        pack_call(lambda: None, ())
