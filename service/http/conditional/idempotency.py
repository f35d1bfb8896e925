"""`Idempotency-Key`: a request under a key is done once, and answered the same however often it is sent.

The answer is stored in the same transaction as the change, so a client that never received it (the connection
was cut, the service killed) sends the request again and gets it. A request that comes while the first is
still under way waits for that. A refusal changed nothing and is not kept: the same key may try again.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Awaitable, Callable
from typing import Any

from fastapi import Request, Response

from service.http.conditional.answers import KeptAnswers
from service.problems import FieldProblem, IdempotencyKeyReused, Invalid
from service.store import StoredResponse

HEADER = "Idempotency-Key"
REPLAYED = "Idempotency-Replayed"
"""Marks an answer that was given before."""

_KEYED_METHODS = ("POST", "PATCH")
_SCOPE_KEY = "roadtalk.keyed_request"
_KEY = re.compile(r"[\x21-\x7e]{1,255}")
_NOT_KEPT = frozenset(("content-length", "date", "server"))

Handler = Callable[[Request], Awaitable[Response]]


class KeyedRequest:
    """A request under a key, for whoever stores what it does."""

    def __init__(self, key: str, request: str, answers: KeptAnswers) -> None:
        self._key = key
        self._request = request
        self._answers = answers
        self.stored = False

    def keep(self, response: Response) -> StoredResponse:
        """What has to be stored so that this response can be given again."""
        self.stored = True
        headers = {name: value for name, value in response.headers.items() if name not in _NOT_KEPT}
        return StoredResponse(
            key=self._key,
            request=self._request,
            at=self._answers.now,
            status=response.status_code,
            headers=headers,
            body=bytes(response.body),
        )


def keyed_request(request: Request) -> KeyedRequest | None:
    """The key a request came under, if any."""
    found: KeyedRequest | None = request.scope.get(_SCOPE_KEY)
    return found


async def handle_once(request: Request, answers: KeptAnswers, handler: Handler) -> Response:
    """Answers a request, or repeats the answer under its key. Raises `IdempotencyKeyReused` or `Invalid`."""
    key = request.headers.get(HEADER)
    if key is None or request.method not in _KEYED_METHODS:
        return await handler(request)
    if not _KEY.fullmatch(key):
        message = "must be 1 to 255 visible characters without spaces"
        raise Invalid(f"{HEADER} {message}.", errors=[FieldProblem(HEADER, message)])
    digest = await _digest(request)
    async with answers.turn(key):
        found = await answers.find(key)
        if found is not None:
            if found.request != digest:
                raise IdempotencyKeyReused
            return Response(found.body, found.status, {**found.headers, REPLAYED: "true"})
        keyed = request.scope[_SCOPE_KEY] = KeyedRequest(key, digest, answers)
        response = await handler(request)
        if not keyed.stored and response.status_code < 300:
            await answers.keep(keyed.keep(response))
        return response


def document(method: str, heeded: bool, operation: dict[str, Any], add_problems: Callable[..., Any]) -> None:
    """Adds the header to the documentation of a call; `heeded` is its route's policy."""
    if not heeded or method.upper() not in _KEYED_METHODS:
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
    add_problems(operation, "key-reused", "invalid", "not-saved")


async def _digest(request: Request) -> str:
    asked = hashlib.sha256(f"{request.method} {request.url.path}?{request.url.query}\n".encode())
    asked.update(await request.body())
    return asked.hexdigest()
