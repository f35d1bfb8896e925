"""A fork shares its parent's log, whatever becomes of the parent, and is as if it had been said anew."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service import actions as contract
from service.problems import NothingToUndo, ProblemError, UnknownName, UnknownSession
from service.sessions.persistence.recording import Recording, recording_json
from service.sessions.session import Session
from service.store import EntryRecord, SqlStore
from tests.support.fork_talk import TALK, talked
from tests.support.service import Service as Http
from tests.support.session_talk import SAID, anew, load, rewind, save
from tests.support.sessions import ADD, ADD_CARS, CONFIG, UNDO, Service, do, potholes


def stands(session: Session) -> tuple[object, ...]:
    return (session.run, session.sequence, list(session.timeline.entries), session.undo_stack.steps)


async def typed_afresh(session: Session) -> Session:
    """Another session to which the same is said at the same ticks, without a parent."""
    service = Service()
    other = await service.session(paused=True)
    for entry in session.timeline.entries:
        if entry.tick > other.timeline.tick:
            await do(other, {"do": "step", "ticks": entry.tick - other.timeline.tick})
        await do(other, *contract.dump((entry.action,)))
    if session.timeline.tick > other.timeline.tick:
        await do(other, {"do": "step", "ticks": session.timeline.tick - other.timeline.tick})
    return other


@settings(max_examples=80, deadline=None)
@given(
    said=TALK,
    forks=st.lists(st.tuples(st.floats(0, 1), st.lists(SAID, max_size=2)), min_size=1, max_size=3),
    delete=st.booleans(),
)
def test_forks_of_forks(
    said: list[tuple[int, list[dict[str, object]]]],
    forks: list[tuple[float, list[list[dict[str, object]]]]],
    delete: bool,
) -> None:
    async def walk() -> None:
        service, session = await talked(said)
        line = [session]
        for share, more in forks:
            child = await service.manager.fork(line[-1], round(line[-1].timeline.tick * share))
            assert child.run == anew(child)
            for actions in more:
                service.clock.tick(2)
                try:
                    await do(child, *actions)
                except ProblemError:
                    continue
            line.append(child)
        assert (await typed_afresh(line[-1])).run.world == line[-1].run.world
        recording = recording_json(line[-1], await service.manager.entries(line[-1]))
        known = [stands(each) for each in line]
        await service.manager.close()
        if delete:
            for each in line[:-1]:
                await Service(service.store).manager.delete(each.id)
        other = Service(service.store).manager
        for each, stood in zip(line, known, strict=True):
            if delete and each is not line[-1]:
                with pytest.raises(UnknownSession):
                    await other.get(each.id)
            else:
                assert stands(await other.get(each.id)) == stood
        recorded = Recording(
            entries=[EntryRecord(**entry) for entry in recording["entries"]],
            tick=recording["tick"],
            digest=recording["digest"],
        )
        copy = await Service().manager.create(None, CONFIG, paused=True, recorded=recorded)
        assert copy.run.world.digest() == line[-1].run.world.digest()
        numbers = [entry["sequence"] for entry in recording["entries"]]
        assert numbers == [entry.sequence for entry in await other.entries(await other.get(line[-1].id))]
        assert len(numbers) == copy.sequence
        if delete:
            await other.delete(line[-1].id)
            assert (service.store._sessions, service.store._entries) == ({}, {})

    asyncio.run(walk())


async def test_everything_of_a_fork_can_be_undone_live_and_after_a_restart() -> None:
    service = Service()
    parent = await service.session(paused=True)
    await do(parent, ADD)
    await do(parent, {"do": "step", "ticks": 3}, ADD, {"do": "step", "ticks": 2}, ADD, ADD)
    await do(parent, ADD_CARS)
    await do(parent, UNDO)
    child = await service.manager.fork(parent, None)
    assert (potholes(child), child.undo_stack.steps, child.sequence) == (8, 3, 2)
    await do(child, ADD)
    await service.manager.close()
    again = await Service(service.store).manager.get(child.id)
    assert stands(again) == stands(child)
    left = []
    for _ in range(4):
        await do(again, UNDO)
        left.append(potholes(again))
    assert left == [8, 6, 5, 4]
    with pytest.raises(NothingToUndo):
        await do(again, UNDO)
    fresh = Service(service.store).manager
    again = await fresh.get(child.id)
    assert (potholes(again), again.undo_stack.steps, len(again.undo_stack.undone)) == (4, 0, 4)
    for _ in range(4):
        await do(again, {"do": "redo"})
    assert potholes(again) == 9


async def test_a_fork_is_one_row_and_shares_states(tmp_path: Path) -> None:
    store = SqlStore(f"sqlite:///{tmp_path}/roads.db")
    await store.open()
    service = Service(store)  # type: ignore[arg-type]
    parent = await service.session(paused=True)
    for _ in range(30):
        await do(parent, ADD, UNDO, ADD)
        await do(parent, {"do": "step", "ticks": 1})
    child = await service.manager.fork(parent, None)
    assert child.run is parent.run
    assert child.timeline.entries._shared is parent.timeline.entries._shared
    async with store._transaction() as connection:
        found = await connection.exec_driver_sql(f"SELECT * FROM entries WHERE session_id = '{child.id}'")
        assert found.all() == []
    await do(child, ADD)
    await do(parent, rewind(20))
    await do(parent, ADD_CARS)
    await service.manager.close()
    other = Service(store).manager  # type: ignore[arg-type]
    await other.delete(parent.id)
    again = await other.get(child.id)
    assert stands(again) == stands(child)
    await store.close()


async def test_a_deleted_parent_takes_no_more_changes_and_is_seen_nowhere() -> None:
    service = Service()
    parent = await service.session()
    await do(parent, save("here"))
    await service.manager.fork(parent, None)
    await service.manager.delete(parent.id)
    with pytest.raises(UnknownSession):
        await do(parent, ADD)
    with pytest.raises(UnknownSession):
        await service.manager.delete(parent.id)
    assert [each.id for each in await service.store.newest(5)] != [parent.id]
    assert await service.manager.bookmarks(5, None) == []


async def test_a_name_of_another_session_is_told_where_it_is() -> None:
    service = Service()
    one = await service.manager.create("monday", CONFIG, paused=True)
    await do(one, save("hill"))
    other = await service.session(paused=True)
    with pytest.raises(
        UnknownName, match=r"It is saved in session monday; a name is found where it was given"
    ):
        await do(other, ADD, load("hill"))
    with pytest.raises(UnknownName) as raised:
        await do(other, load("dale"))
    assert "session" not in raised.value.detail


async def test_parent_and_names_over_http(service: Http) -> None:
    path = await service.session(paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 6})
    assert (await service.client.get(path)).json()["parent"] is None
    forked = await service.client.post(f"{path}/forks", json={"at_tick": 4, "name": "fork"})
    identity = path.rsplit("/", 1)[1]
    assert forked.json()["parent"] == {"id": identity, "tick": 4}
    listed = (await service.client.get("/api/v1/sessions")).json()["items"]
    assert [each["parent"] for each in listed] == [{"id": identity, "tick": 4}, None]

    await service.act(path, save("a"))
    await service.act(forked.headers["location"], save("b"))
    await service.act(path, {"do": "step", "ticks": 2}, save("c"))
    await service.act(path, save("a"))
    first = (await service.client.get("/api/v1/saved", params={"limit": 2})).json()
    assert [(each["name"], each["tick"], each["session"]) for each in first["items"]] == [
        ("a", 8, identity),
        ("c", 8, identity),
    ]
    assert first["more"]
    rest = (await service.client.get("/api/v1/saved", params={"after": first["after"]})).json()
    assert [(each["name"], each["tick"], each["session_name"]) for each in rest["items"]] == [
        ("b", 4, "fork")
    ]
    assert not rest["more"]
    await service.client.delete(path)
    left = (await service.client.get("/api/v1/saved")).json()["items"]
    assert [each["name"] for each in left] == ["b"]
    refused = await service.client.get("/api/v1/saved", params={"after": "x"})
    assert refused.status_code == 422
