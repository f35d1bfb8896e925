"""Snapshots are kept rarely, beside everything else; where they cannot be, only the log is told."""

from __future__ import annotations

import asyncio
import gc
import weakref
from copy import deepcopy

import pytest
from structlog.testing import capture_logs

from service.sessions.session import Session
from service.store import MemoryStore, SnapshotRecord, SqlStore, StoreError
from sim.config import Config
from tests.support.sessions import ADD, UNDO, Service, do
from tests.support.snapshots import all_of, back, compared

STEP = {"do": "step", "ticks": 40}


class Refusing(MemoryStore):
    """No room for snapshots, or they cannot be read."""

    refuses = True

    async def save_snapshot(self, record: SnapshotRecord) -> None:
        if self.refuses:
            raise StoreError("database or disk is full")
        await super().save_snapshot(record)

    async def snapshot(self, session_id: str) -> SnapshotRecord | None:
        if self.refuses:
            raise StoreError("the file is damaged here")
        return await super().snapshot(session_id)


async def kept(service: Service, session: Session | str) -> int | None:
    """The change that the session's snapshot is of."""
    await service.manager.snapshots.flush()
    found = await service.store.snapshot(session if isinstance(session, str) else session.id)
    return None if found is None else found.sequence


async def test_one_is_kept_after_so_much_work_and_then_another() -> None:
    service = Service(snapshot_work=100)
    session = await service.session(Config(seed=3, vehicles=0, potholes=0), paused=True)
    found = []
    for _ in range(8):
        await do(session, STEP)
        found.append(await kept(service, session))
    assert found == [None, None, 3, 3, 3, 6, 6, 6]
    assert service.manager.snapshots.counts == {"kept": 2}
    await compared(service.store, session.id)


async def test_a_change_does_not_wait_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    from service.sessions.persistence import snapshot_scheduler as keeping

    def never(*_: object) -> SnapshotRecord:
        raise AssertionError("it is written later")

    service = Service(snapshot_work=1)
    session = await service.session(paused=True)
    with monkeypatch.context() as patch:
        patch.setattr(keeping, "pack", never)
        for _ in range(5):
            await do(session, ADD)
    assert len(service.manager.snapshots._due) == 1, "the latest alone is to be written"
    assert await kept(service, session) == 5


async def test_undoing_what_is_far_back_is_work_too() -> None:
    service = Service(snapshot_work=300)
    session = await service.session(Config(seed=3, vehicles=0, potholes=0), paused=True)
    await do(session, ADD)
    await do(session, {"do": "step", "ticks": 200})
    assert await kept(service, session) is None
    await do(session, UNDO)
    assert await kept(service, session) == 3


async def test_one_is_kept_when_it_goes_to_sleep_where_its_clock_stands() -> None:
    service = Service(snapshot_work=400)
    session = await service.session()
    held = weakref.ref(session)
    service.clock.tick(150)
    identity = session.id
    session.set_paused(True)
    let_go = await service.manager.evict([session], lambda _: True)
    del session
    gc.collect()
    assert (let_go, held()) == (1, None)
    assert await kept(service, identity) == 0
    again = await back(service.store, identity, short=True)
    assert again.timeline.tick == 150
    await compared(service.store, identity)


async def test_at_a_stop_those_that_owe_most_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    service = Service(snapshot_work=400)
    sessions = [await service.session() for _ in range(3)]
    for session, ticks in zip(sessions, (200, 300, 9), strict=True):
        session.set_paused(True)
        for _ in range(ticks):
            session.timeline.advance()
    monkeypatch.setattr("service.sessions.manager.SNAPSHOT_TIMEOUT_S", 5.0)
    await service.manager.close()
    assert list(service.store._snapshots) == [sessions[1].id, sessions[0].id]
    for session in sessions[:2]:
        assert (await back(service.store, session.id, short=True)).run == session.run


async def test_a_stop_does_not_wait_for_what_there_is_no_time_for(monkeypatch: pytest.MonkeyPatch) -> None:
    service = Service(snapshot_work=10)
    session = await service.session()
    service.clock.tick(100)
    monkeypatch.setattr("service.sessions.manager.SNAPSHOT_TIMEOUT_S", 0.0)
    await service.manager.close()
    assert service.store._snapshots == {}
    assert (await Service(service.store).manager.get(session.id)).run == session.run


async def test_who_came_back_the_long_way_comes_back_the_short_way_next() -> None:
    service = Service(snapshot_work=10**6)
    session = await service.session(paused=True)
    await do(session, STEP)
    await service.manager.close()
    assert service.store._snapshots == {}
    for fates in ({"kept": 1}, {"used": 1}):
        service = Service(service.store, snapshot_work=30)
        again = await service.manager.get(session.id)
        await service.manager.snapshots.flush()
        assert service.manager.snapshots.counts == fates
        assert again.run == session.run


async def test_a_fork_has_one_of_its_own_and_needs_no_parent() -> None:
    service = Service(snapshot_work=60)
    parent = await service.session(paused=True)
    await do(parent, STEP, ADD)
    await do(parent, {"do": "pause"}, ADD)
    await do(parent, STEP)
    near = await service.manager.fork(parent, 3)
    assert await kept(service, near) is None, "it is soon there"
    child = await service.manager.fork(parent, None)
    assert await kept(service, child) == child.sequence
    await do(child, UNDO)
    await do(child, ADD)
    await service.manager.delete(parent.id)
    assert await service.store.snapshot(parent.id) is None
    await compared(service.store, child.id)
    grandchild = await service.manager.fork(child, 75)
    assert await kept(service, grandchild) is not None
    await compared(service.store, grandchild.id)


async def test_no_more_wait_to_be_written_than_memory_is_meant_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("service.sessions.persistence.snapshot_scheduler.MAX_DUE", 2)
    service = Service(snapshot_work=1)
    sessions = [await service.session(paused=True) for _ in range(3)]
    for session in (*sessions, *sessions):
        await do(session, ADD)
    keeper = service.manager.snapshots
    assert list(keeper._due) == [each.id for each in sessions[:2]]
    await keeper.flush()
    await do(sessions[2], ADD)
    assert await kept(service, sessions[2]) == 3


async def test_deleted_while_it_was_being_written() -> None:
    service = Service(snapshot_work=1)
    session = await service.session(paused=True)
    await do(session, ADD)
    await service.manager.delete(session.id)
    await service.manager.snapshots.flush()
    assert (service.store._snapshots, service.manager.snapshots.counts) == ({}, {})


async def test_where_there_is_no_room_for_it_nobody_is_told_and_the_log_once() -> None:
    store = Refusing()
    service = Service(store, snapshot_work=1)
    session = await service.session(paused=True)
    with capture_logs() as logs:
        for _ in range(4):
            await do(session, ADD)
            await service.manager.snapshots.flush()
        assert service.manager.snapshots.counts == {"failed": 4}
        again = await Service(deepcopy(store), snapshot_work=10**6).manager.get(session.id)
    assert all_of(again) == all_of(session) | {"paused": all_of(again)["paused"]}
    assert [line["event"] for line in logs if line["log_level"] == "warning"] == [
        "a snapshot was not kept; sessions come back the long way"
    ]
    store.refuses = False
    await do(session, ADD)
    assert await kept(service, session) == 5


async def test_it_is_kept_in_its_own_time_without_being_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("service.sessions.persistence.snapshot_scheduler.DELAY_S", 0)
    service = Service(snapshot_work=1)
    session = await service.session(paused=True)
    await do(session, ADD)
    worker = service.manager.snapshots._worker
    assert worker is not None
    await asyncio.wait([worker], timeout=60)
    assert service.manager.snapshots.counts == {"kept": 1}
    await do(session, ADD)
    assert service.manager.snapshots._worker is not None
    assert await kept(service, session) == 2


async def test_in_a_file_too_with_talk_of_many_kinds(tmp_path: object) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    service = Service(store, snapshot_work=30)  # type: ignore[arg-type]
    session = await service.session(paused=True)
    for number in range(12):
        await do(session, ADD, {"do": "save", "name": f"n {number % 3}"}, {"do": "step", "ticks": 9})
        if number % 3 == 2:
            await do(session, {"do": "load", "name": "n 1"})
            await do(session, UNDO)
    await service.manager.close()
    await store.close()
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    service = Service(store)  # type: ignore[arg-type]
    again = await service.manager.get(session.id)
    assert service.manager.snapshots.counts == {"used": 1}
    assert all_of(again) == all_of(session)
    await store.close()
