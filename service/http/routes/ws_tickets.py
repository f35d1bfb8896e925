"""`POST /tickets`: tickets for WebSockets, so that a page need not send its key to each."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Response
from pydantic import BaseModel, ConfigDict

from service.contract.ticket import Ticket
from service.http.content_type import JSON_ONLY
from service.http.deps import Here
from service.http.errors import problem_responses
from service.http.responses import json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.problems import ContentTooLarge, Invalid, Malformed, UnsupportedMediaType
from service.security.ws_tickets import GOOD_FOR_S

router = api_router("operating")


class NoFields(BaseModel):
    """An empty object."""

    model_config = ConfigDict(extra="forbid")


@router.post(
    "/tickets",
    response_model=Ticket,
    summary="Get a ticket for a socket",
    dependencies=[JSON_ONLY],
    responses=problem_responses(Malformed, ContentTooLarge, UnsupportedMediaType, Invalid),
)
@policy(idempotency_key=False)
async def create_ticket(
    body: Annotated[NoFields, Body(openapi_examples={"one": {"summary": "One ticket", "value": {}}})],  # noqa: ARG001
    here: Here,
) -> Response:
    """Good for one socket within seconds: its first message is `{"type": "auth", "ticket": "..."}`.

    Only needed where the service has a key; the key itself may be sent as `key` in its place.
    """
    value = {"ticket": here.guard.tickets.issue(), "good_for_s": GOOD_FOR_S}
    return json_response(value, headers={"Cache-Control": "no-store"})
