"""A session that takes long to come back holds nobody up, and whoever runs the service is told."""

from __future__ import annotations

import asyncio
import threading
from typing import Any

import pytest
import structlog

from service.sessions.persistence import restore as waking
from tests.support.sessions import ADD, Service, do

PATIENCE_S = 120
"""Far more than is ever needed: only a service that is held up waits for so long."""


async def test_others_are_served_while_one_comes_back(monkeypatch: pytest.MonkeyPatch) -> None:
    first = Service()
    session = await first.session()
    await do(session, ADD)
    service = Service(first.store)
    other = await service.session()
    begun, served = threading.Event(), threading.Event()

    def held(*given: Any) -> Any:
        begun.set()
        assert served.wait(PATIENCE_S), "the others were not served"
        return waking.restore(*given)

    monkeypatch.setattr("service.sessions.manager.restore", held)
    coming = asyncio.ensure_future(service.manager.get(session.id))
    assert await asyncio.to_thread(begun.wait, PATIENCE_S)
    await do(other, ADD)
    service.clock.tick()
    assert other.timeline.tick == 1
    assert not coming.done()
    served.set()
    assert (await coming).run == session.run


@pytest.mark.parametrize("short", [False, True])
async def test_a_long_way_back_is_told(short: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(waking, "LONG_ENTRIES", 3)
    service = Service(snapshot_work=1 if short else 10**6)
    session = await service.session(paused=True)
    for _ in range(3):
        await do(session, ADD)
    await service.manager.snapshots.flush()
    with structlog.testing.capture_logs() as told:
        await Service(service.store).manager.get(session.id)
    long = [line for line in told if line["event"].startswith("a session is done again from all of its log")]
    if short:
        assert not long
    else:
        assert [(line["entries"], line["reason"]) for line in long] == [(3, "there is no snapshot of it")]
