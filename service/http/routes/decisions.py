"""`/sessions/{id}/decisions`: what was decided at each tick, and why."""

from __future__ import annotations

from typing import Annotated

from anyio import to_thread
from fastapi import Path, Query, Response

from service.contract import answers as schemas
from service.http.deps import TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import json_response
from service.http.route import api_router
from service.http.session_json import told_runs
from service.problems import Invalid, NotRestorable, UnknownDecision, UnknownSession

router = api_router("watching")


@router.get(
    "/sessions/{session_id}/decisions",
    response_model=schemas.DecisionPage,
    summary="What was decided, and why",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def list_decisions(
    session: TheSession,
    after: Annotated[
        int | None, Query(ge=-1, le=MAX_INTEGER, description="Tick to go on after; default: the newest.")
    ] = None,
    limit: Annotated[int, Query(ge=1, le=200)] = 20,
) -> Response:
    """Each with its whole trace: every move's verdict, cost, reason and causes."""
    timeline = session.timeline.copy()
    first = max(0, timeline.tick - limit) if after is None else min(after + 1, timeline.tick)
    stop = min(timeline.tick, first + limit)
    items = await to_thread.run_sync(told_runs, session.narrator, timeline, first, stop)
    return json_response({"items": items, "after": stop - 1, "more": stop < timeline.tick})


@router.get(
    "/sessions/{session_id}/decisions/{tick}",
    response_model=schemas.Decision,
    summary="One decision",
    responses=problem_responses(UnknownSession, UnknownDecision, Invalid, NotRestorable),
)
async def read_decision(session: TheSession, tick: Annotated[int, Path(ge=0, le=MAX_INTEGER)]) -> Response:
    """The decision taken in the world of a tick."""
    timeline = session.timeline.copy()
    if tick >= timeline.tick:
        raise UnknownDecision(f"Tick {tick} has not been decided yet: it is tick {timeline.tick}.")
    items = await to_thread.run_sync(told_runs, session.narrator, timeline, tick, tick + 1)
    if not items:
        raise UnknownDecision(f"At tick {tick} the result of an episode stood; nothing was decided.")
    return json_response(items[0])
