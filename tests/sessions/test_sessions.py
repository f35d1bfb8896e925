"""A change is all or nothing, stored before it is told, and taken back as one."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.problems import (
    DoesNotFit,
    Invalid,
    NotAvailable,
    NothingToUndo,
    NotSaved,
    ProblemError,
)
from service.store import EntryRecord, MemoryStore, StoredResponse, StoreError
from sim.types import Kind
from tests.support.sessions import (
    ADD,
    ADD_CARS,
    PAUSE,
    REDO,
    RESUME,
    UNDO,
    Service,
    do,
    fingerprint,
    potholes,
)

# All or nothing


@pytest.mark.parametrize(
    ("bad", "problem"),
    [
        ({"do": "add", "kind": "barrier", "count": 300}, DoesNotFit),
        ({"do": "remove", "kind": "pedestrian", "count": 1}, DoesNotFit),
        ({"do": "add", "kind": "av", "count": 1}, NotAvailable),
        ({"do": "record", "on": True}, NotAvailable),
        ({"do": "rewind", "ticks": 4}, Invalid),
        ({"do": "load", "name": "monday"}, Invalid),
        ({"do": "redo"}, NothingToUndo),
        ({"do": "step", "ticks": 10_000}, Invalid),
    ],
)
async def test_one_bad_action_undoes_its_neighbours(
    bad: dict[str, object], problem: type[ProblemError]
) -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(3)
    before = fingerprint(session)
    with pytest.raises(problem) as raised:
        await do(session, PAUSE, ADD, bad, ADD)
    assert fingerprint(session) == before
    assert list(await service.store.entries(session.id)) == []
    assert raised.value.detail.endswith(".")


async def test_a_dry_run_tells_and_does_nothing() -> None:
    service = Service()
    session = await service.session()
    before = fingerprint(session)
    assert "there are 5 potholes now" in await do(session, ADD, dry_run=True)
    assert fingerprint(session) == before
    assert list(await service.store.entries(session.id)) == []


async def test_asking_is_no_change() -> None:
    service = Service()
    session = await service.session()
    service.clock.tick(4)
    before = fingerprint(session)
    assert await do(session, {"do": "ask", "about": "status"})
    assert fingerprint(session) == before


async def test_a_change_is_stored_before_it_is_told() -> None:
    class Slow(MemoryStore):
        def __init__(self) -> None:
            super().__init__()
            self.asked, self.may = asyncio.Event(), asyncio.Event()

        async def append(self, session_id: str, entry: EntryRecord) -> None:
            self.asked.set()
            await self.may.wait()
            await super().append(session_id, entry)

    store = Slow()
    service = Service(store)
    session = await service.session()
    subscriber = session.subscribers.subscribe()
    task = asyncio.create_task(do(session, ADD))
    await asyncio.wait_for(store.asked.wait(), 60)

    service.clock.tick()
    assert (session.timeline.tick, potholes(session), session.sequence) == (0, 4, 0), (
        "time waits for the store"
    )
    hearing = asyncio.create_task(subscriber.next())
    await asyncio.sleep(0)
    assert not hearing.done()

    store.may.set()
    await asyncio.wait_for(task, 60)
    assert (session.timeline.tick, potholes(session)) == (1, 5), "and the tick that came due is taken after"
    heard = await asyncio.wait_for(hearing, 60)
    assert isinstance(heard, list)
    assert [b'"changed"' in notice.data for notice in heard] == [True, False]


async def test_what_is_not_stored_is_not_done() -> None:
    class Full(MemoryStore):
        async def append(self, session_id: str, entry: EntryRecord) -> None:
            raise StoreError(f"disk full at {session_id}, {entry.sequence}")

    service = Service(Full())
    session = await service.session()
    before = fingerprint(session)
    with pytest.raises(NotSaved):
        await do(session, ADD)
    assert fingerprint(session) == before
    service.clock.tick()
    assert session.timeline.tick == 1, "and the road goes on"


async def test_a_change_is_finished_even_when_its_caller_goes() -> None:
    written = asyncio.Event()

    class Slow(MemoryStore):
        async def append(self, session_id: str, entry: EntryRecord, *answer: StoredResponse | None) -> None:
            await written.wait()
            await super().append(session_id, entry, *answer)

    service = Service(Slow())
    session = await service.session()
    task = asyncio.create_task(do(session, ADD))
    await asyncio.sleep(0)
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    assert session.sequence == 0, "it is not kept yet"
    written.set()
    await do(session, {"do": "ask", "about": "status"})
    assert len(await service.store.entries(session.id)) == session.sequence == potholes(session) - 4


# Taking back


async def test_one_undo_takes_back_one_utterance_with_its_pause() -> None:
    service = Service()
    session = await service.session()
    before = session.run
    await do(session, PAUSE, ADD, ADD_CARS)
    assert session.paused
    await do(session, UNDO)
    assert (session.run, session.paused) == (before, False)
    await do(session, REDO)
    assert (potholes(session), session.paused) == (5, True)


async def test_a_compound_with_an_undo_in_it_is_one_step() -> None:
    service = Service()
    session = await service.session()
    await do(session, ADD)
    service.clock.tick(2)
    one = session.run
    await do(session, UNDO, ADD_CARS)
    assert (potholes(session), session.run.world.count(Kind.VEHICLE)) == (4, 8)
    two = session.run
    await do(session, UNDO)
    assert session.run == one, "the first change is back"
    await do(session, REDO)
    assert session.run == two
    await do(session, UNDO)
    await do(session, UNDO)
    assert potholes(session) == 4


async def test_an_undo_after_a_change_in_the_same_breath_takes_that_back() -> None:
    session = await Service().session()
    await do(session, ADD)
    before = session.run
    await do(session, ADD_CARS, UNDO)
    assert session.run.world == before.world
    await do(session, UNDO)
    assert potholes(session) == 4


async def test_pausing_alone_is_no_step() -> None:
    session = await Service().session()
    await do(session, ADD)
    await do(session, PAUSE)
    await do(session, UNDO)
    assert (potholes(session), session.paused) == (4, True)


async def test_a_new_change_forgets_what_could_be_redone() -> None:
    session = await Service().session()
    await do(session, ADD)
    await do(session, UNDO)
    await do(session, ADD_CARS)
    with pytest.raises(NothingToUndo):
        await do(session, REDO)


UTTERANCES = st.lists(
    st.sampled_from([ADD, ADD_CARS, PAUSE, RESUME, UNDO, REDO, {"do": "step", "ticks": 3}, {"do": "reset"}]),
    min_size=1,
    max_size=3,
)


@given(said=st.lists(st.tuples(st.integers(0, 5), UTTERANCES), max_size=8))
def test_any_talk_comes_back_from_the_store_to_the_same_digest(
    said: list[tuple[int, list[dict[str, object]]]],
) -> None:
    """The store's entries, replayed by another manager, are the session."""

    async def talk() -> None:
        service = Service()
        session = await service.session()
        for ticks, actions in said:
            service.clock.tick(ticks)
            try:
                await do(session, *actions)
            except NothingToUndo:
                continue
        await service.manager.close()

        again = await Service(service.store).manager.get(session.id)
        assert again.run == session.run
        assert again.run.world.digest() == session.run.world.digest()
        assert (again.sequence, again.paused) == (session.sequence, True)
        assert again.undo_stack.done == session.undo_stack.done
        assert again.log.latest(400) == session.log.latest(400)

    asyncio.run(talk())


@given(said=st.lists(UTTERANCES, max_size=6))
def test_undoing_everything_is_the_road_nobody_touched(said: list[list[dict[str, object]]]) -> None:
    async def talk() -> None:
        service = Service()
        session = await service.session()
        for actions in said:
            service.clock.tick(2)
            try:
                await do(session, *actions)
            except NothingToUndo:
                continue
        while session.undo_stack.done:
            await do(session, UNDO)
        assert list(session.timeline.entries) == []
        untouched = await Service().session()
        await do(untouched, {"do": "step", "ticks": session.timeline.tick}) if session.timeline.tick else None
        assert session.run.world.digest() == untouched.run.world.digest()

    asyncio.run(talk())
