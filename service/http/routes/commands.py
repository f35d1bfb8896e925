"""What is said and done to a session: `commands`, `actions`, `step`, `ask`."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from fastapi import APIRouter, Body, Response

from service import actions as contract
from service.contract import answers as schemas
from service.contract import requests as bodies
from service.contract.encode.state import state_json
from service.http import examples
from service.http.conditional.etag import TheTerms, made_once
from service.http.deps import JSON_ONLY, Here, TheSession
from service.http.errors import documented
from service.http.outcome_json import result_json
from service.http.responses import StrictRoute, etag, json_response
from service.http.session_json import told_decision
from service.problems import (
    Ambiguous,
    DoesNotFit,
    Invalid,
    Malformed,
    NotAQuestion,
    NotAvailable,
    NothingToUndo,
    NotJson,
    NotRestorable,
    NotSaved,
    NotTeachable,
    NotUnderstood,
    TooLarge,
    UnknownSession,
)
from service.sessions.utterance import Outcome, Utterance

router = APIRouter(tags=["talking"], route_class=StrictRoute, dependencies=[JSON_ONLY])

_ALWAYS = (Malformed, UnknownSession, TooLarge, NotJson, Invalid, NotRestorable)
_CHANGING = (*_ALWAYS, DoesNotFit, NotAvailable, NothingToUndo, NotTeachable, NotSaved)


@router.post(
    "/sessions/{session_id}/commands",
    response_model=schemas.CommandResult,
    summary="Say something",
    responses=documented(*_CHANGING, NotUnderstood, Ambiguous),
)
async def say(
    body: Annotated[bodies.Said, Body(openapi_examples=examples.SAID)],
    session: TheSession,
    here: Here,
    terms: TheTerms,
) -> Response:
    """Done as a whole or not at all; one undo takes the whole back.

    A word that is not understood refuses it all, and says which.
    """
    heard = await here.listener.hear(body.text, session, body.language)

    @made_once
    def told(outcome: Outcome) -> Response:
        return json_response(result_json(outcome, heard, body.dry_run), headers=etag(outcome.sequence))

    return told(await here.listener.do(session, heard.utterance, dry_run=body.dry_run, terms=terms(told)))


@router.post(
    "/sessions/{session_id}/actions",
    response_model=schemas.CommandResult,
    summary="Do typed actions",
    responses=documented(*_CHANGING),
)
async def act(
    body: Annotated[bodies.TypedActions, Body(openapi_examples=examples.ACTIONS)],
    session: TheSession,
    here: Here,
    terms: TheTerms,
) -> Response:
    """The same as saying it, without language."""

    @made_once
    def told(outcome: Outcome) -> Response:
        return json_response(result_json(outcome, None, body.dry_run), headers=etag(outcome.sequence))

    utterance = Utterance(actions=tuple(body.actions))
    return told(await here.listener.do(session, utterance, dry_run=body.dry_run, terms=terms(told)))


@router.post(
    "/sessions/{session_id}/step",
    response_model=schemas.StepResult,
    summary="Run some ticks",
    responses=documented(*_ALWAYS, NotSaved),
)
async def step(
    body: Annotated[bodies.StepTicks, Body(openapi_examples=examples.STEP)],
    session: TheSession,
    here: Here,  # noqa: ARG001 -- all of these routes are called alike
    terms: TheTerms,
) -> Response:
    """Pauses, then runs the ticks as fast as it can; answers what was decided in each."""

    @made_once
    def told(outcome: Outcome) -> Response:
        assert outcome.before is not None
        runs = [outcome.before, *(tick.state for tick in outcome.ticks)]
        standing = replace(session.standing, paused=True, sequence=outcome.sequence)
        state = state_json(standing, runs[-1])
        decisions = [
            told_decision(session.words, run, tick.decision)
            for run, tick in zip(runs, outcome.ticks, strict=False)
            if tick.decision is not None
        ]
        return json_response(
            {"ticks": body.ticks, "decisions": decisions, "state": state},
            headers=etag(outcome.sequence),
        )

    utterance = Utterance(actions=(contract.Step(ticks=body.ticks),))
    return told(await session.change(utterance, terms=terms(told)))


@router.post(
    "/sessions/{session_id}/ask",
    response_model=schemas.Answer,
    summary="Ask something",
    responses=documented(*_ALWAYS, NotUnderstood, Ambiguous, NotAvailable, NotAQuestion),
)
async def ask(
    body: Annotated[bodies.Question, Body(openapi_examples=examples.QUESTION)],
    session: TheSession,
    here: Here,
) -> Response:
    """Answers, and changes nothing."""
    heard = await here.listener.hear_question(body.question, session, body.language)
    outcome = await here.listener.do(session, heard.utterance)
    return json_response(outcome.answer, headers=etag(outcome.sequence))
