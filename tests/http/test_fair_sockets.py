"""One socket that sends much delays nobody: a message at a time, a turn for others after each."""

from __future__ import annotations

import asyncio
import json
from types import SimpleNamespace
from typing import Any

import pytest

from service.http.realtime import websocket
from service.http.realtime.websocket import MOST_UNANSWERED
from service.work.asker import CURRENT_ASKER


class _Socket:
    """A client that sends so many messages at once and then goes, or reads nothing."""

    def __init__(self, messages: int, *, reads: bool) -> None:
        self.left, self.sent = messages, 0
        self.reads = reads
        self.stuck = asyncio.Event()
        self.scope = {"client": ("10.0.0.1", 5)}

    async def receive(self) -> dict[str, Any]:
        self.left -= 1
        if self.left < 0:
            return {"type": "websocket.disconnect"}
        return {"type": "websocket.receive", "text": json.dumps({"type": "ping"})}

    async def send(self, message: dict[str, Any]) -> None:
        assert json.loads(message["text"]) == {"type": "pong"}
        if not self.reads:
            self.stuck.set()
            await asyncio.get_running_loop().create_future()
        self.sent += 1


def context() -> Any:
    return SimpleNamespace(settings=SimpleNamespace(max_malformed_messages=3))


async def read(socket: _Socket) -> None:
    await websocket._read(socket, context(), None, None)  # type: ignore[arg-type]


async def test_others_have_a_turn_after_each_message() -> None:
    socket, turns = _Socket(100, reads=True), 0

    async def other() -> None:
        nonlocal turns
        while socket.sent < 100:
            turns += 1
            await asyncio.sleep(0)

    beside = asyncio.create_task(other())
    await read(socket)
    await beside
    assert socket.sent == 100
    assert turns >= 100


async def test_of_a_client_that_never_reads_few_messages_are_taken_in() -> None:
    socket = _Socket(1_000, reads=False)
    reading = asyncio.create_task(read(socket))
    await socket.stuck.wait()
    for _ in range(50):
        await asyncio.sleep(0)
    taken = 1_000 - socket.left
    assert taken <= MOST_UNANSWERED + 2
    reading.cancel()
    with pytest.raises(asyncio.CancelledError):
        await reading


async def test_dear_work_for_a_client_that_has_gone_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    ended: list[str] = []

    async def answer(*_: Any) -> bytes:
        asker = CURRENT_ASKER.get()
        assert asker.gone is not None
        await asker.gone()
        ended.append(asker.client)
        return b'{"type":"pong"}'

    monkeypatch.setattr(websocket, "_answer", answer)
    await read(_Socket(1, reads=True))
    assert ended == ["10.0.0.1"]
