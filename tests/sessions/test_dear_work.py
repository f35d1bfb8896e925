"""Dear work of sessions: done in a worker process it leads to the same session, and it is all or nothing."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from typing import Any

import pytest

from service.actions import Step
from service.problems import Invalid, Stopped, TooMuchWork
from service.sessions.session import Session
from service.sessions.utterance import Utterance
from service.sessions.work_estimate import log_units
from service.store import EntryRecord, MemoryStore
from service.work.asker import CURRENT_ASKER, Asker
from service.work.units import config_tick_units
from service.work.worker import Worker
from sim.config import Config
from tests.support.session_talk import load, save
from tests.support.sessions import ADD, REDO, UNDO, Service, do, recorded
from tests.support.snapshots import whole

ROAD = Config(seed=5, planner="astar")


@pytest.fixture
def everything_is_dear(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("INLINE", "THREAD"):
        monkeypatch.setattr(f"service.work.executor.{name}", 0)
    for module in ("perform", "manager", "build_fork", "persistence.recording"):
        monkeypatch.setattr(f"service.sessions.{module}.THREAD", 0)


async def talked(service: Service, config: Config = ROAD) -> Session:
    """A session that was stepped, changed, undone and asked."""
    session = await service.session(config, paused=True)
    await do(session, {"do": "step", "ticks": 30}, ADD)
    await do(session, {"do": "step", "ticks": 20})
    await do(session, save("a"))
    await do(session, {"do": "set", "parameter": "rows", "value": 40})
    await do(session, {"do": "step", "ticks": 25}, ADD)
    await do(session, load("a"))
    await do(session, ADD, ADD)
    await do(session, UNDO)
    await do(session, UNDO, REDO)
    await do(session, {"do": "ask", "about": "why"})
    await do(session, {"do": "rewind", "to": 12})
    return session


@pytest.mark.usefixtures("everything_is_dear")
async def test_a_session_is_the_same_wherever_its_work_was_done(monkeypatch: pytest.MonkeyPatch) -> None:
    service = Service()
    elsewhere = await talked(service)
    assert service.manager.work.fates["done"] > 4
    service.manager.work.stop()
    monkeypatch.undo()
    here = await talked(Service())
    assert whole(elsewhere) == whole(here)
    assert elsewhere.run.world.digest() == here.run.world.digest()
    assert elsewhere.latest_decision() == here.latest_decision()


@pytest.mark.usefixtures("everything_is_dear")
async def test_recordings_logs_and_forks_are_replayed_in_a_process(monkeypatch: pytest.MonkeyPatch) -> None:
    store = MemoryStore()
    service = Service(store)
    session = await talked(service)
    recording = await recorded(session, service)
    copy = await service.manager.create(None, ROAD, paused=True, recorded=recording)
    fork = await service.manager.fork(session, None, (Step(ticks=7),))
    await service.manager.close()
    service.manager.work.stop()
    store._snapshots.clear()
    other = Service(store)
    again = await other.manager.get(session.id)
    assert other.manager.work.fates == {"done": 1}
    other.manager.work.stop()
    monkeypatch.undo()
    plain = Service()
    known = await plain.manager.create(None, ROAD, paused=True, recorded=recording)
    assert whole(copy) == whole(known)
    assert whole(again) == whole(await Service(store).manager.get(session.id))
    own = await plain.manager.fork(known, None, (Step(ticks=7),))
    assert (fork.run.world.digest(), fork.timeline.tick) == (own.run.world.digest(), own.timeline.tick)


@pytest.mark.usefixtures("everything_is_dear")
async def test_a_recording_that_is_wrong_is_refused_as_ever() -> None:
    service = Service()
    session = await talked(service)
    recording = await recorded(session, service)
    wrong = replace(recording, tick=recording.tick + 1)
    with pytest.raises(Invalid, match=r"digest|ends"):
        await service.manager.create(None, ROAD, paused=True, recorded=wrong)
    bad = replace(recording.entries[0], actions=[{"do": "fly"}])
    with pytest.raises(Invalid) as refused:
        await service.manager.create(None, ROAD, paused=True, recorded=replace(recording, entries=[bad]))
    assert refused.value.errors[0].field == "recording.entries.0"
    service.manager.work.stop()


@pytest.mark.usefixtures("everything_is_dear")
async def test_a_step_whose_client_has_gone_leaves_the_session_as_it_was(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    service, begun, gone = Service(), asyncio.Event(), asyncio.Event()
    session = await service.session(ROAD, paused=True)
    before = whole(session)

    async def never(_: Worker, packed: bytes) -> bytes:
        assert packed
        begun.set()
        return await asyncio.get_running_loop().create_future()

    monkeypatch.setattr(Worker, "call", never)
    CURRENT_ASKER.set(Asker("client", gone.wait))
    stepping = asyncio.create_task(session.change(Utterance(actions=(Step(ticks=100),))))
    await begun.wait()
    waiting = asyncio.create_task(session.change(Utterance(actions=(Step(ticks=1),))))
    await asyncio.sleep(0)
    assert not waiting.done(), "the session is held"
    gone.set()
    for each in (stepping, waiting):
        with pytest.raises(Stopped):
            await each
    assert whole(session) == before
    assert not session.busy


async def test_too_dear_a_step_is_refused_before_it_begins() -> None:
    service = Service(max_work=1_000_000)
    session = await service.session(Config(seed=1, columns=64, rows=156, planner="astar"), paused=True)
    with pytest.raises(TooMuchWork, match=r"159,747,296 units.*1,000,000.*ROADTALK_MAX_WORK"):
        await session.change(Utterance(actions=(Step(ticks=1_000),)))
    assert session.timeline.tick == 0


def entries(*said: tuple[int, dict[str, Any]]) -> list[EntryRecord]:
    return [
        EntryRecord(sequence=number, tick=tick, text=None, actions=[action])
        for number, (tick, action) in enumerate(said, start=1)
    ]


def test_a_log_costs_its_ticks_and_what_it_undoes() -> None:
    tick = config_tick_units(ROAD)
    assert log_units(ROAD, [], 1_000) == 1_000 * tick
    once = entries((0, ADD), (1_000, UNDO))
    often = entries((0, ADD), *[(1_000, UNDO), (1_000, REDO)] * 50)
    assert log_units(ROAD, once, 1_000) == (1_000 + 1_000 + 2 * 4) * tick
    assert log_units(ROAD, often, 1_000) == (1_000 + 100 * 1_000 + 101 * 4) * tick


def test_a_log_costs_as_much_as_its_dearest_planner_and_largest_road() -> None:
    plain = Config(seed=5)
    searching = entries((0, {"do": "set", "parameter": "planner", "value": "astar"}))
    larger = entries((0, {"do": "set", "parameter": "rows", "value": 300}))
    assert log_units(plain, searching, 1_000) > 10 * log_units(plain, [], 1_000)
    assert log_units(ROAD, larger, 1_000) > 9 * log_units(ROAD, [], 1_000)
    assert log_units(ROAD, entries((0, {"do": 3}), (0, {"do": "undo", "steps": "x"})), 10) > 0
