"""`/sessions/{id}/moments`: several worlds in a row, for dragging along a timeline."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

from fastapi import Query, Response

from service.contract.encode.json import encoded
from service.contract.encode.state import SessionStatus, state_json
from service.contract.timeline import Moments
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.route import api_router
from service.http.session_json import told_decision
from service.http.ticks import check_tick
from service.http.work import run_on_timeline
from service.problems import Invalid, NotRestorable, UnknownSession
from service.sessions.narrator_protocol import NarratorProtocol
from sim.session.timeline import Timeline
from sim.state import SimState

router = api_router("time")

MOST_MOMENTS = 64
"""Worlds in a page."""


@router.get(
    "/sessions/{session_id}/moments",
    response_model=Moments,
    summary="Several ticks in full",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def list_moments(
    session: TheSession,
    here: Here,
    first: Annotated[int, Query(alias="from", ge=0, le=MAX_INTEGER, description="First tick.")] = 0,
    limit: Annotated[int, Query(ge=1, le=MOST_MOMENTS)] = 16,
) -> Response:
    """Worlds in a row, each with the decision that led to it, as a reader of the stream had them."""
    way, status = session.timeline.copy(), session.status
    check_tick(first, way.tick, "from")
    stop = min(way.tick + 1, first + limit)
    ticks = stop - first + way.work_to(first)
    page = await run_on_timeline(here, way, ticks, _page, session.narrator, status, way, first, stop)
    return Response(page, media_type="application/json")


def _page(narrator: NarratorProtocol, status: SessionStatus, way: Timeline, first: int, stop: int) -> bytes:
    """The page as JSON text: of large roads it has megabytes."""
    return encoded({"items": list(_moments(narrator, status, way, first, stop)), "now": way.tick})


def _moments(
    narrator: NarratorProtocol, status: SessionStatus, way: Timeline, first: int, stop: int
) -> Iterator[dict[str, Any]]:
    before: SimState | None = None
    for run in way.between(max(0, first - 1), stop):
        if run.world.tick >= first:
            decision = None if before is None else way.decided(before)
            value = None
            if before is not None and decision is not None:
                value = told_decision(narrator, before, decision)
            yield {"state": state_json(status, run), "decision": value}
        before = run
