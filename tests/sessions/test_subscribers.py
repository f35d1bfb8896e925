"""Slots: nothing is lost to a reader that keeps up, and a slow one is told what it lost."""

from __future__ import annotations

import asyncio

from service.sessions.subscribers import SLOT_MESSAGES, Gone, Missed, Watchers


async def test_a_reader_that_keeps_up_hears_all_in_order() -> None:
    watchers = Watchers()
    watcher = watchers.join()
    heard: list[bytes] = []
    for tick in range(100):
        watchers.publish(tick, lambda tick=tick: b"%d" % tick)
        got = await watcher.next()
        assert isinstance(got, list)
        heard += [notice.data for notice in got]
    assert heard == [b"%d" % tick for tick in range(100)]


async def test_a_slow_reader_is_told_the_whole_span() -> None:
    watchers = Watchers()
    watcher = watchers.join()
    for tick in range(5, 5 + SLOT_MESSAGES + 30):
        watchers.publish(tick, lambda: b"")
    assert await watcher.next() == Missed(5, 5 + SLOT_MESSAGES + 29)
    watchers.publish(99, lambda: b"on")
    got = await watcher.next()
    assert isinstance(got, list)
    assert [notice.data for notice in got] == [b"on"]


async def test_a_message_is_made_once_and_only_for_someone() -> None:
    watchers, made = Watchers(), []

    def encode() -> bytes:
        made.append(1)
        return b"x"

    watchers.publish(1, encode)
    assert made == []
    readers = [watchers.join() for _ in range(50)]
    watchers.publish(2, encode)
    assert made == [1]
    first, last = await readers[0].next(), await readers[-1].next()
    assert isinstance(first, list)
    assert isinstance(last, list)
    assert first[0].data is last[0].data


async def test_leaving_and_ending() -> None:
    watchers = Watchers()
    stays, leaves = watchers.join(), watchers.join()
    waiting = asyncio.create_task(stays.next())
    await asyncio.sleep(0)
    watchers.leave(leaves)
    assert len(watchers) == 1
    watchers.end()
    assert isinstance(await asyncio.wait_for(waiting, 60), Gone)
    assert len(watchers) == 0
