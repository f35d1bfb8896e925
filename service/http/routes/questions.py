"""`/sessions/{id}/ask`: questions, which change nothing."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Response

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.content_type import JSON_ONLY
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.http.ticks import check_tick
from service.problems import (
    Ambiguous,
    ContentTooLarge,
    Invalid,
    Malformed,
    NotAQuestion,
    NotAvailable,
    NotRestorable,
    NotUnderstood,
    UnknownSession,
    UnsupportedMediaType,
)

router = api_router("talking")


@router.post(
    "/sessions/{session_id}/ask",
    response_model=schemas.Answer,
    summary="Ask something",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed,
        UnknownSession,
        ContentTooLarge,
        UnsupportedMediaType,
        Invalid,
        NotRestorable,
        NotUnderstood,
        Ambiguous,
        NotAvailable,
        NotAQuestion,
    ),
)
@policy(direct=True, timed=True, idempotency_key=False)
async def ask_question(
    body: Annotated[bodies.Question, Body(openapi_examples=examples.QUESTION)],
    session: TheSession,
    here: Here,
) -> Response:
    """Answers, and changes nothing."""
    check_tick(body.at_tick, session.timeline.tick, "at_tick")
    heard = await here.interpreter.interpret_question(body.question, session, body.language, body.at_tick)
    outcome = await here.interpreter.execute(session, heard.utterance)
    return json_response(outcome.answer, headers=etag(outcome.sequence))
