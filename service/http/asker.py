"""Tells the executor of work who asks: the client of a request, and whether it still waits."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from starlette.types import Receive, Scope

from service.security.guard import client_of
from service.work.asker import CURRENT_ASKER, Asker

UNNAMED = "unnamed"
"""Counts all clients without an address as one: those of a Unix socket."""

HALF_CLOSED: Final = "roadtalk.half_closed"
"""The key of an event in a scope's `extensions`: the client has half-closed some time ago."""


@contextmanager
def asked_by(scope: Scope, receive: Receive) -> Iterator[None]:
    """Work in here is for a request whose body has been read; it ends when its client hangs up."""

    async def disconnected() -> None:
        while (await receive())["type"] != "http.disconnect":
            pass

    async def gone() -> None:
        half_closed: asyncio.Event | None = (scope.get("extensions") or {}).get(HALF_CLOSED)
        signs = {asyncio.ensure_future(disconnected())}
        if half_closed is not None:
            signs.add(asyncio.ensure_future(_set(half_closed)))
        try:
            await asyncio.wait(signs, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for sign in signs:
                sign.cancel()

    token = CURRENT_ASKER.set(Asker(client_of(scope) or UNNAMED, gone))
    try:
        yield
    finally:
        CURRENT_ASKER.reset(token)


async def _set(event: asyncio.Event) -> None:
    await event.wait()
