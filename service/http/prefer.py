"""`Prefer: respond-async` (RFC 7240): a long answer is made in the background, and fetched when it is there.

Without the header, and where the answer takes less than a second, the request is answered as it ever was.
That is an estimate: where the answer is not there after some seconds, since the machine is busy, 202 follows.
"""

from __future__ import annotations

import asyncio
import re
from collections.abc import Awaitable, Callable
from typing import Annotated, Any, Final

from fastapi import Header, Request, Response

from service.contract import answers as schemas
from service.http.deps import Context
from service.http.responses import json_response
from service.http.session_json import PREFIX
from service.security.guard import client_of
from service.work.long_answers import LONG_UNITS, LongAnswer

RESPOND_ASYNC: Final = "respond-async"

Prefer = Annotated[
    str | None,
    Header(
        description="`respond-async`: what takes more than a second is answered 202, with a link (RFC 7240).",
        max_length=200,
    ),
]

PATIENCE_S: Final = 5.0
"""How long an answer is waited for whose estimate is short; well below the read timeout of usual clients."""

ACCEPTED: Final[dict[int | str, dict[str, Any]]] = {
    202: {
        "model": schemas.LongAnswer,
        "description": "It is being made: look at `links.self` for its progress, and fetch `links.result`.",
        "headers": {"Location": {"description": "Where it is.", "schema": {"type": "string"}}},
    }
}
"""The response of a call whose answer may be long, for its documentation."""


async def respond_async(
    request: Request,
    here: Context,
    session_id: str,
    what: str,
    units: int,
    make: Callable[[], Awaitable[Response]],
) -> Response:
    """The answer, or 202 where it takes long and the client prefers that. Raises what `make` raises."""
    if not _prefers_async(request):
        return await make()
    here.manager.work.check(units)
    answer = here.long_answers.start(what, session_id, client_of(request.scope), make)
    if units < LONG_UNITS and await _made_soon(here, answer):
        if answer.problem is not None:
            raise answer.problem
        assert answer.result is not None
        return answer.result
    headers = {"Location": _path(answer), "Preference-Applied": RESPOND_ASYNC, "Retry-After": "1"}
    return json_response(long_answer_json(answer), 202, headers)


async def _made_soon(here: Context, answer: LongAnswer[Response]) -> bool:
    """Whether an answer is made within `PATIENCE_S`; then it is not kept, nor for a request that ended."""
    keep = False
    try:
        if answer.task is not None:
            await asyncio.wait((answer.task,), timeout=PATIENCE_S)
        keep = answer.state == "running"
    finally:
        if not keep:
            here.long_answers.delete(answer.of, answer.id)
    return not keep


def long_answer_json(answer: LongAnswer[Response]) -> dict[str, Any]:
    """A long answer as it stands."""
    own = _path(answer)
    return {
        "id": answer.id,
        "session": answer.of,
        "what": answer.what,
        "state": answer.state,
        "progress": answer.share,
        "links": {"self": own, "result": f"{own}/result"},
    }


def _path(answer: LongAnswer[Response]) -> str:
    return f"{PREFIX}/sessions/{answer.of}/answers/{answer.id}"


def _prefers_async(request: Request) -> bool:
    given = ",".join(request.headers.getlist("prefer"))
    return RESPOND_ASYNC in (each.strip().lower() for each in re.split(r"[,;]", given))
