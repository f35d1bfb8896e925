"""Slots: nothing is lost to a reader that keeps up, and a slow one is told what it lost."""

from __future__ import annotations

import asyncio

from service.sessions.subscribers import QUEUE_SIZE, MissedTicks, SessionDeleted, Subscribers


async def test_a_reader_that_keeps_up_hears_all_in_order() -> None:
    subscribers = Subscribers()
    subscriber = subscribers.subscribe()
    heard: list[bytes] = []
    for tick in range(100):
        subscribers.publish(tick, lambda tick=tick: b"%d" % tick)
        got = await subscriber.next()
        assert isinstance(got, list)
        heard += [notice.data for notice in got]
    assert heard == [b"%d" % tick for tick in range(100)]


async def test_a_slow_reader_is_told_the_whole_span() -> None:
    subscribers = Subscribers()
    subscriber = subscribers.subscribe()
    for tick in range(5, 5 + QUEUE_SIZE + 30):
        subscribers.publish(tick, lambda: b"")
    assert await subscriber.next() == MissedTicks(5, 5 + QUEUE_SIZE + 29)
    subscribers.publish(99, lambda: b"on")
    got = await subscriber.next()
    assert isinstance(got, list)
    assert [notice.data for notice in got] == [b"on"]


async def test_a_message_is_made_once_and_only_for_someone() -> None:
    subscribers, made = Subscribers(), []

    def encode() -> bytes:
        made.append(1)
        return b"x"

    subscribers.publish(1, encode)
    assert made == []
    readers = [subscribers.subscribe() for _ in range(50)]
    subscribers.publish(2, encode)
    assert made == [1]
    first, last = await readers[0].next(), await readers[-1].next()
    assert isinstance(first, list)
    assert isinstance(last, list)
    assert first[0].data is last[0].data


async def test_leaving_and_ending() -> None:
    subscribers = Subscribers()
    stays, leaves = subscribers.subscribe(), subscribers.subscribe()
    waiting = asyncio.create_task(stays.next())
    await asyncio.sleep(0)
    subscribers.unsubscribe(leaves)
    assert len(subscribers) == 1
    subscribers.close()
    assert isinstance(await asyncio.wait_for(waiting, 60), SessionDeleted)
    assert len(subscribers) == 0
