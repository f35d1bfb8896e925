"""Playback speed: how fast the clock ticks a session, and that no world knows of it."""

from __future__ import annotations

import math
from collections.abc import AsyncIterator, Iterator
from typing import Any

import httpx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.actions import load
from service.app import create_app
from service.refusals import refusals
from service.sessions.scheduler.clock import SLOT_S
from service.sessions.scheduler.playback_speed import (
    FASTEST,
    MAX,
    MAX_TURN_S,
    MAX_TURN_TICKS,
    SLOWEST,
    PlaybackSpeed,
    PlaybackSpeedError,
    change_playback_speed,
    is_accelerated,
    period_s,
    ticks_of_turn,
)
from service.sessions.scheduler.wheel_clock import WheelClock
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import HandClock
from tests.support.service import Service

SET = {"do": "set", "parameter": "playback_speed"}
ADJUST = {"do": "adjust", "parameter": "playback_speed"}


def after(pace: PlaybackSpeed, **action: object) -> PlaybackSpeed:
    (loaded,) = load([{**(SET if "value" in action else ADJUST), **action}])
    return change_playback_speed(pace, loaded)  # type: ignore[arg-type]


@pytest.fixture
async def talking(settings: Settings) -> AsyncIterator[Service]:
    """The service with the real language."""
    clock, store = HandClock(), MemoryStore()
    app = create_app(settings, store=store, clock=clock)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Service(app, client, clock, store)


@pytest.mark.parametrize(
    ("before", "action", "then"),
    [
        (1.0, {"value": 4}, 4.0),
        (1.0, {"value": "max"}, MAX),
        (1.0, {"value": 0.25}, 0.25),
        (MAX, {"value": 1}, 1.0),
        (1.0, {"factor": 2}, 2.0),
        (3.0, {"by": -1}, 2.0),
        (1.0, {"direction": "up"}, 2.0),
        (1.0, {"direction": "down"}, 0.5),
        (48.0, {"direction": "up"}, 64.0),
        (64.0, {"direction": "up"}, MAX),
        (MAX, {"direction": "down"}, 64.0),
        (MAX, {"factor": 0.5}, 32.0),
    ],
)
def test_what_a_change_comes_to(before: PlaybackSpeed, action: dict[str, Any], then: PlaybackSpeed) -> None:
    assert after(before, **action) == then


@pytest.mark.parametrize(
    ("before", "action", "told"),
    [
        (1.0, {"value": 65}, "from 0.25 to 64"),
        (1.0, {"value": 0.2}, "from 0.25 to 64"),
        (1.0, {"value": "fast"}, "not 'fast'"),
        (1.0, {"value": math.nan}, "from 0.25 to 64"),
        (40.0, {"factor": 2}, "this would be 80"),
        (1.0, {"by": -2}, "this would be -1"),
        (0.25, {"direction": "down"}, "at its limit already: 0.25×"),
        (MAX, {"direction": "up"}, "as fast as possible already"),
        (MAX, {"factor": 2}, "as fast as possible already"),
    ],
)
def test_what_cannot_be(before: PlaybackSpeed, action: dict[str, Any], told: str) -> None:
    with pytest.raises(PlaybackSpeedError) as refused:
        after(before, **action)
    assert told in refusals().playback_speed(refused.value.code, refused.value.facts)


@given(pace=st.floats(SLOWEST, FASTEST), step_seconds=st.floats(0.05, 5.0))
def test_a_turn_takes_as_many_ticks_as_its_time_is_long(pace: float, step_seconds: float) -> None:
    ticks, period = len(list(ticks_of_turn(pace, step_seconds))), period_s(pace, step_seconds)
    assert ticks / period == pytest.approx(pace / step_seconds), "the speed is kept"
    assert period > 1.5 * SLOT_S, "turns fall into different slots of the clock"
    assert ticks == 1 or period <= 2 * 0.004, "no more at once than need be"


def test_as_fast_as_possible_ends_its_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr("service.sessions.scheduler.playback_speed.time.monotonic", lambda: now[0])
    assert len(list(ticks_of_turn(MAX, 0.5))) == MAX_TURN_TICKS
    slow = 0
    for _ in ticks_of_turn(MAX, 0.5):
        slow += 1
        now[0] += MAX_TURN_S * 0.6
    assert slow == 2


def test_who_plays_as_fast_as_possible_leaves_time_to_the_others() -> None:
    now = [100.0]

    class Greedy:
        ticks = 0
        period_s = period_s(MAX, 0.5)

        def tick(self) -> None:
            self.ticks += 1
            now[0] += MAX_TURN_S

        def tick_failed(self, error: Exception) -> None:
            raise error

    class Calm(Greedy):
        period_s = 0.5

        def tick(self) -> None:
            self.ticks += 1

    clock = WheelClock(lambda: now[0])
    greedy, calm = [Greedy() for _ in range(20)], [Calm() for _ in range(20)]
    for ticker in (*greedy, *calm):
        clock.add(ticker)
    while now[0] < 110.0:
        now[0] += 0.0005  # between two turns of the loop
        clock.serve()
    assert all(19 <= each.ticks <= 20 for each in calm)
    counts = [each.ticks for each in greedy]
    assert min(counts) > 0.9 * max(counts) > 100, "and they share alike"


def test_only_more_than_real_time_is_a_hurry() -> None:
    assert [is_accelerated(pace) for pace in (0.25, 1.0, 1.5, MAX)] == [False, False, True, True]


async def test_it_is_told_changed_and_a_step_of_undo(service: Service) -> None:
    path = await service.session()
    (ticker,) = service.clock.tickers
    assert ticker.period_s == 0.5
    before = await service.state(path)
    assert before["playback_speed"] == 1.0
    answer = await service.act(path, {**SET, "value": 4})
    assert answer.json()["reply"] == "The playback speed: 1× → 4×."
    assert answer.json()["changes"] == [{"path": "playback_speed", "before": 1.0, "after": 4.0}]
    assert ticker.period_s == 0.125
    look = (await service.client.get(path)).json()
    assert look["playback_speed"] == 4.0
    state = await service.state(path)
    assert (state["digest"], state["playback_speed"]) == (before["digest"], 4.0)
    undone = (await service.act(path, {"do": "undo"})).json()
    assert undone["changes"] == [{"path": "playback_speed", "before": 4.0, "after": 1.0}]
    assert undone["reply"] == "Taken back. The playback speed: 4× → 1×."
    assert ticker.period_s == 0.5
    assert (await service.act(path, {"do": "redo"})).json()["changes"] == answer.json()["changes"]
    again = await service.act(path, {**SET, "value": 4})
    assert again.json()["reply"] == "The playback speed is 4× already."


async def test_undoing_a_change_and_the_speed_together_gives_both_back(service: Service) -> None:
    path = await service.session()
    await service.act(path, {"do": "add", "kind": "pothole", "count": 1}, {**SET, "value": "max"})
    await service.act(path, {"do": "undo"})
    assert (await service.state(path))["playback_speed"] == 1.0
    await service.act(path, {"do": "redo"})
    assert (await service.state(path))["playback_speed"] == "max"


async def test_undoing_a_change_of_the_world_leaves_a_speed_set_before(service: Service) -> None:
    path = await service.session()
    await service.act(path, {**SET, "value": 4})
    await service.act(path, {"do": "add", "kind": "pothole", "count": 1})
    await service.act(path, {"do": "undo"})
    assert (await service.state(path))["playback_speed"] == 4.0


async def test_a_refused_speed_changes_nothing(service: Service) -> None:
    path = await service.session()
    before = await service.state(path)
    answer = await service.act(path, {"do": "add", "kind": "pothole", "count": 1}, {**SET, "value": 100})
    assert answer.status_code == 422
    assert answer.json()["errors"] == [{
        "field": "actions.1.value",
        "message": "The playback speed goes from 0.25 to 64, or is 'max' for as fast as possible; "
        "this would be 100.",
    }]  # fmt: skip
    assert await service.state(path) == before


async def test_the_same_ticks_at_any_speed(service: Service) -> None:
    digests = set()
    for value in (1, 64, "max"):
        path = await service.session()
        await service.act(path, {**SET, "value": value})
        while (await service.state(path))["tick"] < 96:  # type: ignore[operator]
            service.clock.tick()
        await service.act(path, {"do": "pause"})
        tick = (await service.state(path))["tick"]
        await service.act(path, {"do": "step", "ticks": 200 - tick})  # type: ignore[operator]
        digests.add((await service.state(path))["digest"])
    assert len(digests) == 1


async def test_it_comes_back_after_a_restart_and_in_a_recording(service: Service) -> None:
    path = await service.session()
    await service.act(path, {**SET, "value": 8})
    recording = (await service.client.get(f"{path}/recording")).json()
    copy = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert copy.json()["playback_speed"] == 8.0
    app = create_app(Settings(database="memory:"), store=service.store, clock=HandClock())
    async with httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client:
        assert (await client.get(path)).json()["playback_speed"] == 8.0


def sentences() -> Iterator[Any]:
    yield pytest.param("set playback to 4x", 4.0)
    yield pytest.param("make the simulation faster", 2.0)
    yield pytest.param("double the playback speed", 2.0)
    yield pytest.param("in real time", 1.0)


@pytest.mark.parametrize(("text", "speed"), list(sentences()))
async def test_it_can_be_said(talking: Service, text: str, speed: float) -> None:
    path = await talking.session()
    answer = await talking.say(path, text)
    assert answer.status_code == 200, answer.text
    assert (await talking.state(path))["playback_speed"] == speed


async def test_twice_as_fast_asks_what_and_the_first_choice_is_the_playback(talking: Service) -> None:
    path = await talking.session()
    asked = await talking.say(path, "twice as fast")
    assert asked.status_code == 409
    chosen = await talking.say(path, asked.json()["choices"][0]["text"])
    assert chosen.json()["reply"] == "The playback speed: 1× → 2×."


async def test_what_if_it_were_faster_is_about_the_road_only(talking: Service) -> None:
    path = await talking.session()
    asked = await talking.act(path, {"do": "ask", "about": "what_if", "change": [{**SET, "value": 4}]})
    assert asked.status_code == 200
    assert "cannot" not in asked.json()["reply"]
    assert (await talking.state(path))["playback_speed"] == 1.0
