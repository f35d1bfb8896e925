"""Says to the executor of work who asks: the client of a request, and whether it still waits for the answer."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from starlette.types import Receive, Scope

from service.security.guard import client_of
from service.work.asker import CURRENT_ASKER, Asker

UNNAMED = "unnamed"
"""Counts all clients without an address as one: those of a Unix socket."""


@contextmanager
def asked_by(scope: Scope, receive: Receive) -> Iterator[None]:
    """Work in here is for a request whose body has been read; it ends when its client hangs up."""

    async def gone() -> None:
        while (await receive())["type"] != "http.disconnect":
            pass

    token = CURRENT_ASKER.set(Asker(client_of(scope) or UNNAMED, gone))
    try:
        yield
    finally:
        CURRENT_ASKER.reset(token)
