"""`/sessions`: list, read, delete. `create_session` makes them."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Body, Request, Response

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http.conditional.etag import if_match
from service.http.content_type import JSON_ONLY
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import After, Limit, cursor, page_json
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.session_json import session_json, summary_json
from service.problems import (
    ContentTooLarge,
    Invalid,
    Malformed,
    NotRestorable,
    NotSaved,
    UnknownSession,
    UnsupportedMediaType,
)
from service.sessions.preconditions import Preconditions

router = api_router("sessions")

_NAMES: dict[str, Any] = {"name": {"summary": "Another name", "value": {"name": "Rush hour"}}}


@router.get(
    "/sessions",
    response_model=schemas.SessionPage,
    summary="List sessions",
    responses=problem_responses(Invalid, NotSaved),
)
async def list_sessions(here: Here, after: After = None, limit: Limit = 50) -> Response:
    """Newest first, in pages."""
    found = await here.manager.newest(limit + 1, cursor(after))
    return json_response(
        page_json(found, limit, lambda each: each[0].number, lambda each: summary_json(*each))
    )


@router.get(
    "/sessions/{session_id}",
    response_model=schemas.Session,
    summary="Look at a session",
    responses=problem_responses(UnknownSession, NotRestorable),
)
async def read_session(session: TheSession, here: Here) -> Response:
    """A session as it stands. One that is kept but not live is brought back, paused."""
    value = session_json(session, here.interpreter.sentence_for(session.run.config, session.language))
    return json_response(value, headers=etag(session.sequence))


@router.patch(
    "/sessions/{session_id}",
    response_model=schemas.Session,
    summary="Rename a session",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed, UnknownSession, ContentTooLarge, UnsupportedMediaType, Invalid, NotRestorable, NotSaved
    ),
)
async def rename_session(
    body: Annotated[bodies.NewName, Body(openapi_examples=_NAMES)], session_id: str, here: Here
) -> Response:
    """Give it another name; `null` takes it away. The road, its log and its clock stay as they are."""
    session = await here.manager.rename(session_id, body.name)
    value = session_json(session, here.interpreter.sentence_for(session.run.config, session.language))
    return json_response(value, headers=etag(session.sequence))


@router.delete(
    "/sessions/{session_id}",
    status_code=204,
    response_class=Response,
    summary="End a session",
    responses=problem_responses(UnknownSession, NotSaved),
)
async def delete_session(session_id: str, here: Here, request: Request) -> Response:
    """End it and forget it; whoever watches is told."""
    await here.manager.delete(session_id, Preconditions(if_match(request)))
    here.guard.quotas.release(session_id)
    return Response(status_code=204)
