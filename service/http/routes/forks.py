"""Time walked from outside: `forks`, `rewind`, `saved`."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Query, Request, Response

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.conditional.etag import TheTerms, kept_answer, made_once
from service.http.deps import JSON_ONLY, Here, TheSession
from service.http.errors import documented
from service.http.outcome_json import result_json
from service.http.responses import StrictRoute, etag, json_response
from service.http.session_json import links_json, session_json
from service.problems import (
    DoesNotFit,
    Invalid,
    Malformed,
    NotAvailable,
    NothingToUndo,
    NotJson,
    NotRestorable,
    NotSaved,
    TooLarge,
    TooManySessions,
    UnknownName,
    UnknownSession,
)
from service.sessions.rewind import to_tick
from service.sessions.session import Session
from service.sessions.utterance import Outcome

router = APIRouter(tags=["time"], route_class=StrictRoute)

_ALWAYS = (Malformed, UnknownSession, TooLarge, NotJson, Invalid, NotRestorable, NotSaved)


@router.post(
    "/sessions/{session_id}/forks",
    status_code=201,
    response_model=schemas.Session,
    summary="Go another way from a tick",
    dependencies=[JSON_ONLY],
    responses=documented(*_ALWAYS, DoesNotFit, NotAvailable, NothingToUndo, UnknownName, TooManySessions),
)
async def fork(
    body: Annotated[bodies.NewFork, Body(openapi_examples=examples.FORK)],
    session: TheSession,
    here: Here,
    request: Request,
) -> Response:
    """A new session that is the same to the bit up to a tick, and then changed; this one stays as it is.

    What was undone here is not in it. It plays where this one plays, unless `paused` says otherwise.
    """

    @made_once
    def told(made: Session) -> Response:
        headers = {"Location": links_json(made.id)["self"], **etag(made.sequence)}
        sentence = here.listener.sentence(made.run.config, made.language)
        return json_response(session_json(made, sentence), 201, headers)

    made = await here.manager.fork(
        session,
        body.at_tick,
        tuple(body.actions or ()),
        name=body.name,
        paused=body.paused,
        answer=kept_answer(request, told),
    )
    return told(made)


@router.post(
    "/sessions/{session_id}/rewind",
    response_model=schemas.CommandResult,
    summary="Go back to a tick",
    dependencies=[JSON_ONLY],
    responses=documented(*_ALWAYS),
)
async def rewind(
    body: Annotated[bodies.RewindTo, Body(openapi_examples=examples.REWIND)],
    session: TheSession,
    terms: TheTerms,
) -> Response:
    """A past tick becomes the present, as it was after what was said at it; one undo brings all back."""

    @made_once
    def told(outcome: Outcome) -> Response:
        return json_response(result_json(outcome, None, False), headers=etag(outcome.sequence))

    return told(await session.change(to_tick(body.tick, session.language), terms=terms(told)))


@router.get(
    "/saved",
    response_model=schemas.MomentPage,
    summary="Moments with a name, of all sessions",
    responses=documented(Invalid, NotSaved),
)
async def all_saved(
    here: Here,
    after: Annotated[
        str | None, Query(pattern=r"^[0-9]{1,15}$", description="`after` of the page before.")
    ] = None,
    limit: Annotated[int, Query(ge=1, le=200)] = 50,
) -> Response:
    """Those named last first, in pages. A name belongs to its session: `load` finds it there only."""
    found = await here.manager.moments(limit + 1, int(after) if after else None)
    page = found[:limit]
    items = [
        {
            "name": each.name,
            "session": each.session,
            "session_name": each.session_name,
            "sequence": each.sequence,
            "tick": each.tick,
            "links": links_json(each.session),
        }
        for each in page
    ]
    last = str(page[-1].number) if page else None
    return json_response({"items": items, "after": last, "more": len(found) > limit})


@router.get(
    "/sessions/{session_id}/saved",
    response_model=schemas.SavedMoments,
    summary="Moments with a name",
    responses=documented(UnknownSession, NotRestorable),
)
async def saved(session: TheSession) -> Response:
    """What `{"do": "save", "name": ...}` has kept, by name; `{"do": "load", "name": ...}` goes there."""
    moments = sorted(session.history.saved.values(), key=lambda moment: moment.name)
    items = [{"name": each.name, "sequence": each.sequence, "tick": each.tick} for each in moments]
    return json_response({"items": items}, headers=etag(session.sequence))
