"""Pictures by stream: one drawing for all who watch the same, the newest only, none when nothing moves."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from io import BytesIO
from typing import Any

import orjson
import pytest
import websockets
from anyio import CapacityLimiter
from PIL import Image
from websockets.asyncio.client import ClientConnection

from service.app import create_app
from service.http.realtime.frame_stream import FORMS, HEADER, MAGIC, VERSION, Reel, Reels, Slot, Wanted
from service.sessions.session import Session
from service.settings import Settings
from service.store import MemoryStore
from sim.config import Config
from sim.render import Look
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import running

ROAD = Wanted("road", "jpeg", 96)


@pytest.fixture
async def session() -> Session:
    app = create_app(
        Settings(database="memory:"), store=MemoryStore(), language=FewSentences(), clock=HandClock()
    )
    return await app.state.context.manager.create(None, Config(seed=3, potholes=9), paused=False)


def read(message: bytes) -> tuple[int, float, Image.Image]:
    """Tick, phase and picture."""
    magic, version, form, phase, tick = HEADER.unpack_from(message)
    assert (magic, version) == (MAGIC, VERSION)
    picture = Image.open(BytesIO(message[HEADER.size :]))
    assert (picture.format or "").lower() == next(name for name, number in FORMS.items() if number == form)
    return tick, phase, picture


def test_the_header_is_as_documented() -> None:
    assert HEADER.size == 16
    assert HEADER.pack(MAGIC, 1, 2, 0.5, 258) == b"RT\x01\x02" + b"\x3f\x00\x00\x00" + bytes(6) + b"\x01\x02"


async def test_a_slot_holds_the_newest_only() -> None:
    slot = Slot(30)
    slot.put(b"old")
    slot.put(b"new")
    assert await slot.next() == b"new"
    waiting = asyncio.ensure_future(slot.next())
    await asyncio.sleep(0)
    assert not waiting.done()
    slot.put(b"newer")
    assert await waiting == b"newer"


async def test_it_glides_from_tick_to_tick_and_then_rests(session: Session) -> None:
    reel, slot = Reel(session, ROAD, CapacityLimiter(1)), Slot(30)
    reel._slots.add(slot)
    await reel.draw_now(10.0)
    tick, phase, picture = read(await slot.next())
    assert (tick, phase, max(picture.size) <= 96) == (0, 1.0, True)
    session.tick()
    seen = []
    for at_s in (11.0, 11.125, 11.25, 11.6, 11.7, 12.0):
        await reel.draw_now(at_s)
        if slot._newest is not None:
            tick, phase, _ = read(await slot.next())
            seen.append((tick, phase))
    assert seen == [(1, 0.0), (1, 0.25), (1, 0.5), (1, 1.0)]
    assert reel.drawn == 5, "nothing is drawn where nothing moves"


async def test_a_change_is_drawn_and_going_back_is_a_cut(session: Session) -> None:
    reel, slot = Reel(session, ROAD, CapacityLimiter(1)), Slot(30)
    reel._slots.add(slot)
    for _ in range(3):
        session.tick()
    await reel.draw_now(1.0)
    session.timeline.state = session.timeline.at(1)
    await reel.draw_now(1.1)
    assert read(await slot.next())[:2] == (1, 1.0)


async def test_the_next_move_is_drawn_once_the_clock_stands(session: Session) -> None:
    pictures = []
    for path in (True, False):
        session.set_paused(False)
        look = Look(figures=False, path=path)
        reel, slot = Reel(session, Wanted("road", "webp", 240, look), CapacityLimiter(1)), Slot(30)
        reel._slots.add(slot)
        await reel.draw_now(1.0)
        await slot.next()
        session.set_paused(True)
        await reel.draw_now(1.1)
        pictures.append(read(await slot.next())[2].convert("RGB").tobytes())
        await reel.draw_now(1.2)
        assert slot._newest is None, "nothing is drawn where nothing changes"
    assert pictures[0] != pictures[1]


async def test_the_way_behind_is_that_which_was_seen(session: Session) -> None:
    reel = Reel(session, ROAD, CapacityLimiter(1))
    reel._slots.add(Slot(30))
    cells = []
    for at_s in range(4):
        await reel.draw_now(float(at_s))
        cells.append(session.run.world.road.cell(session.run.world.avs[0]))
        session.tick()
    assert list(reel._trail) == list(dict.fromkeys(cells[:-1]))
    session.timeline.state = session.timeline.at(1)
    await reel.draw_now(9.0)
    assert reel._trail == ()


async def test_as_fast_as_possible_there_is_no_gliding(session: Session) -> None:
    reel, slot = Reel(session, ROAD, CapacityLimiter(1)), Slot(30)
    reel._slots.add(slot)
    await reel.draw_now(1.0)
    session.playback_speed = "max"
    while session.timeline.tick < 2:  # how many ticks a turn has depends on the machine
        session.tick()
    await reel.draw_now(1.1)
    assert read(await slot.next())[:2] == (session.timeline.tick, 1.0)


async def test_all_who_watch_the_same_share_a_drawing(session: Session) -> None:
    reels, drawing = Reels(), CapacityLimiter(1)
    seen: list[list[bytes]] = [[] for _ in range(20)]
    shown = asyncio.Event()

    async def watch(number: int) -> None:
        async def send(data: bytes) -> None:
            seen[number].append(data)
            if all(seen):
                shown.set()

        wanted = ROAD if number % 2 else Wanted("schematic", "webp", 96)
        await reels.stream_to(session, wanted, 60, drawing, send)

    tasks = [asyncio.create_task(watch(number)) for number in range(20)]
    await asyncio.wait_for(shown.wait(), 60)
    assert len(reels) == 2
    assert len({id(pictures[0]) for pictures in seen}) == 2, "encoded once"
    for task in tasks:
        task.cancel()
    await asyncio.wait(tasks)
    assert len(reels) == 0


async def test_a_stalled_watcher_holds_up_nobody(session: Session) -> None:
    reels, drawing, enough = Reels(), CapacityLimiter(1), asyncio.Event()
    stalled: list[bytes] = []
    ticks: list[int] = []

    async def never(data: bytes) -> None:
        stalled.append(data)
        await asyncio.Event().wait()

    async def quick(data: bytes) -> None:
        ticks.append(read(data)[0])
        session.tick()
        if len(ticks) == 12:
            enough.set()

    tasks = [
        asyncio.create_task(reels.stream_to(session, ROAD, 60, drawing, send)) for send in (never, quick)
    ]
    await asyncio.wait_for(enough.wait(), 60)
    assert len(stalled) == 1
    assert ticks == sorted(ticks)
    for task in tasks:
        task.cancel()
    await asyncio.wait(tasks)


@asynccontextmanager
async def watching() -> AsyncIterator[tuple[ClientConnection, Session, Any]]:
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with running(app, settings) as live:
        session = await app.state.context.manager.create(None, Config(seed=3), paused=False)
        async with websockets.connect(f"{live.ws}/api/v1/sessions/{session.id}/stream") as socket:
            assert orjson.loads(await socket.recv())["type"] == "hello"
            yield socket, session, app.state.context


async def say(socket: ClientConnection, **message: Any) -> None:
    await socket.send(orjson.dumps(message).decode())


async def heard(socket: ClientConnection) -> Any:
    data = await asyncio.wait_for(socket.recv(), 60)
    return data if isinstance(data, bytes) else orjson.loads(data)


async def test_over_a_socket() -> None:
    async with watching() as (socket, session, context):
        await say(socket, type="subscribe", frames="webp", view="schematic", fps=60, side=64)
        first = [await heard(socket), await heard(socket)]
        (told,) = [each for each in first if isinstance(each, dict)]
        assert told == {
            "type": "subscribed", "frames": "webp", "view": "schematic", "fps": 60, "side": 64,
            "theme": "dark", "boxes": True, "figures": True, "path": True, "forecast": False,
        }  # fmt: skip
        (picture,) = [each for each in first if isinstance(each, bytes)]
        assert read(picture)[0] == 0
        assert len(context.reels) == 1

        session.tick()
        kinds = []
        while not kinds or not isinstance(kinds[-1], int):
            message = await heard(socket)
            kinds.append(read(message)[0] if isinstance(message, bytes) else message["type"])
        assert kinds == ["tick", 1]

        await say(socket, type="subscribe", frames="jpeg")
        await say(socket, type="unsubscribe")
        while True:
            message = await heard(socket)
            if isinstance(message, dict) and message["type"] == "unsubscribed":
                break
        await say(socket, type="ping")
        assert (await heard(socket))["type"] == "pong"
        assert len(context.reels) == 0


async def test_closing_ends_the_pictures() -> None:
    async with watching() as (socket, session, context):
        await say(socket, type="subscribe", frames="jpeg", side=64)
        await heard(socket)
        await socket.close()
        async with asyncio.timeout(60):
            while session.subscribers or context.reels:  # noqa: ASYNC110 -- nobody tells of it
                await asyncio.sleep(0)


@pytest.mark.parametrize(
    ("message", "field"),
    [
        ({"frames": "png"}, "frames"),
        ({}, "frames"),
        ({"frames": "jpeg", "fps": 61}, "fps"),
        ({"frames": "jpeg", "view": "radar"}, "view"),
        ({"frames": "jpeg", "side": 10}, "side"),
        ({"frames": "jpeg", "surprise": 1}, "surprise"),
    ],
)
async def test_what_cannot_be_shown(message: dict[str, Any], field: str) -> None:
    async with watching() as (socket, _, context):
        await say(socket, type="subscribe", **message)
        answer = await heard(socket)
        assert answer["type"] == "error"
        assert answer["problem"]["errors"][0]["field"] == field
        assert len(context.reels) == 0
