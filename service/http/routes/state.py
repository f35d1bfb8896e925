"""`/sessions/{id}/state`: the world at a tick."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query, Response

from service.contract import answers as schemas
from service.contract.encode.state import state_json
from service.http.deps import TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.http.ticks import check_tick
from service.problems import Invalid, NotRestorable, UnknownSession

router = api_router("watching")


@router.get(
    "/sessions/{session_id}/state",
    response_model=schemas.State,
    summary="The world at a tick",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
@policy(direct=True)
async def read_state(
    session: TheSession,
    tick: Annotated[int | None, Query(ge=0, le=MAX_INTEGER, description="Default: now.")] = None,
) -> Response:
    """Everything on the road, the figures and the digest."""
    if tick is None or tick == session.timeline.tick:
        return Response(session.state_body(), headers=etag(session.sequence), media_type="application/json")
    check_tick(tick, session.timeline.tick)
    status = session.status
    way = session.timeline.copy()
    run = await session.services.work.in_thread(way.at, tick)
    return json_response(state_json(status, run), headers=etag(status.sequence))
