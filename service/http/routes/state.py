"""What there is to see of a session: `state`, `decisions`, `events`, `recording`."""

from __future__ import annotations

from typing import Annotated

from anyio import to_thread
from fastapi import APIRouter, Path, Query, Response

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.contract.encode.state import state_json
from service.http.deps import Here, TheSession
from service.http.errors import documented, invalid
from service.http.responses import StrictRoute, etag, json_response
from service.http.session_json import told_runs
from service.problems import FieldProblem, Invalid, NotRestorable, NotSaved, UnknownDecision, UnknownSession
from service.sessions.persistence.recording import recording_json

router = APIRouter(tags=["watching"], route_class=StrictRoute)

_MOST = 2**53 - 1


@router.get(
    "/sessions/{session_id}/state",
    response_model=schemas.State,
    summary="The world at a tick",
    responses=documented(UnknownSession, Invalid, NotRestorable),
)
async def state(
    session: TheSession,
    tick: Annotated[int | None, Query(ge=0, le=_MOST, description="Default: now.")] = None,
) -> Response:
    """Everything on the road, the figures and the digest."""
    if tick is None or tick == session.timeline.tick:
        return json_response(session.state(), headers=etag(session.sequence))
    if tick > session.timeline.tick:
        raise invalid([FieldProblem("tick", f"has not come yet: it is tick {session.timeline.tick}")])
    standing = session.standing
    run = await to_thread.run_sync(session.timeline.copy().at, tick)
    return json_response(state_json(standing, run), headers=etag(standing.sequence))


@router.get(
    "/sessions/{session_id}/decisions",
    response_model=schemas.DecisionPage,
    summary="What was decided, and why",
    responses=documented(UnknownSession, Invalid, NotRestorable),
)
async def decisions(
    session: TheSession,
    after: Annotated[
        int | None, Query(ge=-1, le=_MOST, description="Tick to go on after; default: the newest.")
    ] = None,
    limit: Annotated[int, Query(ge=1, le=200)] = 20,
) -> Response:
    """Each with its whole trace: every move's verdict, cost, reason and causes."""
    timeline = session.timeline.copy()
    first = max(0, timeline.tick - limit) if after is None else min(after + 1, timeline.tick)
    stop = min(timeline.tick, first + limit)
    items = await to_thread.run_sync(told_runs, session.words, timeline, first, stop)
    return json_response({"items": items, "after": stop - 1, "more": stop < timeline.tick})


@router.get(
    "/sessions/{session_id}/decisions/{tick}",
    response_model=schemas.Decision,
    summary="One decision",
    responses=documented(UnknownSession, UnknownDecision, Invalid, NotRestorable),
)
async def decision(session: TheSession, tick: Annotated[int, Path(ge=0, le=_MOST)]) -> Response:
    """The decision taken in the world of a tick."""
    timeline = session.timeline.copy()
    if tick >= timeline.tick:
        raise UnknownDecision(f"Tick {tick} has not been decided yet: it is tick {timeline.tick}.")
    items = await to_thread.run_sync(told_runs, session.words, timeline, tick, tick + 1)
    if not items:
        raise UnknownDecision(f"At tick {tick} the result of an episode stood; nothing was decided.")
    return json_response(items[0])


@router.get(
    "/sessions/{session_id}/events",
    response_model=schemas.EventPage,
    summary="The log",
    responses=documented(UnknownSession, Invalid, NotRestorable),
)
async def events(
    session: TheSession,
    after: Annotated[
        int | None, Query(ge=0, le=_MOST, description="Line to go on after; default: the newest.")
    ] = None,
    limit: Annotated[int, Query(ge=1, le=400)] = 100,
) -> Response:
    """What happened, in numbered lines; the latest few hundred are kept."""
    log = session.log
    items = log.latest(limit) if after is None else log.after(after, limit)
    last = items[-1].number if items else min(after or 0, log.last)
    return json_response(
        {"items": items, "after": last, "more": last < log.last, "first_kept": log.first_kept}
    )


@router.get(
    "/sessions/{session_id}/recording",
    response_model=bodies.Recording,
    summary="The whole session as one file",
    responses=documented(UnknownSession, NotRestorable, NotSaved),
)
async def recording(session: TheSession, here: Here) -> Response:
    """Send it as `recording` to `POST /sessions`, here or elsewhere, and it replays to the same digest."""
    entries = await here.manager.entries(session)
    headers = {"Content-Disposition": f'attachment; filename="roadtalk-{session.id}.json"'}
    return json_response(recording_json(session, entries), headers=headers)
