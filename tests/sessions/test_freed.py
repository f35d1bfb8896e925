"""Sessions that nobody uses any more are freed at once, not when garbage is looked for."""

from __future__ import annotations

import asyncio
import gc
import weakref
from collections.abc import Iterator

import pytest

from service.sessions.session import Session
from sim.config import Config
from sim.events import Event, EventType
from tests.support.sessions import ADD, Service, do


@pytest.fixture(autouse=True)
def no_collector() -> Iterator[None]:
    gc.collect()
    gc.disable()
    yield
    gc.enable()


async def used(service: Service) -> tuple[str, weakref.ref[Session]]:
    """A session that was stepped, changed and ticked; its id, and whether it is still there."""
    session = await service.session(Config(seed=1), paused=True)
    await do(session, {"do": "step", "ticks": 30}, ADD)
    for _ in range(3):
        session.tick()
    await asyncio.sleep(0)
    return session.id, weakref.ref(session)


async def test_a_deleted_session_is_freed() -> None:
    service = Service()
    name, there = await used(service)
    await service.manager.delete(name)
    assert there() is None


async def test_a_sleeping_session_is_freed_and_comes_back_the_same() -> None:
    service = Service()
    name, there = await used(service)
    await service.manager.evict([await service.manager.get(name)], lambda _: True)
    assert there() is None
    assert (await service.manager.get(name)).sequence == 1


async def test_what_a_part_still_has_to_say_is_dropped_with_its_session() -> None:
    service = Service()
    session = await service.session(Config(seed=1), paused=True)
    feed, ticks, run = session.feed, session.ticks, session.run
    await service.manager.delete(session.id)
    del session
    feed._publish_late([(Event(1, EventType.WAY_OPEN, 0), "open")])
    ticks._on_decision(run, {})
    with pytest.raises(ReferenceError):
        feed.present()
