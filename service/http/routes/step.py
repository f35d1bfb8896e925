"""`/sessions/{id}/step`: ticks as fast as they can be simulated."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from fastapi import Body, Response

from service import actions
from service.contract import answers as schemas
from service.contract import requests as bodies
from service.contract.encode.state import state_json
from service.http import examples
from service.http.conditional.etag import TheConditions, respond_once
from service.http.content_type import JSON_ONLY
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.http.session_json import told_decision
from service.problems import (
    ContentTooLarge,
    Invalid,
    Malformed,
    NotRestorable,
    NotSaved,
    UnknownSession,
    UnsupportedMediaType,
)
from service.sessions.change import MAX_STREAMED_TICKS
from service.sessions.utterance import Outcome, Utterance

router = api_router("talking")


@router.post(
    "/sessions/{session_id}/step",
    response_model=schemas.StepResult,
    summary="Run some ticks",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed, UnknownSession, ContentTooLarge, UnsupportedMediaType, Invalid, NotRestorable, NotSaved
    ),
)
@policy(direct=True, timed=True)
async def step_session(
    body: Annotated[bodies.StepTicks, Body(openapi_examples=examples.STEP)],
    session: TheSession,
    here: Here,
    conditions: TheConditions,
) -> Response:
    """Pauses, then runs the ticks as fast as it can; answers what was decided in each."""

    @respond_once
    def respond(outcome: Outcome) -> Response:
        assert outcome.before is not None
        runs = [outcome.before, *(tick.state for tick in outcome.ticks)]
        status = replace(session.status, paused=True, sequence=outcome.sequence)
        state = state_json(status, runs[-1])
        decisions = [
            told_decision(session.narrator, run, tick.decision)
            for run, tick in zip(runs, outcome.ticks, strict=False)
            if tick.decision is not None
        ]
        return json_response(
            {"ticks": body.ticks, "decisions": decisions, "state": state},
            headers=etag(outcome.sequence),
        )

    utterance = Utterance(actions=(actions.Step(ticks=body.ticks),))
    outcome = await session.change(utterance, preconditions=conditions(respond))
    if body.ticks <= MAX_STREAMED_TICKS:
        return respond(outcome)
    return await here.manager.work.in_thread(
        respond, outcome
    )  # a decision takes as long to tell as to encode
