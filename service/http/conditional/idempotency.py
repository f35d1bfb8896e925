"""`Idempotency-Key`: what was asked under a key is done once, and answered the same as often as it is sent.

The answer is stored in the same transaction as the change, so a caller that never heard it (the line was
cut, the service killed) sends the request again and is told. Whoever sends it while the first is still
under way waits for that. A refusal changed nothing and is not kept: the same key may try again.

Answers are kept for a day. A day is counted from where the wall clock stood at the start, by a clock that
cannot be set; while the service is stopped nothing grows old. So no jump of the wall clock forgets a key
too early, or keeps it for ever.
"""

from __future__ import annotations

import asyncio
import hashlib
import re
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any

import structlog
from fastapi import Request, Response

from service.problems import FieldProblem, Invalid, KeyReused
from service.store import KeptAnswer, Store, StoreError

_LOG = structlog.get_logger(__name__)

HEADER = "Idempotency-Key"
REPLAYED = "Idempotency-Replayed"
"""Says of an answer that it was given before."""

UNDER_KEY = "roadtalk.once"
"""Where a request's scope has its `Once`."""

KEPT_S = 24 * 3_600
FORGET_EVERY_S = 3_600

_KEY = re.compile(r"[\x21-\x7e]{1,255}")
_NOTHING_CHANGES = ("/parse", "/advice", "/ask", "/tickets")
"""Calls by POST that change nothing, or that nobody may be given the same answer of twice."""
_NOT_KEPT = frozenset(("content-length", "date", "server"))


class Answers:
    """The answers that are kept, and the requests that are under way."""

    def __init__(
        self,
        store: Store,
        wall: Callable[[], float] = time.time,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        self._store = store
        self._wall = wall
        self._steady = steady
        self._began = wall() - steady()
        self._forgot_at = 0
        self._turns: dict[str, tuple[asyncio.Lock, int]] = {}

    @property
    def now(self) -> int:
        """Seconds since 1970 by a clock that cannot be set."""
        return int(self._began + self._steady())

    async def open(self) -> None:
        """Begin to count where the wall clock stands; what is kept is as old as when it was left."""
        self._began = self._wall() - self._steady()
        await self._store.date_answers(self.now)
        await self._forget()

    @asynccontextmanager
    async def turn(self, key: str) -> AsyncIterator[None]:
        """One request under a key at a time."""
        lock, waiting = self._turns.get(key, (asyncio.Lock(), 0))
        self._turns[key] = (lock, waiting + 1)
        try:
            async with lock:
                yield
        finally:
            lock, waiting = self._turns[key]
            if waiting == 1:
                del self._turns[key]
            else:
                self._turns[key] = (lock, waiting - 1)

    async def find(self, key: str) -> KeptAnswer | None:
        """What was answered under a key, if that is not too long ago."""
        if self.now - self._forgot_at > FORGET_EVERY_S:
            await self._forget()
        found = await self._store.kept(key)
        if found is not None and found.at < self.now - KEPT_S:
            await self._forget()
            return None
        return found

    async def keep(self, answer: KeptAnswer) -> None:
        """Keep the answer to something that left nothing in any session, or is stored already."""
        try:
            await self._store.keep(answer)
        except StoreError as error:
            _LOG.error("an answer was not kept", error=str(error))

    async def _forget(self) -> None:
        self._forgot_at = self.now
        await self._store.forget_answers(self.now - KEPT_S)


class Once:
    """A request under a key, for whoever stores what it does."""

    def __init__(self, key: str, request: str, answers: Answers) -> None:
        self._key = key
        self._request = request
        self._answers = answers
        self.given = False

    def keeping(self, response: Response) -> KeptAnswer:
        """What is to be kept so that this response can be given again."""
        self.given = True
        headers = {name: value for name, value in response.headers.items() if name not in _NOT_KEPT}
        return KeptAnswer(
            key=self._key,
            request=self._request,
            at=self._answers.now,
            status=response.status_code,
            headers=headers,
            body=bytes(response.body),
        )


Handler = Callable[[Request], Awaitable[Response]]


async def once(request: Request, answers: Answers, handler: Handler) -> Response:
    """Answer a request, or say again what it was answered before. Raises `KeyReused` or `Invalid`."""
    key = request.headers.get(HEADER)
    if key is None or not _keyed(request.method, request.url.path):
        return await handler(request)
    if not _KEY.fullmatch(key):
        message = "must be 1 to 255 visible characters without spaces"
        raise Invalid(f"{HEADER} {message}.", errors=[FieldProblem(HEADER, message)])
    asked = await _digest(request)
    async with answers.turn(key):
        found = await answers.find(key)
        if found is not None:
            if found.request != asked:
                raise KeyReused
            return Response(found.body, found.status, {**found.headers, REPLAYED: "true"})
        under_key = Once(key, asked, answers)
        request.scope[UNDER_KEY] = under_key
        response = await handler(request)
        if not under_key.given and response.status_code < 300:
            await answers.keep(under_key.keeping(response))
        return response


def document(method: str, path: str, operation: dict[str, Any], problem: Callable[..., Any]) -> None:
    """Tell of the header in the documentation of a call; `problem` makes an error's documentation."""
    if not _keyed(method.upper(), path):
        if method != "get":
            why = "ending twice is ending once" if method == "delete" else "nothing is changed"
            operation["description"] += f"\n\n`{HEADER}` is not looked at: {why}."
        return
    operation.setdefault("parameters", []).append(
        {
            "name": HEADER,
            "in": "header",
            "required": False,
            "schema": {"type": "string", "minLength": 1, "maxLength": 255, "pattern": "^[!-~]+$"},
            "description": "Chosen by you: done once under this key, and answered the same for 24 hours.",
        }
    )
    problem(operation, "key-reused", "invalid", "not-saved")


def _keyed(method: str, path: str) -> bool:
    return method in ("POST", "PATCH") and not path.endswith(_NOTHING_CHANGES)


async def _digest(request: Request) -> str:
    asked = hashlib.sha256(f"{request.method} {request.url.path}?{request.url.query}\n".encode())
    asked.update(await request.body())
    return asked.hexdigest()
