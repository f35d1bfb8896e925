"""How time stands in a session, how it ends, and how it comes back."""

from __future__ import annotations

import asyncio

import pytest

from service import actions as contract
from service.problems import (
    Invalid,
    RecordingMismatch,
    TooManySessions,
    UnknownSession,
)
from service.sessions.persistence.recording import Recording
from service.sessions.utterance import Utterance
from service.store import EntryRecord
from tests.support.sessions import (
    ADD,
    ADD_CARS,
    CONFIG,
    PAUSE,
    RESUME,
    UNDO,
    Service,
    do,
    recorded,
)

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
    assert turns > 3, "in its way there would be one, or two"
    untouched = await Service(max_step_ticks=10_000).session()
    for _ in range(2):
        await do(untouched, {"do": "step", "ticks": 10_000})
    assert session.run.world.digest() == untouched.run.world.digest()


async def test_a_failed_tick_pauses_and_tells() -> None:
    session = await Service().session()
    subscriber = session.subscribers.subscribe()
    session.tick_failed(RuntimeError("boom"))
    assert session.paused
    heard = await subscriber.next()
    assert isinstance(heard, list)
    assert b"defect" in heard[0].data
    assert b"boom" not in heard[0].data
    assert session.log.latest(1)[0].type == "failed"


# Finding, ending, replaying


async def test_a_session_that_ended_is_gone_for_changes_under_way() -> None:
    service = Service()
    session = await service.session()
    subscriber = session.subscribers.subscribe()
    await service.manager.delete(session.id)
    with pytest.raises(UnknownSession):
        await do(session, ADD)
    with pytest.raises(UnknownSession):
        await service.manager.get(session.id)
    with pytest.raises(UnknownSession):
        await service.manager.delete(session.id)
    assert service.clock.tickers == []
    assert type(await subscriber.next()).__name__ == "SessionDeleted"


async def test_all_who_ask_for_a_sleeping_session_get_the_same() -> None:
    service = Service()
    session = await service.session()
    await service.manager.close()
    manager = Service(service.store).manager
    found = await asyncio.gather(*(manager.get(session.id) for _ in range(5)))
    assert len({id(each) for each in found}) == 1
    assert manager.live_count == 1


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


async def test_a_full_service_lets_paused_sessions_leave_the_longest_idle_first() -> None:
    service = Service(max_sessions=3)
    running = await service.session()
    first, second = await service.session(paused=True), await service.session(paused=True)
    await do(first, ADD)
    expected = first.run
    await service.manager.get(first.id)  # now `second` is idle longest
    third = await service.session(paused=True)
    assert set(service.manager.live_sessions) == {running.id, first.id, third.id}
    assert (await service.manager.get(second.id)).id == second.id  # and `first` has left for it
    assert first.id not in service.manager.live_sessions
    assert (await service.manager.get(first.id)).run == expected
    assert service.manager.live_count == 3
    assert running.id in service.manager.live_sessions


async def test_a_watched_session_does_not_leave_a_full_service() -> None:
    service = Service(max_sessions=1)
    watched = await service.session(paused=True)
    subscriber = watched.subscribers.subscribe()
    with pytest.raises(TooManySessions) as refused:
        await service.session()
    watched.subscribers.unsubscribe(subscriber)
    assert 1 <= int(refused.value.headers["Retry-After"]) <= 600
    await service.session()


async def test_a_running_session_leaves_a_full_service_when_nobody_has_asked_for_long() -> None:
    service = Service(max_sessions=1, sleep_after_s=60.0)
    now_s = 1_000.0
    service.manager.idle_times.now = lambda: now_s
    await service.session()
    with pytest.raises(TooManySessions) as refused:
        await service.session()
    assert refused.value.headers["Retry-After"] == "60"
    now_s += 60
    await service.session()


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
    other = Recording(entries=[], tick=good.tick, digest=good.digest)
    with pytest.raises(RecordingMismatch):
        await service.manager.create(None, CONFIG, paused=True, recorded=other)
    undone = EntryRecord(sequence=1, tick=0, text=None, actions=[{"do": "undo"}])
    with pytest.raises(Invalid) as raised:
        await service.manager.create(
            None, CONFIG, paused=True, recorded=Recording(entries=[undone], tick=0, digest=good.digest)
        )
    assert raised.value.errors[0].field == "recording.entries.0"
    assert service.manager.live_count == 1
