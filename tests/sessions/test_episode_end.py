"""The end of an episode in the log: the same line live, worded beside the clock or not, and replayed."""

from __future__ import annotations

import asyncio
from dataclasses import replace

import pytest

from service import actions as contract
from service.narration import Narrator
from service.sessions.manager import SessionManager
from service.sessions.persistence.replay import replay
from service.sessions.scheduler.background_task import BackgroundTask
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.utterance import Utterance
from service.settings import Settings
from service.store import MemoryStore
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Outcome
from tests.support.fakes import HandClock

WORDS = Narrator.load()
BLOCKED = Config(
    seed=4, rows=6, columns=4, barriers=14, vehicles=0, potholes=0, planner="priority", repetition=False
)


def lines(session: Session) -> list[tuple[int, str, str]]:
    """The lines that a replay writes as well."""
    return [(line.tick, line.type, line.text) for line in session.log.durable_lines()[1]]


async def begun(config: Config) -> tuple[Session, HandClock, MemoryStore]:
    clock, store = HandClock(), MemoryStore()
    manager = SessionManager(SessionServices(store, clock, WORDS, Settings()))
    return await manager.create(None, config, paused=False), clock, store


async def test_a_line_that_takes_long_comes_before_all_that_follows() -> None:
    session, clock, _ = await begun(BLOCKED)
    while session.run.world.outcome is Outcome.RUNNING:
        clock.tick()
    assert session.run.world.outcome is Outcome.STUCK
    tick = session.timeline.tick
    await session.change(Utterance(actions=contract.load([{"do": "pause"}])))
    told = lines(session)
    assert [kind for at, kind, _ in told if at == tick] == ["stuck", "changed"]
    assert told[-2][2].startswith("Stuck: not arrived after 61 ticks; ")


async def test_it_is_told_without_anything_following() -> None:
    session, clock, _ = await begun(BLOCKED)
    subscriber = session.subscribers.subscribe()
    while session.run.world.outcome is Outcome.RUNNING:
        clock.tick()
        clock_told = await subscriber.next()
    assert clock_told is not None
    heard = await asyncio.wait_for(subscriber.next(), 60)
    assert isinstance(heard, list)
    assert b"Stuck: not arrived" in heard[-1].data


@pytest.mark.parametrize(
    "config", [BLOCKED, replace(BLOCKED, repetition=True), Config(seed=1), Config(seed=1, rows=80)]
)
async def test_a_replay_writes_the_same_lines(config: Config) -> None:
    session, clock, store = await begun(config)
    for _ in range(200):
        clock.tick()
    await session.change(Utterance(actions=contract.load([{"do": "step", "ticks": 30}])))
    services = SessionServices(store, clock, WORDS, Settings())
    replayed = Session(session.record, Timeline(config), services)
    replay(replayed, WORDS, list(await store.entries(session.id)), session.timeline.tick)
    assert lines(replayed) == lines(session)
    assert any(text.startswith(("Reached", "Crash", "Stuck")) for _, _, text in lines(replayed))


async def test_work_beside_is_taken_once_and_in_its_place() -> None:
    taken: list[int] = []
    later: BackgroundTask[int] = BackgroundTask(taken.append)
    later.start(lambda: 1)
    later.start(lambda: 2)
    assert taken == [1]
    later.finish()
    later.finish()
    await asyncio.sleep(0)
    assert taken == [1, 2]
