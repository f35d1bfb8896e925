"""What those cost who read nothing, send rubbish, or ask for too much: `python -m bench.readers`.

The service is the real command in a process of its own. Each part begins with a service of its own, and says
what was asked, what was answered, by how much the service's memory grew, and how the others fared.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import random
import sys
import time
from collections import Counter

import httpx
import uvloop

from bench.asking import Line, request
from bench.live import Heard
from bench.rubbish import garbage as one_garbage
from bench.rubbish import message as one_message
from bench.rubbish import poured
from bench.serving import Service, serving
from bench.sockets import opened

READERS = 50
GARBAGE = 10_000
MESSAGES = 1_000
SESSIONS = 10_000
BODY_BYTES = 50_000_000
MESSAGE_BYTES = 200_000
BEFORE_CLOSED = 20
"""Malformed messages after which a socket is closed."""

LINES = 16
"""Connections that ask at the same time."""

_JSON = {"Content_Type": "application/json"}
_SUBSCRIBE = b'{"type":"subscribe","frames":"jpeg","fps":60,"side":480}'


def main(arguments: list[str] | None = None) -> None:
    """Run all parts and print what came of them."""
    parser = argparse.ArgumentParser(
        prog="bench.readers", description=__doc__.splitlines()[0] if __doc__ else None
    )
    parser.add_argument("--seconds", type=float, default=20.0, help="for the readers that stall")
    parser.add_argument("--share", type=float, default=1.0, help="how much of the rubbish is sent")
    options = parser.parse_args([] if arguments is None else arguments)
    with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
        runner.run(_all(options.seconds, options.share))


async def _all(seconds: float, share: float) -> None:
    await stalled(seconds)
    await garbage(int(GARBAGE * share))
    await rubbish(int(MESSAGES * share))
    await too_much()
    await crowd(int(SESSIONS * share))


async def stalled(seconds: float) -> None:
    """Readers that never read, of messages and of pictures, beside some that do."""
    async with serving() as service, httpx.AsyncClient(base_url=service.url, timeout=60) as client:
        made = (await client.post("/api/v1/sessions", json={})).raise_for_status().json()
        faster = {"do": "set", "parameter": "playback_speed", "value": 8}
        done = await client.post(f"{made['links']['self']}/actions", json={"actions": [faster]})
        done.raise_for_status()
        stream = made["links"]["stream"]
        period_s = made["config"]["step_seconds"] / 8
        heard = [Heard() for _ in range(5)]
        sockets = [await opened(service.url, stream, each) for each in heard]
        for socket in sockets:
            socket.say(_SUBSCRIBE)
        alone = await _delays(heard, period_s, seconds / 2)
        before_mb = service.memory_mb()
        silent = [await opened(service.url, stream, lambda _: None) for _ in range(READERS)]
        for socket in silent:
            socket.say(_SUBSCRIBE)
            socket.stall()
        beside = await _delays(heard, period_s, seconds)
        grown_mb = service.memory_mb() - before_mb
        missed = sum(each.missed for each in heard)
        for socket in (*sockets, *silent):
            socket.close()
    print(f"{READERS} readers that never read, of {1 / period_s:.0f} ticks/s and of pictures")
    print(f"  memory                {grown_mb:+.1f} MB")
    print(f"  others, before them   p50 {alone[0]:.1f} ms   p99 {alone[1]:.1f} ms")
    print(f"  others, beside them   p50 {beside[0]:.1f} ms   p99 {beside[1]:.1f} ms   missed {missed} ticks")


async def _delays(heard: list[Heard], period_s: float, seconds: float) -> tuple[float, float]:
    for each in heard:
        each.clear()
    await asyncio.sleep(seconds)
    delays = sorted(delay for each in heard for delay in each.delays_ms(period_s))
    return delays[len(delays) // 2], delays[int(0.99 * (len(delays) - 1))]


async def garbage(count: int) -> None:
    """Requests that make no sense, half of them nearly."""
    async with serving(quiet=True, max_sessions=50) as service:
        path = await _session(service)
        dice = random.Random(5)
        answers: Counter[int] = Counter()
        odd = [one_garbage(dice, path, service.url.removeprefix("http://")) for _ in range(500)]
        await _asked(service, odd, Counter())  # what is made once and stays is not what is measured
        before_mb = service.memory_mb()
        odd = [one_garbage(dice, path, service.url.removeprefix("http://")) for _ in range(count)]
        await _asked(service, odd, answers)
        grown_mb = service.memory_mb() - before_mb
        alive = await _alive(service)
    told = "   ".join(f"{status or 'cut off'}: {number}" for status, number in sorted(answers.items()))
    print(f"{count} garbage requests")
    print(f"  answered              {told}")
    print(f"  memory                {grown_mb:+.1f} MB   {alive}")


async def rubbish(count: int) -> None:
    """Messages that make no sense, on sockets."""
    async with serving() as service:
        path = await _session(service)
        dice = random.Random(6)
        await _warm(service, path)
        before_mb = service.memory_mb()
        codes: Counter[int | None] = Counter()
        errors = sent = 0

        def heard(message: bytes) -> None:
            nonlocal errors
            errors += message.startswith(b'{"type":"error"')

        while sent < count:
            socket = await opened(service.url, f"{path}/stream", heard)
            for _ in range(BEFORE_CLOSED):
                socket.say(one_message(dice))
                sent += 1
            await asyncio.wait_for(socket.ended.wait(), 20)
            codes[socket.code] += 1
        grown_mb = service.memory_mb() - before_mb
        alive = await _alive(service)
    told = "   ".join(f"closed with {code}: {number}" for code, number in codes.items())
    print(f"{count} garbage messages")
    print(f"  answered              {errors} errors   {told}")
    print(f"  memory                {grown_mb:+.1f} MB   {alive}")


async def too_much() -> None:
    """A body and a message that are far too large."""
    async with serving() as service:
        path = await _session(service)
        await _warm(service, path)
        before_mb = service.memory_mb()
        url, posted = service.url, f"{path}/actions"
        told = [await poured(url, posted, BODY_BYTES, chunked=chunked) for chunked in (False, True)]
        socket = await opened(service.url, f"{path}/stream", lambda _: None)
        socket.say(b'{"type":"ping","x":"' + b"x" * MESSAGE_BYTES + b'"}')
        await asyncio.wait_for(socket.ended.wait(), 20)
        grown_mb = service.memory_mb() - before_mb
        alive = await _alive(service)
    for (status, taken), how in zip(told, ("its length said", "in pieces"), strict=True):
        print(f"a body of {BODY_BYTES / 1e6:.0f} MB, {how}")
        print(f"  answered              {status}, after {taken / 1e6:.2f} MB were taken")
    print(f"a message of {MESSAGE_BYTES / 1e3:.0f} kB")
    print(f"  answered              closed with {socket.code}")
    print(f"  memory                {grown_mb:+.1f} MB   {alive}")


async def crowd(count: int) -> None:
    """Far more sessions than there may be."""
    most = 200
    async with serving(max_sessions=most) as service:
        host = service.url.removeprefix("http://")
        answers: Counter[int] = Counter()
        wanted = [request("POST", "/api/v1/sessions", host, b"{}", **_JSON)] * count
        bodies = await _asked(service, wanted, answers)
        async with httpx.AsyncClient(base_url=service.url, timeout=60) as client:
            page = (await client.get("/api/v1/sessions", params={"limit": most})).json()["items"]
            ticks = [each["tick"] for each in page]
            await asyncio.sleep(2)
            page = (await client.get("/api/v1/sessions", params={"limit": most})).json()["items"]
            moved = sum(now["tick"] > was for now, was in zip(page, ticks, strict=True))
        alive = await _alive(service)
    refusal = next((json.loads(body) for body in bodies if b"too-many" in body), {})
    print(f"{count} sessions asked for where {most} may be")
    print(f"  answered              {'   '.join(f'{key}: {n}' for key, n in sorted(answers.items()))}")
    print(f"  the refusal           {refusal.get('status')}: {refusal.get('detail')}")
    print(f"  those that were made  {moved} of {len(page)} went on within 2 s   {alive}")


async def _session(service: Service) -> str:
    async with Line(service.url) as line:
        answer = await line.ask(request("POST", "/api/v1/sessions", line.host, b"{}", **_JSON))
    return answer.headers["location"]


async def _warm(service: Service, path: str) -> None:
    """A socket and a message in order: what is made once and stays is not what is measured."""
    answered = asyncio.Event()

    def heard(message: bytes) -> None:
        if message.startswith(b'{"type":"pong"'):
            answered.set()

    socket = await opened(service.url, f"{path}/stream", heard)
    socket.say(b'{"type":"ping"}')
    await asyncio.wait_for(answered.wait(), 20)
    socket.close()


async def _alive(service: Service) -> str:
    async with Line(service.url) as line:
        began = time.perf_counter()
        answer = await line.ask(request("GET", "/healthz", line.host))
        took_ms = 1e3 * (time.perf_counter() - began)
    return f"alive: {answer.status} in {took_ms:.1f} ms" if service.alive else "it has ended"


async def _asked(service: Service, wanted: list[bytes], answers: Counter[int]) -> list[bytes]:
    """Ask all of this on some lines at once; the last bodies."""
    left, bodies = iter(wanted), []

    async def one() -> None:
        async with Line(service.url) as line:
            for each in left:
                answer = await line.ask(each)
                answers[answer.status] += 1
                if answer.status >= 400:
                    bodies[:] = [*bodies[-3:], answer.body]

    await asyncio.gather(*(one() for _ in range(LINES)))
    return bodies


if __name__ == "__main__":
    main(sys.argv[1:])
