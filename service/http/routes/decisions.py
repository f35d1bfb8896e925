"""`/sessions/{id}/decisions`: what was decided at each tick, and why."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Path, Query, Response

from service.contract import answers as schemas
from service.http.deps import Context, Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import json_response
from service.http.route import api_router
from service.http.session_json import told_runs
from service.http.work import run_on_timeline
from service.problems import Invalid, NotRestorable, UnknownDecision, UnknownSession
from service.sessions.session import Session
from sim.session.timeline import Timeline

router = api_router("watching")


@router.get(
    "/sessions/{session_id}/decisions",
    response_model=schemas.DecisionPage,
    summary="What was decided, and why",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def list_decisions(
    session: TheSession,
    here: Here,
    after: Annotated[
        int | None, Query(ge=-1, le=MAX_INTEGER, description="Tick to go on after; default: the newest.")
    ] = None,
    limit: Annotated[int, Query(ge=1, le=200)] = 20,
) -> Response:
    """Each with its whole trace: every move's verdict, cost, reason and causes."""
    timeline = session.timeline.copy()
    first = max(0, timeline.tick - limit) if after is None else min(after + 1, timeline.tick)
    stop = min(timeline.tick, first + limit)
    items = await _told(here, session, timeline, first, stop)
    return json_response({"items": items, "after": stop - 1, "more": stop < timeline.tick})


@router.get(
    "/sessions/{session_id}/decisions/{tick}",
    response_model=schemas.Decision,
    summary="One decision",
    responses=problem_responses(UnknownSession, UnknownDecision, Invalid, NotRestorable),
)
async def read_decision(
    session: TheSession, here: Here, tick: Annotated[int, Path(ge=0, le=MAX_INTEGER)]
) -> Response:
    """The decision taken in the world of a tick."""
    timeline = session.timeline.copy()
    if tick >= timeline.tick:
        raise UnknownDecision(f"Tick {tick} has not been decided yet: it is tick {timeline.tick}.")
    items = await _told(here, session, timeline, tick, tick + 1)
    if not items:
        raise UnknownDecision(f"At tick {tick} the result of an episode stood; nothing was decided.")
    return json_response(items[0])


async def _told(
    here: Context, session: Session, timeline: Timeline, first: int, stop: int
) -> list[dict[str, Any]]:
    ticks = stop - first + timeline.work_to(first)
    return await run_on_timeline(here, timeline, ticks, told_runs, session.narrator, timeline, first, stop)
