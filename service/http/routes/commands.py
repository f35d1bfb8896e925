"""`/sessions/{id}/commands` and `/actions`: changes in words, and the same as typed actions."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Response

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.conditional.etag import TheConditions, respond_once
from service.http.content_type import JSON_ONLY
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.outcome_json import result_json
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.http.ticks import check_tick
from service.problems import (
    Ambiguous,
    ContentTooLarge,
    DoesNotFit,
    Invalid,
    Malformed,
    NotAvailable,
    NothingToUndo,
    NotRestorable,
    NotSaved,
    NotTeachable,
    NotUnderstood,
    UnknownSession,
    UnsupportedMediaType,
)
from service.sessions.utterance import Outcome, Utterance

router = api_router("talking", dependencies=[JSON_ONLY])

_PROBLEMS = (
    Malformed,
    UnknownSession,
    ContentTooLarge,
    UnsupportedMediaType,
    Invalid,
    NotRestorable,
    DoesNotFit,
    NotAvailable,
    NothingToUndo,
    NotTeachable,
    NotSaved,
)


@router.post(
    "/sessions/{session_id}/commands",
    response_model=schemas.CommandResult,
    summary="Say something",
    responses=problem_responses(*_PROBLEMS, NotUnderstood, Ambiguous),
)
@policy(direct=True, timed=True)
async def run_command(
    body: Annotated[bodies.Said, Body(openapi_examples=examples.SAID)],
    session: TheSession,
    here: Here,
    conditions: TheConditions,
) -> Response:
    """Done as a whole or not at all; one undo takes the whole back.

    A word that is not understood refuses it all, and says which.
    """
    check_tick(body.at_tick, session.timeline.tick, "at_tick")
    heard = await here.interpreter.interpret(
        body.text, session, body.language, asks=not body.dry_run, at_tick=body.at_tick
    )

    @respond_once
    def respond(outcome: Outcome) -> Response:
        return json_response(result_json(outcome, heard, body.dry_run), headers=etag(outcome.sequence))

    return respond(
        await here.interpreter.execute(
            session,
            heard.utterance,
            dry_run=body.dry_run,
            preconditions=conditions(respond),
        )
    )


@router.post(
    "/sessions/{session_id}/actions",
    response_model=schemas.CommandResult,
    summary="Do typed actions",
    responses=problem_responses(*_PROBLEMS),
)
@policy(direct=True, timed=True)
async def run_actions(
    body: Annotated[bodies.TypedActions, Body(openapi_examples=examples.ACTIONS)],
    session: TheSession,
    here: Here,
    conditions: TheConditions,
) -> Response:
    """The same as saying it, without language."""

    @respond_once
    def respond(outcome: Outcome) -> Response:
        return json_response(result_json(outcome, None, body.dry_run), headers=etag(outcome.sequence))

    check_tick(body.at_tick, session.timeline.tick, "at_tick")
    utterance = Utterance(actions=tuple(body.actions), at_tick=body.at_tick)
    preconditions = conditions(respond)
    return respond(
        await here.interpreter.execute(session, utterance, dry_run=body.dry_run, preconditions=preconditions)
    )
