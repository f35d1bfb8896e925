"""The queue of dear work: who is next, and who is refused."""

from __future__ import annotations

import asyncio

import pytest

from service.problems import Stopped, TooMuchAtOnce
from service.work.queue import MOST_WAITING, WorkQueue
from service.work.worker import Worker


def queue(per_client: int = 100) -> WorkQueue:
    return WorkQueue([Worker(1_024)], per_client)


async def turn(work: WorkQueue, client: str, begun: list[str], end: asyncio.Event) -> None:
    with work.place(client, 1_000):
        async with work.worker(client):
            begun.append(client)
            await end.wait()


async def settle() -> None:
    for _ in range(10):
        await asyncio.sleep(0)


async def test_clients_have_turns_one_after_the_other() -> None:
    work, begun, end = queue(), list[str](), asyncio.Event()
    tasks = [
        asyncio.create_task(turn(work, client, begun, end)) for client in ("a", "a", "a", "a", "b", "c", "b")
    ]
    await settle()
    end.set()
    await asyncio.gather(*tasks)
    assert begun == ["a", "a", "b", "c", "a", "b", "a"]
    assert (work.running, work.waiting) == (0, 0)


async def test_a_client_may_have_so_many_at_once() -> None:
    work, begun, end = queue(per_client=2), list[str](), asyncio.Event()
    tasks = [asyncio.create_task(turn(work, "a", begun, end)) for _ in range(2)]
    await settle()
    with pytest.raises(TooMuchAtOnce, match="ROADTALK_MAX_CLIENT_WORK") as refused, work.place("a", 1):
        pass
    assert int(refused.value.headers["Retry-After"]) >= 1
    with work.place("b", 1):
        pass  # another client's
    end.set()
    await asyncio.gather(*tasks)
    with work.place("a", 1):
        pass


async def test_the_queue_of_all_is_limited_but_not_for_the_service_itself() -> None:
    work, begun, end = queue(), list[str](), asyncio.Event()
    tasks = [asyncio.create_task(turn(work, str(client), begun, end)) for client in range(MOST_WAITING + 1)]
    await settle()
    assert (work.running, work.waiting) == (1, MOST_WAITING)
    with pytest.raises(TooMuchAtOnce), work.place("late", 1):
        pass
    with work.place("", 1):
        pass
    end.set()
    await asyncio.gather(*tasks)


async def test_who_leaves_while_waiting_leaves_nothing_behind() -> None:
    work, begun, end = queue(), list[str](), asyncio.Event()
    first = asyncio.create_task(turn(work, "a", begun, end))
    second = asyncio.create_task(turn(work, "b", begun, end))
    third = asyncio.create_task(turn(work, "c", begun, end))
    await settle()
    second.cancel()
    end.set()
    await asyncio.gather(first, third)
    assert begun == ["a", "c"]
    assert (work.running, work.waiting) == (0, 0)


async def test_a_stop_ends_what_waits_and_takes_no_more() -> None:
    work, begun, end = queue(), list[str](), asyncio.Event()
    first = asyncio.create_task(turn(work, "a", begun, end))
    second = asyncio.create_task(turn(work, "b", begun, end))
    await settle()
    work.stop()
    with pytest.raises(Stopped):
        await second
    with pytest.raises(Stopped), work.place("c", 1):
        pass
    end.set()
    await first
