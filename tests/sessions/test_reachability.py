"""A road without a way is told of when it is made: log, reply, stream; and when a change opens it."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from service import actions as contract
from service.narration import Narrator
from service.sessions.manager import SessionManager
from service.sessions.persistence.replay import replay
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.utterance import Outcome, Utterance
from service.settings import Settings
from service.store import MemoryStore
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Outcome as End
from tests.support.fakes import HandClock
from tests.support.service import Service

WORDS = Narrator.load()
EMPTY = Config(rows=6, columns=3, vehicles=0, potholes=0, planner="priority", seed=4)
CLOSED = Config(rows=6, columns=4, barriers=16, vehicles=0, potholes=0, seed=1, planner="priority")
"""Every cell between start and goal is a barrier."""


def wall(*columns: int, row: int = 2) -> list[dict[str, Any]]:
    return [
        {"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, row]}} for column in columns
    ]


async def begun(config: Config, *, paused: bool = True) -> tuple[Session, HandClock, MemoryStore]:
    clock, store = HandClock(), MemoryStore()
    manager = SessionManager(SessionServices(store, clock, WORDS, Settings()))
    return await manager.create(None, config, paused=paused), clock, store


async def do(session: Session, *actions: dict[str, Any], dry_run: bool = False) -> Outcome:
    return await session.change(Utterance(actions=contract.load(list(actions))), dry_run=dry_run)


def notices(session: Session) -> list[tuple[int, str, str]]:
    lines = session.log.latest(100)
    return [(line.tick, line.type, line.text) for line in lines if line.type in ("no_way", "way_open")]


async def test_a_wall_is_told_of_in_the_reply_and_the_log_and_so_is_its_opening() -> None:
    session, _, _ = await begun(EMPTY)
    assert notices(session) == []
    first = await do(session, *wall(0, 1))
    assert "There is" not in first.reply
    closed = await do(session, *wall(2))
    sentence = closed.reply.removeprefix(f"{closed.done} ")
    assert sentence.startswith("There is no way through: remove the barrier ")
    assert sentence.endswith(" and there is one.")
    assert closed.reply == f"{closed.done} {sentence}"
    assert notices(session) == [(0, "no_way", sentence)]
    assert session.log.latest(1)[0].ids == ("barrier-1",)
    more = await do(session, *wall(0, row=3))
    assert more.reply == more.done
    opened = await do(session, {"do": "remove", "kind": "barrier", "count": 1, "where": {"id": "barrier-1"}})
    assert opened.reply.endswith("There is a way through again.")
    undone = await do(session, {"do": "undo"})
    assert undone.reply.endswith(sentence)
    assert [kind for _, kind, _ in notices(session)] == ["no_way", "way_open", "no_way"]


async def test_a_trial_says_so_and_leaves_nothing_behind() -> None:
    session, _, _ = await begun(EMPTY)
    tried = await do(session, *wall(0, 1, 2), dry_run=True)
    assert "There is no way through: remove" in tried.reply
    assert notices(session) == []
    assert (await do(session, *wall(0, 1, 2))).notice is not None


async def test_a_question_is_answered_without_it() -> None:
    session, _, _ = await begun(CLOSED)
    asked = await do(session, {"do": "ask", "about": "status"})
    assert "no way" not in asked.reply


async def test_a_closed_road_is_told_of_when_it_is_made_and_when_it_begins_again() -> None:
    session, clock, _ = await begun(CLOSED, paused=False)
    ((tick, kind, text),) = notices(session)
    assert (tick, kind) == (0, "no_way")
    assert text.startswith("There is no way through: remove the barrier ")
    clock.tick()
    again = await do(session, {"do": "reset"})
    text = notices(session)[-1][2]
    assert again.reply == f"Back at the start of this road. {text}"
    subscriber = session.subscribers.subscribe()
    while session.run.world.episode == 1:
        clock.tick()
    await session.reachability.wait_until_idle()
    begins = session.run.world.episode_start
    assert [(at, kind) for at, kind, _ in notices(session)] == [
        (0, "no_way"),
        (1, "no_way"),
        (begins, "no_way"),
    ]
    heard: list[Any] = []
    while not heard or heard[-1]["type"] != "changed":
        told = await asyncio.wait_for(subscriber.next(), 60)
        assert isinstance(told, list)
        heard += [json.loads(each.data) for each in told]
    assert heard[-1]["reply"] == heard[-1]["events"][0]["text"]
    assert heard[-1]["events"][0]["type"] == "no_way"


async def test_what_is_found_out_too_late_is_not_told() -> None:
    session, clock, _ = await begun(CLOSED, paused=False)
    while session.run.world.outcome is End.RUNNING:
        clock.tick()
    while session.run.world.outcome is not End.RUNNING:
        clock.tick()  # the next road begins, and is looked at beside
    await do(session, {"do": "scenario", "barriers": 0, "vehicles": 0, "potholes": 0})
    await session.reachability.wait_until_idle()
    assert [tick for tick, _, _ in notices(session)] == [0]


async def test_a_replay_has_all_lines_but_these() -> None:
    session, clock, store = await begun(EMPTY)
    await do(session, *wall(0, 1, 2))
    await do(session, {"do": "step", "ticks": 3})
    assert notices(session)
    replayed = Session(session.record, Timeline(EMPTY), SessionServices(store, clock, WORDS, Settings()))
    replay(replayed, WORDS, list(await store.entries(session.id)), session.timeline.tick)
    assert notices(replayed) == []
    number, kept = session.log.durable_lines()
    assert (number, [line.text for line in kept]) == (
        replayed.log.last_number,
        [line.text for line in replayed.log.latest(100)],
    )


async def test_the_interface_says_so(service: Service) -> None:
    path = await service.session(config={"rows": 6, "columns": 3, "vehicles": 0, "potholes": 0})
    answer = (await service.act(path, *wall(0, 1, 2))).json()
    assert "There is no way through: remove the barrier " in answer["reply"]
    log = (await service.client.get(f"{path}/events")).json()["items"]
    assert [(line["type"], line["ids"]) for line in log][-1] == ("no_way", ["barrier-1"])


async def test_a_new_session_has_it_in_its_log(service: Service) -> None:
    path = await service.session(
        config={"rows": 6, "columns": 4, "barriers": 16, "vehicles": 0, "potholes": 0}
    )
    log = (await service.client.get(f"{path}/events")).json()["items"]
    assert [line["type"] for line in log] == ["no_way"]
