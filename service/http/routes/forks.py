"""`/sessions/{id}/forks`: another session that is the same up to a tick."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Request, Response

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.conditional.etag import answer_to_keep, respond_once
from service.http.content_type import JSON_ONLY
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.session_json import links_json, session_json
from service.problems import (
    ContentTooLarge,
    DoesNotFit,
    Invalid,
    Malformed,
    NotAvailable,
    NothingToUndo,
    NotRestorable,
    NotSaved,
    QuotaExceeded,
    TooManySessions,
    UnknownName,
    UnknownSession,
    UnsupportedMediaType,
)
from service.security.guard import client_of
from service.sessions.session import Session

router = api_router("time")


@router.post(
    "/sessions/{session_id}/forks",
    status_code=201,
    response_model=schemas.Session,
    summary="Go another way from a tick",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed,
        UnknownSession,
        ContentTooLarge,
        UnsupportedMediaType,
        Invalid,
        NotRestorable,
        NotSaved,
        DoesNotFit,
        NotAvailable,
        NothingToUndo,
        UnknownName,
        TooManySessions,
        QuotaExceeded,
    ),
)
async def fork_session(
    body: Annotated[bodies.NewFork, Body(openapi_examples=examples.FORK)],
    session: TheSession,
    here: Here,
    request: Request,
) -> Response:
    """A new session that is the same to the bit up to a tick, and then changed; this one stays as it is.

    What was undone here is not in it. It plays where this one plays, unless `paused` says otherwise.
    """

    @respond_once
    def respond(made: Session) -> Response:
        headers = {"Location": links_json(made.id)["self"], **etag(made.sequence)}
        sentence = here.interpreter.sentence_for(made.run.config, made.language)
        return json_response(session_json(made, sentence), 201, headers)

    with here.guard.quotas.reserve(client_of(request.scope)) as reservation:
        made = await here.manager.fork(
            session,
            body.at_tick,
            tuple(body.actions or ()),
            name=body.name,
            paused=body.paused,
            answer=answer_to_keep(request, respond),
        )
        road = made.run.world.road
        reservation.use(made.id, road.columns * road.rows)
    return respond(made)
