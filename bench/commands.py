"""Processor time of a command, stage by stage, in this process: `python -m bench.commands`.

Rates of requests (`python -m bench.rest`) depend on what else runs on the machine; processor time hardly.
Each stage is called by itself, many times, and the least of some turns is stated:

- whole: the ASGI application, from the scope to the last message, without a server and without a socket;
- shell: the same with an endpoint that does nothing: middleware, access, body, validation, response;
- interpret: the sentence becomes actions;
- execute: they are done on a copy, told, stored and published.

Threads of the database count as well: processor time is that of the process.
"""

from __future__ import annotations

import argparse
import asyncio
import gc
import json
import sys
import tempfile
import time
from collections.abc import Awaitable, Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Any

import uvloop
from fastapi import FastAPI, Response

from bench.rest import ACTIONS, SENTENCE, WORDINGS
from service.app import create_app
from service.http.deps import Context
from service.http.middleware import direct_routes
from service.settings import Settings

TURNS = 7
SESSIONS = 8
"""Sessions whose commands wait for one commit together."""

Work = Callable[[int], Awaitable[object]]


def main(arguments: list[str] | None = None) -> None:
    """Measure and print processor time, in microseconds for each request."""
    parser = argparse.ArgumentParser(prog="bench.commands", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--requests", type=int, default=400, help="in each turn")
    options = parser.parse_args([] if arguments is None else arguments)
    with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
        gc.freeze()
        gc.disable()  # as in the service, the young are collected at times (`service.gc_tuning`)
        runner.run(_measured(options.requests))


async def _measured(requests: int) -> None:
    print(f"µs of processor time for each request, least of {TURNS} turns of {requests}")
    with tempfile.TemporaryDirectory() as folder:
        await _print_stages("memory:", requests)
        await _print_durable(f"sqlite:///{Path(folder) / 'measured.db'}", requests)


async def _print_stages(database: str, requests: int) -> None:
    app = create_app(Settings(database=database, log_level="warning"))
    context: Context = app.state.context
    async with app.router.lifespan_context(app):
        path = await _session(app)
        session = await context.manager.get(path.rpartition("/")[2])
        text = json.loads(SENTENCE)["text"]
        heard = await context.interpreter.interpret(text, session)
        numbers = count()

        def state(_: int) -> Awaitable[object]:
            return _ask(app, "GET", f"{path}/state")

        def command(_: int) -> Awaitable[object]:
            return _ask(app, "POST", f"{path}/commands", SENTENCE)

        def typed(_: int) -> Awaitable[object]:
            return _ask(app, "POST", f"{path}/actions", ACTIONS)

        def never_said(_: int) -> Awaitable[object]:
            return _ask(app, "POST", f"{path}/commands", _new_sentence(next(numbers)))

        def interpret(_: int) -> Awaitable[object]:
            return context.interpreter.interpret(text, session)

        def execute(_: int) -> Awaitable[object]:
            return context.interpreter.execute(session, heard.utterance)

        await _print("state, whole", state, requests)
        await _print("command said before, whole", command, requests)
        with _idle_endpoints():
            await _print("  shell", command, requests)
        await _print("  interpret", interpret, requests)
        await _print("  execute", execute, requests)
        await _print("typed, whole", typed, requests)
        await _print("command never said before, whole", never_said, max(1, requests // 10))


async def _print_durable(database: str, requests: int) -> None:
    app = create_app(Settings(database=database, log_level="warning"))
    async with app.router.lifespan_context(app):
        paths = [await _session(app) for _ in range(SESSIONS)]

        def one(_: int) -> Awaitable[object]:
            return _ask(app, "POST", f"{paths[0]}/commands", SENTENCE)

        def many(_: int) -> Awaitable[object]:
            return asyncio.gather(*(_ask(app, "POST", f"{path}/commands", SENTENCE) for path in paths))

        await _print("command, durable, one session", one, requests)
        await _print(f"command, durable, {SESSIONS} sessions", many, requests // SESSIONS, SESSIONS)


async def _print(name: str, work: Work, times: int, each: int = 1) -> None:
    """`each`: requests in one call of the work."""
    for number in range(min(times, 100)):
        await work(number)
    spent = []
    for _ in range(TURNS):
        began = time.process_time()
        for number in range(times):
            await work(number)
        gc.collect(0)
        spent.append((time.process_time() - began) / times / each)
    print(f"  {name:<36} {min(spent) * 1e6:8.0f}")


def _new_sentence(number: int) -> bytes:
    wording = WORDINGS[number % len(WORDINGS)]
    return json.dumps({"text": wording.replace("#", f"{number / 1e6:.6f}")}).encode()


async def _session(app: FastAPI) -> str:
    sent = await _ask(app, "POST", "/api/v1/sessions", b'{"seed":7,"paused":true}')
    return dict(sent[0]["headers"])[b"location"].decode()


async def _ask(app: FastAPI, method: str, path: str, body: bytes = b"") -> Sequence[dict[str, Any]]:
    """The messages that answer a request."""
    headers = [(b"host", b"127.0.0.1:8000")]
    if body:
        headers += [(b"content-type", b"application/json"), (b"content-length", str(len(body)).encode())]
    scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": method,
        "scheme": "http",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "root_path": "",
        "headers": headers,
        "client": ("127.0.0.1", 50000),
        "server": ("127.0.0.1", 8000),
        "state": {},
    }
    received: list[dict[str, Any]] = [{"type": "http.request", "body": body, "more_body": False}]
    sent: list[dict[str, Any]] = []

    async def receive() -> dict[str, Any]:
        if received:
            return received.pop()
        await asyncio.Event().wait()
        raise AssertionError

    async def send(message: Any) -> None:
        sent.append(message)

    await app(scope, receive, send)
    if sent[0]["status"] not in (200, 201):
        raise SystemExit(f"{path} was answered {sent[0]['status']}: {sent[1]['body']!r}")
    return sent


@contextmanager
def _idle_endpoints() -> Iterator[None]:
    """Direct routes answer without doing anything."""
    own = direct_routes.DirectCall.__call__

    async def idle(*_: object) -> Response:
        return Response(b"{}", media_type="application/json")

    direct_routes.DirectCall.__call__ = idle  # type: ignore[method-assign, assignment]
    try:
        yield
    finally:
        direct_routes.DirectCall.__call__ = own  # type: ignore[method-assign]


if __name__ == "__main__":
    main(sys.argv[1:])
