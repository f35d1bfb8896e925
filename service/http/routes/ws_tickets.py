"""`POST /tickets`, and how a socket proves that it may come in."""

from __future__ import annotations

import asyncio
from json import JSONDecodeError
from typing import Annotated, Literal

from fastapi import APIRouter, Body, Request, Response
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from starlette.websockets import WebSocket

from service.http import json as strictly
from service.http.deps import JSON_ONLY
from service.http.errors import documented
from service.http.responses import StrictRoute, json_response
from service.problems import Invalid, Malformed, NotJson, TooLarge
from service.security.guard import guard_of
from service.security.ws_tickets import GOOD_FOR_S

AUTH_WAIT_S = 5
"""How long a socket may stay silent before it says who it is."""

REFUSED = 4401
"""The code a socket is closed with that brought no key and no good ticket."""

router = APIRouter(tags=["operating"], route_class=StrictRoute)


class NoFields(BaseModel):
    """Nothing to be said."""

    model_config = ConfigDict(extra="forbid")


class Ticket(BaseModel):
    """Good for one socket."""

    ticket: str = Field(description="To be sent as the first message of a socket.")
    good_for_s: int = Field(description="Seconds within which it must be used.")


class _Auth(BaseModel):
    """The first message of a socket where a key is asked for."""

    model_config = ConfigDict(extra="forbid", strict=True)

    type: Literal["auth"]
    key: str | None = Field(default=None, max_length=1_000)
    ticket: str | None = Field(default=None, max_length=100)


@router.post(
    "/tickets",
    response_model=Ticket,
    summary="Get a ticket for a socket",
    dependencies=[JSON_ONLY],
    responses=documented(Malformed, TooLarge, NotJson, Invalid),
)
async def ticket(
    body: Annotated[NoFields, Body(openapi_examples={"one": {"summary": "One ticket", "value": {}}})],  # noqa: ARG001
    request: Request,
) -> Response:
    """Good for one socket within seconds: its first message is `{"type": "auth", "ticket": "..."}`.

    Only needed where the service has a key; the key itself may be sent as `key` in its place.
    """
    issued = guard_of(request).tickets.issue()
    told = {"ticket": issued, "good_for_s": GOOD_FOR_S}
    return json_response(told, headers={"Cache-Control": "no-store"})


async def admitted(socket: WebSocket) -> bool:
    """Whether an accepted socket may go on; if not, it is closed. Reads its first message if need be."""
    guard = guard_of(socket)
    brought = socket.headers.get("authorization")
    if guard.key.admits(brought):
        return True
    if brought is not None:  # the wrong one; nothing else is waited for
        await socket.close(REFUSED, "a key or a ticket is needed")
        return False
    try:
        received = await asyncio.wait_for(socket.receive(), AUTH_WAIT_S)
    except TimeoutError:
        received = {"type": "websocket.receive", "text": None}
    if received["type"] == "websocket.disconnect":
        return False
    try:
        said = _Auth.model_validate(strictly.loads(received.get("text") or ""))
    except (JSONDecodeError, ValidationError):
        said = _Auth(type="auth")
    if (said.ticket is not None and guard.tickets.take(said.ticket)) or (
        said.key is not None and guard.key.right(said.key)
    ):
        return True
    await socket.close(REFUSED, "a key or a ticket is needed")
    return False
