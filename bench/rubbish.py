"""Requests and messages that make no sense, bodies that are far too large; for measuring and for tests."""

from __future__ import annotations

import asyncio
import json
import random

from bench.asking import request

_JSON = {"Content_Type": "application/json"}
_PIECE = b" " * 65_536


async def poured(url: str, path: str, size: int, *, chunked: bool) -> tuple[int, int]:
    """The status that a body of `size` bytes is answered with, and how many were taken before that."""
    host = url.removeprefix("http://")
    name, _, port = host.partition(":")
    reader, writer = await asyncio.open_connection(name, int(port))
    length = "Transfer-Encoding: chunked" if chunked else f"Content-Length: {size}"
    head = f"POST {path} HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\n{length}\r\n\r\n"
    piece = b"%x\r\n%b\r\n" % (len(_PIECE), _PIECE) if chunked else _PIECE
    taken = 0
    answer = asyncio.ensure_future(reader.readline())
    writer.write(head.encode())
    while taken < size and not answer.done():
        writer.write(piece)
        taken += len(_PIECE)
        drained = asyncio.ensure_future(writer.drain())
        await asyncio.wait((drained, answer), return_when=asyncio.FIRST_COMPLETED)
        if not drained.cancel() and drained.exception() is not None:
            break  # it hung up; what it said before that is still to be read
        await asyncio.sleep(0)
    status = (await asyncio.wait_for(answer, 20)).split()
    writer.transport.abort()
    return (int(status[1]) if len(status) > 1 else 0), taken


def garbage(dice: random.Random, path: str, host: str) -> bytes:
    """A request that makes no sense."""
    methods = ("GET", "POST", "PUT", "PATCH", "DELETE", "HEAD", "OPTIONS", "BREW")
    tails = (
        "",
        "/state",
        "/commands",
        "/actions",
        "/step",
        "/ask",
        "/parse",
        "/events",
        "/forks",
        "/nothing",
    )
    places = (path + dice.choice(tails), "/api/v1/sessions", "/api/v1/" + _word(dice), "/" + _word(dice))
    target, method = dice.choice(places), dice.choice(methods)
    if method == "DELETE" and target == path:
        target += "/nothing"
    if dice.random() < 0.3:
        target += f"?tick={_word(dice)}&limit={dice.randrange(-9, 10**20)}&after={_word(dice)}"
    odd = (
        {},
        _JSON,
        _JSON,
        _JSON,
        {**_JSON, "If_Match": _word(dice)},
        {**_JSON, "Idempotency_Key": _word(dice)},
        {"Origin": "http://" + _word(dice)},
    )
    return request(method, target, host, _rubbish(dice), **dice.choice(odd))


def _rubbish(dice: random.Random) -> bytes:
    """A body or message that makes no sense, or not the one that is wanted."""
    values = (None, True, -1, 1e308, "", "x" * 600, [], {}, [[]] * 20, {"do": "add", "kind": "dragon"})
    match dice.randrange(6):
        case 0:
            return dice.randbytes(dice.randrange(200))
        case 1:
            return b"[" * dice.randrange(1, 5_000)
        case 2:
            return b'{"text":"' + dice.randbytes(20) + b'"}'
        case 3:
            return b'{"text":NaN,"actions":[Infinity],"ticks":1e999}'
        case 4:
            keys = ("text", "actions", "ticks", "question", "config", "seed", "recording", "type", "id")
            return json.dumps({dice.choice(keys): dice.choice(values) for _ in range(3)}).encode()
        case _:
            return json.dumps({"text": " ".join(_word(dice) for _ in range(dice.randrange(1, 30)))}).encode()


def message(dice: random.Random) -> bytes:
    """Text that is no message; a socket is to be sent UTF-8."""
    return _rubbish(dice).decode("utf-8", "replace").encode()


def _word(dice: random.Random) -> str:
    return "".join(dice.choices("abcxyz0129-_.~%2e", k=dice.randrange(1, 20)))
