"""The stream through a real server and a real client."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any

import httpx
import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from service.app import create_app
from service.sessions.subscribers import QUEUE_SIZE
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import SMALL_BYTES, Running, running

Json = dict[str, Any]


@dataclass
class Live:
    """A running service, a clock moved by hand, and one session."""

    service: Running
    clock: HandClock
    client: httpx.AsyncClient
    path: str
    app: Any

    def open(self, **more: Any) -> connect:
        return connect(f"{self.service.ws}{self.path}/stream", compression=None, **more)

    async def say(self, text: str) -> httpx.Response:
        return await self.client.post(f"{self.path}/commands", json={"text": text})

    async def state(self) -> Json:
        return (await self.client.get(f"{self.path}/state")).json()  # type: ignore[no-any-return]


@pytest.fixture
async def live() -> AsyncIterator[Live]:
    settings = Settings(database="memory:", max_malformed_messages=3)
    clock = HandClock()
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=clock)
    async with (
        running(app, settings) as service,
        httpx.AsyncClient(base_url=service.http, timeout=60) as client,
    ):
        made = await client.post("/api/v1/sessions", json={"seed": 5, "config": {"rows": 10}})
        yield Live(service, clock, client, made.headers["location"], app)


async def receive(stream: ClientConnection) -> Json:
    message: Json = json.loads(await asyncio.wait_for(stream.recv(), 60))
    return message


async def next_tick(stream: ClientConnection) -> Json:
    """The next message but for lines about an end, which come when they are found out."""
    while (message := await receive(stream))["type"] == "changed":
        assert message["sequence"] == 0
    return message


async def send(stream: ClientConnection, **message: Any) -> None:
    await stream.send(json.dumps(message))


def follow(state: Json, message: Json) -> Json:
    """What a page does with a tick message: the next state from the last one."""
    if "state" in message:
        return message["state"]  # type: ignore[no-any-return]
    movers = [
        {
            **mover,
            "cell": message["moved"].get(mover["id"], mover["cell"]),
            "heading": message["turned"].get(mover["id"], mover["heading"]),
        }
        for mover in state["movers"]
    ]
    vehicles = [{**each, "cell": message["vehicles"][each["id"]]} for each in state["vehicles"]]
    return {
        **state,
        "tick": message["tick"],
        "status": message["status"],
        "movers": movers,
        "vehicles": vehicles,
    }


async def test_following_ticks_is_the_state(live: Live) -> None:
    """Over several episodes, what is sent adds up to what is so."""
    async with live.open() as stream:
        hello = await receive(stream)
        assert (hello["type"], hello["protocol"], hello["decision"]) == ("hello", 1, None)
        assert hello["session"]["links"]["self"] == live.path
        state, told = hello["state"], []
        for _ in range(60):
            live.clock.tick()
            message = await receive(stream)
            assert message["type"] == "tick"
            told.append(message["narration"])
            if (decision := message["decision"]) is not None:
                options = (await live.client.get(f"{live.path}/decisions/{decision['tick']}")).json()[
                    "options"
                ]
                assert decision["blocked"] == [
                    {key: option[key] for key in ("move", "reason", "causes")}
                    for option in options
                    if option["verdict"] != "free"
                ]
            state = follow(state, message)
            actual = await live.state()
            for part in ("vehicles", "tick", "status"):
                assert state[part] == actual[part]
            by_id = {mover["id"]: (mover["cell"], mover["heading"]) for mover in state["movers"]}
            assert by_id == {mover["id"]: (mover["cell"], mover["heading"]) for mover in actual["movers"]}
            assert message["digest"] == actual["digest"]
            assert message["metrics"] == actual["metrics"]
        assert actual["episode"] > 1
        assert all(told[n] for n in range(3))


async def test_a_change_reaches_every_watcher_whoever_makes_it(live: Live) -> None:
    async with live.open() as one, live.open() as other:
        await receive(one)
        await receive(other)
        await send(one, type="command", id="c1", text="add two cars")
        answers = [await receive(one), await receive(one)]
        result = next(each for each in answers if each["type"] == "result")
        assert (result["id"], result["result"]["sequence"]) == ("c1", 1)
        assert result["result"]["reply"]
        changed = await receive(other)
        assert changed in answers
        assert (changed["type"], changed["text"], changed["sequence"]) == ("changed", "add two cars", 1)
        assert changed["state"] == await live.state()

        await live.say("pause")
        assert [(await receive(each))["state"]["paused"] for each in (one, other)] == [True, True]


async def test_a_reconnected_reader_is_told_where_things_stand(live: Live) -> None:
    await live.say("add two cars")
    live.clock.tick(5)
    async with live.open() as stream:
        hello = await receive(stream)
    assert hello["state"] == await live.state()
    assert hello["sequence"] == 1
    assert hello["decision"]["tick"] == 4
    assert hello["decision"]["narration"]
    assert hello["log"][0]["type"] == "changed"


async def test_steps_are_played_tick_by_tick(live: Live) -> None:
    async with live.open() as stream:
        await receive(stream)
        await live.client.post(f"{live.path}/step", json={"ticks": 3})
        heard = [await receive(stream) for _ in range(4)]
        assert [(each["type"], each.get("tick")) for each in heard] == [
            ("tick", 1),
            ("tick", 2),
            ("tick", 3),
            ("changed", None),
        ]
        await live.client.post(f"{live.path}/step", json={"ticks": 100})
        assert (await receive(stream))["state"]["tick"] == 103


async def test_what_is_asked_is_asked_of_the_tick_that_is_looked_at(live: Live) -> None:
    live.clock.tick(4)
    async with live.open() as stream:
        await receive(stream)
        asked = {"type": "actions", "actions": [{"do": "ask", "about": "why"}]}
        for number, at_tick in enumerate((2, 99)):
            await stream.send(json.dumps(asked | {"id": str(number), "at_tick": at_tick}))
        answered, refused = await receive(stream), await receive(stream)
        assert answered["result"]["answer"]["tick"] == 2
        assert refused["problem"]["errors"][0]["field"] == "at_tick"


async def test_refusals_come_under_their_id(live: Live) -> None:
    async with live.open() as stream:
        await receive(stream)
        before = await live.state()
        for number, (message, slug) in enumerate(
            [
                ({"type": "command", "text": "order pizza"}, "not-understood"),
                ({"type": "command", "text": "slow down"}, "ambiguous"),
                ({"type": "command", "text": "x" * 501}, "invalid"),
                ({"type": "actions", "actions": [{"do": "redo"}]}, "nothing-to-undo"),
                ({"type": "actions", "actions": [{"do": "record", "on": True}]}, "not-available"),
            ]
        ):
            await send(stream, id=str(number), **message)
            answer = await receive(stream)
            assert (answer["type"], answer["id"]) == ("problem", str(number))
            assert answer["problem"]["type"] == f"/problems/{slug}"
        await send(stream, type="command", id="try", text="add two cars", dry_run=True)
        assert (await receive(stream))["result"]["dry_run"] is True
        await send(stream, type="ping")
        assert (await receive(stream)) == {"type": "pong"}
        assert await live.state() == before


@pytest.mark.parametrize(
    "message",
    [
        "{",
        "[]",
        "null",
        "7",
        '{"type": "dance"}',
        '{"type": "ping", "extra": 1}',
        '{"type": "ping", "type": "ping"}',
        '{"type": "command", "id": "1"}',
    ],
)
async def test_a_malformed_message_is_told_and_too_many_end_it(live: Live, message: str) -> None:
    async with live.open() as stream:
        await receive(stream)
        for _ in range(3):
            await stream.send(message)
            answer = await receive(stream)
            assert answer["type"] == "error"
            assert answer["problem"]["type"] in ("/problems/malformed", "/problems/invalid")
        with pytest.raises(ConnectionClosed) as closed:
            await receive(stream)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1008


async def test_binary_is_malformed(live: Live) -> None:
    async with live.open() as stream:
        await receive(stream)
        await stream.send(b'{"type": "ping"}')
        assert (await receive(stream))["problem"]["type"] == "/problems/malformed"


async def test_a_message_too_large_ends_it(live: Live) -> None:
    async with live.open() as stream:
        await receive(stream)
        await stream.send("x" * 200_000)
        with pytest.raises(ConnectionClosed) as closed:
            await receive(stream)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1009


async def test_an_unknown_session_is_told_before_closing(live: Live) -> None:
    async with connect(f"{live.service.ws}/api/v1/sessions/nobody/stream") as stream:
        message = await receive(stream)
        assert message["problem"]["type"] == "/problems/unknown-session"
        with pytest.raises(ConnectionClosed) as closed:
            await receive(stream)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 4404


async def test_a_deleted_session_says_goodbye(live: Live) -> None:
    async with live.open() as stream:
        await receive(stream)
        await live.client.delete(live.path)
        assert (await receive(stream)) == {"type": "gone"}
        with pytest.raises(ConnectionClosed) as closed:
            await receive(stream)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1000


async def test_a_page_of_another_site_is_refused(live: Live) -> None:
    with pytest.raises(InvalidStatus) as refused:
        async with live.open(origin="http://evil.example"):
            pass
    assert refused.value.response.status_code == 403
    assert json.loads(refused.value.response.body)["type"] == "/problems/cross-site"
    async with live.open(origin=live.service.http) as stream:
        assert (await receive(stream))["type"] == "hello"


async def test_a_slow_reader_costs_nobody_and_is_told(live: Live) -> None:
    """It stops reading until the server cannot write any more; the other one hears every tick."""
    small = socket.socket()
    small.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, SMALL_BYTES)
    small.connect(("127.0.0.1", live.service.port))
    small.setblocking(False)
    async with live.open(max_queue=1, sock=small) as slow, live.open() as quick:
        await receive(quick)
        ticks = 800
        for tick in range(1, ticks + 1):
            live.clock.tick()
            assert (await next_tick(quick))["tick"] == tick
        session = await live.app.state.context.manager.get(live.path.rsplit("/", 1)[1])
        assert len(session.subscribers) == 2
        heard, state = 0, None
        assert (await receive(slow))["type"] == "hello"
        while state is None:
            message = await next_tick(slow)
            if message["type"] == "state":
                state = message
            else:
                heard = message["tick"]
        first, last = state["missed"]
        assert first == heard + 1
        assert last == state["state"]["tick"] <= ticks
        assert last - first > QUEUE_SIZE


async def test_a_closed_reader_is_forgotten(live: Live) -> None:
    session = await live.app.state.context.manager.get(live.path.rsplit("/", 1)[1])
    for _ in range(3):
        async with live.open() as stream:
            await receive(stream)
            assert len(session.subscribers) == 1
        async with asyncio.timeout(60):
            while len(session.subscribers):  # noqa: ASYNC110 - the server hears of the close in its own time
                await asyncio.sleep(0)


async def test_stopping_tells_readers_to_come_back(live: Live) -> None:
    async with live.open() as stream:
        await receive(stream)
        live.service.server.should_exit = True
        with pytest.raises(ConnectionClosed) as closed:
            await receive(stream)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1012


COMMAND = {"type": "command", "text": "add five potholes", "key": "one"}


async def answer_to(live: Live, **message: Any) -> Json:
    """The answer to a message over a socket of its own."""
    async with live.open() as stream:
        await send(stream, **message)
        while True:
            heard = await receive(stream)
            if heard.get("id") == message["id"]:
                return heard


@pytest.mark.parametrize(
    "message",
    [
        COMMAND,
        COMMAND | {"dry_run": True},
        COMMAND | {"text": "where are you?"},
        {"type": "actions", "key": "one", "actions": [{"do": "add", "kind": "pothole", "count": 2}]},
    ],
)
async def test_a_message_under_a_key_is_done_once_over_whichever_socket(live: Live, message: Json) -> None:
    first = await answer_to(live, id="a", **message)
    state = await live.state()
    again = await answer_to(live, id="b", **message)
    assert first["type"] == "result"
    assert "replayed" not in first
    assert again == first | {"id": "b", "replayed": True}
    assert await live.state() == state


async def test_a_key_of_another_message_is_refused_and_a_refusal_is_not_kept(live: Live) -> None:
    refused = await answer_to(live, id="a", **COMMAND | {"text": "order pizza"})
    assert refused["problem"]["type"] == "/problems/not-understood"
    assert (await answer_to(live, id="b", **COMMAND))["type"] == "result"
    other = await answer_to(live, id="c", **COMMAND | {"text": "add two cars"})
    assert (other["type"], other["problem"]["type"]) == ("problem", "/problems/key-reused")


async def test_two_of_one_key_at_once_are_one(live: Live) -> None:
    before = (await live.state())["sequence"]
    one, two = await asyncio.gather(answer_to(live, id="a", **COMMAND), answer_to(live, id="b", **COMMAND))
    assert {one.get("replayed"), two.get("replayed")} == {None, True}
    assert one["result"] == two["result"]
    assert (await live.state())["sequence"] == before + 1


async def test_a_bad_key_is_malformed(live: Live) -> None:
    async with live.open() as stream:
        await receive(stream)
        await send(stream, id="a", **COMMAND | {"key": "two words"})
        heard = await receive(stream)
    assert heard["type"] == "error"
    assert heard["problem"]["errors"][0]["field"] == "key"
