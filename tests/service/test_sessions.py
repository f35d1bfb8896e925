"""A change is all or nothing, stored before it is told, taken back as one; and how time stands."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service import actions as contract
from service.narrate import Narrator
from service.problems import (
    DoesNotFit,
    Invalid,
    NotAvailable,
    NothingToUndo,
    NotSaved,
    ProblemError,
    RecordingMismatch,
    TooManySessions,
    UnknownSession,
)
from service.sessions.manager import Recorded, SessionManager
from service.sessions.recording import recording_json
from service.sessions.session import Session, Surroundings
from service.sessions.utterance import Utterance
from service.settings import Settings
from service.store import EntryRecord, KeptAnswer, MemoryStore, StoreError
from sim.config import Config
from sim.kinds import Kind
from tests.service.fakes import HandClock

WORDS = Narrator.load()
CONFIG = Config(seed=11, potholes=4, vehicles=6)

ADD = {"do": "add", "kind": "pothole", "count": 1}
ADD_CARS = {"do": "add", "kind": "vehicle", "count": 2}
PAUSE, RESUME, UNDO, REDO = ({"do": word} for word in ("pause", "resume", "undo", "redo"))


class Service:
    """Sessions with everything around them, in one object."""

    def __init__(self, store: MemoryStore | None = None, **settings: int) -> None:
        self.store = store or MemoryStore()
        self.clock = HandClock()
        around = Surroundings(self.store, self.clock, WORDS, Settings(**settings))
        self.manager = SessionManager(around)

    async def session(self, config: Config = CONFIG, *, paused: bool = False) -> Session:
        return await self.manager.create(None, config, paused=paused)


async def do(session: Session, *actions: dict[str, object], dry_run: bool = False) -> str:
    utterance = Utterance(actions=contract.load(list(actions)))
    return (await session.change(utterance, dry_run=dry_run)).reply


def potholes(session: Session) -> int:
    return session.run.world.count(Kind.POTHOLE)


def fingerprint(session: Session) -> tuple[object, ...]:
    return (session.run, session.paused, session.sequence, session.log.last, list(session.timeline.entries))


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
    assert "4 → 5" in await do(session, ADD, dry_run=True)
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
    watcher = session.watchers.join()
    task = asyncio.create_task(do(session, ADD))
    await asyncio.wait_for(store.asked.wait(), 60)

    service.clock.tick()
    assert (session.timeline.tick, potholes(session), session.sequence) == (0, 4, 0), (
        "time waits for the store"
    )
    hearing = asyncio.create_task(watcher.next())
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
        async def append(self, session_id: str, entry: EntryRecord, *answer: KeptAnswer | None) -> None:
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
        assert again.history.done == session.history.done
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
        while session.history.done:
            await do(session, UNDO)
        assert list(session.timeline.entries) == []
        untouched = await Service().session()
        await do(untouched, {"do": "step", "ticks": session.timeline.tick}) if session.timeline.tick else None
        assert session.run.world.digest() == untouched.run.world.digest()

    asyncio.run(talk())


# Time


async def test_only_running_sessions_tick() -> None:
    service = Service()
    runs, stands = await service.session(), await service.session(paused=True)
    service.clock.tick(4)
    assert (runs.timeline.tick, stands.timeline.tick) == (4, 0)
    await do(runs, PAUSE)
    await do(stands, RESUME)
    service.clock.tick()
    assert (runs.timeline.tick, stands.timeline.tick) == (4, 1)


async def test_a_step_pauses_and_may_be_long() -> None:
    service = Service()
    session = await service.session()
    outcome = await session.change(Utterance(actions=contract.load([{"do": "step", "ticks": 900}])))
    assert session.paused
    assert (session.timeline.tick, len(outcome.ticks)) == (900, 900)
    service.clock.tick()
    assert session.timeline.tick == 900


async def test_an_undo_of_long_ago_leaves_the_loop_free() -> None:
    """What was said 20,000 ticks ago is taken out of the past beside the loop, not in its way."""
    service = Service(max_step_ticks=10_000)
    session = await service.session()
    await do(session, ADD)
    for _ in range(2):
        await do(session, {"do": "step", "ticks": 10_000})
    undoing = asyncio.create_task(do(session, UNDO))
    turns = 0
    while not undoing.done():
        await asyncio.sleep(0.001)
        turns += 1
    await undoing
    assert turns > 20
    untouched = await Service(max_step_ticks=10_000).session()
    for _ in range(2):
        await do(untouched, {"do": "step", "ticks": 10_000})
    assert session.run.world.digest() == untouched.run.world.digest()


async def test_a_failed_tick_pauses_and_tells() -> None:
    session = await Service().session()
    watcher = session.watchers.join()
    session.tick_failed(RuntimeError("boom"))
    assert session.paused
    heard = await watcher.next()
    assert isinstance(heard, list)
    assert b"defect" in heard[0].data
    assert b"boom" not in heard[0].data
    assert session.log.latest(1)[0].type == "failed"


# Finding, ending, replaying


async def test_a_session_that_ended_is_gone_for_changes_under_way() -> None:
    service = Service()
    session = await service.session()
    watcher = session.watchers.join()
    await service.manager.delete(session.id)
    with pytest.raises(UnknownSession):
        await do(session, ADD)
    with pytest.raises(UnknownSession):
        await service.manager.get(session.id)
    with pytest.raises(UnknownSession):
        await service.manager.delete(session.id)
    assert service.clock.tickers == []
    assert type(await watcher.next()).__name__ == "Gone"


async def test_all_who_ask_for_a_sleeping_session_get_the_same() -> None:
    service = Service()
    session = await service.session()
    await service.manager.close()
    manager = Service(service.store).manager
    found = await asyncio.gather(*(manager.get(session.id) for _ in range(5)))
    assert len({id(each) for each in found}) == 1
    assert manager.live == 1


async def test_after_a_crash_it_stands_at_its_last_change() -> None:
    """Nothing was told to the store at the end: what was acknowledged is there all the same."""
    service = Service()
    session = await service.session()
    service.clock.tick(5)
    await do(session, ADD)
    expected = session.run
    service.clock.tick(7)
    again = await Service(service.store).manager.get(session.id)
    assert again.run == expected


async def test_the_limit_of_sessions() -> None:
    service = Service(max_sessions=2)
    first = await service.session()
    await service.session()
    with pytest.raises(TooManySessions):
        await service.session()
    await service.manager.delete(first.id)
    await service.session()


async def recorded(session: Session, service: Service) -> Recorded:
    recording = recording_json(session, await service.manager.entries(session))
    entries = [EntryRecord(**each) for each in recording["entries"]]
    return Recorded(entries=entries, tick=recording["tick"], digest=recording["digest"])


async def test_a_recording_replays_and_goes_on_alike() -> None:
    service = Service()
    session = await service.session()
    for actions in ([ADD], [PAUSE, ADD_CARS, RESUME], [UNDO], [{"do": "scenario", "road": "city"}]):
        service.clock.tick(13)
        await do(session, *actions)
    service.clock.tick(9)
    copy = await service.manager.create(None, CONFIG, paused=False, recorded=await recorded(session, service))
    assert copy.run == session.run
    service.clock.tick(50)
    assert copy.run.world.digest() == session.run.world.digest()


async def test_a_recording_that_was_tampered_with_is_refused() -> None:
    service = Service()
    session = await service.session()
    await do(session, ADD)
    good = await recorded(session, service)
    other = Recorded(entries=[], tick=good.tick, digest=good.digest)
    with pytest.raises(RecordingMismatch):
        await service.manager.create(None, CONFIG, paused=True, recorded=other)
    undone = EntryRecord(sequence=1, tick=0, text=None, actions=[{"do": "undo"}])
    with pytest.raises(Invalid) as raised:
        await service.manager.create(
            None, CONFIG, paused=True, recorded=Recorded(entries=[undone], tick=0, digest=good.digest)
        )
    assert raised.value.errors[0].field == "recording.entries.0"
    assert service.manager.live == 1
