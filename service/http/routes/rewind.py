"""`/sessions/{id}/rewind`: back to a past tick."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Response

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.conditional.etag import TheConditions, respond_once
from service.http.content_type import JSON_ONLY
from service.http.deps import TheSession
from service.http.errors import problem_responses
from service.http.outcome_json import result_json
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.problems import (
    ContentTooLarge,
    Invalid,
    Malformed,
    NotRestorable,
    NotSaved,
    UnknownSession,
    UnsupportedMediaType,
)
from service.sessions.rewind import rewind_to
from service.sessions.utterance import Outcome

router = api_router("time")


@router.post(
    "/sessions/{session_id}/rewind",
    response_model=schemas.CommandResult,
    summary="Go back to a tick",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed, UnknownSession, ContentTooLarge, UnsupportedMediaType, Invalid, NotRestorable, NotSaved
    ),
)
async def rewind_session(
    body: Annotated[bodies.RewindTo, Body(openapi_examples=examples.REWIND)],
    session: TheSession,
    conditions: TheConditions,
) -> Response:
    """A past tick becomes the present, as it was after what was said at it; one undo brings all back."""

    @respond_once
    def respond(outcome: Outcome) -> Response:
        return json_response(result_json(outcome, None, False), headers=etag(outcome.sequence))

    return respond(
        await session.change(rewind_to(body.tick, session.language), preconditions=conditions(respond))
    )
