"""`/sessions/{id}/events`: the log of a session."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query, Response

from service.contract import answers as schemas
from service.http.deps import TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import json_response
from service.http.route import api_router
from service.problems import Invalid, NotRestorable, UnknownSession

router = api_router("watching")


@router.get(
    "/sessions/{session_id}/events",
    response_model=schemas.EventPage,
    summary="The log",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def list_events(
    session: TheSession,
    after: Annotated[
        int | None, Query(ge=0, le=MAX_INTEGER, description="Line to go on after; default: the newest.")
    ] = None,
    limit: Annotated[int, Query(ge=1, le=400)] = 100,
) -> Response:
    """What happened, in numbered lines; the latest few hundred are kept."""
    log = session.log
    items = log.latest(limit) if after is None else log.after(after, limit)
    last = items[-1].number if items else min(after or 0, log.last_number)
    return json_response(
        {"items": items, "after": last, "more": last < log.last_number, "first_kept": log.first_number}
    )
