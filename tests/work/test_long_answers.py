"""Long answers: they are made whoever listens, kept for a while, and never more than there is room for."""

from __future__ import annotations

import asyncio

import pytest

from service.problems import Invalid, ProblemError, TooMuchAtOnce, UnknownLongAnswer
from service.work import long_answers
from service.work.asker import CURRENT_ASKER
from service.work.codec import pack_call, unpack_result
from service.work.long_answers import KEEP_S, LongAnswers
from service.work.worker import Worker
from tests.support import dear_calls


async def made() -> str:
    assert CURRENT_ASKER.get().client == "someone"
    return "there"


async def never() -> str:
    await asyncio.Event().wait()
    raise AssertionError


async def test_an_answer_is_made_and_kept_for_a_while() -> None:
    now = [0.0]
    answers = LongAnswers[str](lambda: now[0])
    answer = answers.start("film", "session", "someone", made)
    assert answers.get("session", answer.id).state == "running"
    assert answer.task is not None
    await answer.task
    assert (answer.state, answer.result, answer.share) == ("done", "there", 1.0)
    now[0] = KEEP_S
    assert answers.get("session", answer.id) is answer
    now[0] = KEEP_S + 1
    with pytest.raises(UnknownLongAnswer):
        answers.get("session", answer.id)


async def test_problems_are_kept_and_defects_become_one() -> None:
    answers = LongAnswers[str]()

    async def refuse() -> str:
        raise Invalid("no")

    async def break_down() -> str:
        raise ZeroDivisionError

    refused, broken = (
        answers.start("film", "session", "", refuse),
        answers.start("film", "session", "", break_down),
    )
    await asyncio.wait([each.task for each in (refused, broken) if each.task is not None])
    assert (refused.state, broken.state) == ("failed", "failed")
    assert isinstance(refused.problem, Invalid)
    assert isinstance(broken.problem, ProblemError)
    assert broken.problem.status == 500


async def test_a_cancelled_one_ends_and_closing_ends_all() -> None:
    answers = LongAnswers[str]()
    cancelled, other = (answers.start("film", "session", "", never) for _ in range(2))
    task, left = cancelled.task, other.task
    assert task is not None
    assert left is not None
    await asyncio.sleep(0)
    answers.delete("session", cancelled.id)
    with pytest.raises(asyncio.CancelledError):
        await task
    with pytest.raises(UnknownLongAnswer):
        answers.delete("session", cancelled.id)
    await answers.close()
    assert left.cancelled()


async def test_the_oldest_make_room_and_those_under_way_do_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(long_answers, "MOST_KEPT", 2)
    answers = LongAnswers[str]()
    first = answers.start("film", "session", "someone", made)
    assert first.task is not None
    await first.task
    answers.start("film", "session", "someone", never)
    answers.start("film", "session", "someone", never)
    with pytest.raises(UnknownLongAnswer):
        answers.get("session", first.id)
    with pytest.raises(TooMuchAtOnce):
        answers.start("film", "session", "someone", never)
    await answers.close()


async def test_a_worker_process_tells_how_far_it_is() -> None:
    worker, heard = Worker(1_024), list[float]()
    try:
        packed = pack_call(dear_calls.tell_twice, ())
        assert unpack_result(await worker.call(packed, heard.append)) == "done"
        assert heard == [0.25, 0.75]
        assert unpack_result(await worker.call(packed)) == "done"
    finally:
        worker.kill()
