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

    token = CURRENT_ASKER.set(Asker(client_of(scope) or UNNAMED, lambda: client_gone(scope, receive)))
    try:
        yield
    finally:
        CURRENT_ASKER.reset(token)


async def client_gone(scope: Scope, receive: Receive) -> None:
    """Return when the client of a request whose body has been read hangs up."""
    half_closed: asyncio.Event | None = (scope.get("extensions") or {}).get(HALF_CLOSED)
    signs = {asyncio.ensure_future(_disconnected(receive))}
    if half_closed is not None:
        signs.add(asyncio.ensure_future(_set(half_closed)))
    try:
        await asyncio.wait(signs, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for sign in signs:
            sign.cancel()


async def _disconnected(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


async def _set(event: asyncio.Event) -> None:
    await event.wait()
