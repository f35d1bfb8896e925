"""`POST /sessions/{id}/counterfactual`: another run from a tick on, beside the real one, to be watched.

Nothing is made and nothing stored: the session and its clock go on untouched. What is otherwise is a move
that was not made, driven whatever it meets, or a change of the road. A fork does the same for keeps.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, cast

from fastapi import Body, Response
from pydantic import Field

from service.actions import Action
from service.actions.table import is_world_action
from service.contract.counterfactual import Counterfactual
from service.contract.encode.counterfactual import beside_json
from service.contract.encode.state import SessionStatus
from service.contract.model import Tick
from service.contract.requests import MAX_ACTIONS, Sent, Strictly
from service.http.content_type import JSON_ONLY
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.validation import invalid
from service.http.work import run_on_timeline
from service.problems import (
    ContentTooLarge,
    DoesNotFit,
    FieldProblem,
    Invalid,
    Malformed,
    NotAvailable,
    NotRestorable,
    UnknownSession,
    UnsupportedMediaType,
)
from service.refusals import refusals
from service.sessions.availability import refusal_of
from service.sessions.narrator_protocol import NarratorProtocol
from sim.actions import WorldAction
from sim.explain import QuestionError
from sim.explain.side_by_side import SideBySide, compare_change, compare_move, compare_planners, parting
from sim.session.errors import EditError
from sim.session.timeline import Timeline
from sim.types import Move

router = api_router("time")

MAX_TICKS = 500
"""Ticks of each run that are told at most; how it ends is told of the whole."""

EPISODE_TICKS = 100
"""Ticks that are decided for it, about: both runs go on to the end of their episode."""

_Otherwise = Move | list[WorldAction] | tuple[str, str]

_EXAMPLES: dict[str, Any] = {
    "move": {
        "summary": "Another move than the one made",
        "value": {"at_tick": 2, "move": "stay", "ticks": 40},
    },
    "planners": {
        "summary": "Two planners on the same road",
        "value": {"planners": ["rules", "astar"]},
    },
    "change": {
        "summary": "A change of the road, made now",
        "value": {"actions": [{"do": "remove", "kind": "everything", "count": "all"}]},
    },
}


class Otherwise(Sent):
    """What is otherwise, and from when: a move, actions or two planners, one of the three."""

    at_tick: Tick | None = Field(None, description="Default: now; of a move, the latest decision.")
    move: Literal["forward", "left", "right", "forward_left", "forward_right", "stay"] | None = Field(
        None, description="Driven whatever it meets; then the planner goes on."
    )
    actions: Strictly[list[Action]] | None = Field(
        None, min_length=1, max_length=MAX_ACTIONS, description="Done there, together or not at all."
    )
    planners: list[str] | None = Field(
        None,
        min_length=2,
        max_length=2,
        description="Two planners on this road; by default from where its episode began.",
    )
    ticks: int = Field(120, ge=1, le=MAX_TICKS, description="How many ticks of each are told at most.")


@router.post(
    "/sessions/{session_id}/counterfactual",
    response_model=Counterfactual,
    summary="Watch what would have been",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed,
        UnknownSession,
        ContentTooLarge,
        UnsupportedMediaType,
        Invalid,
        DoesNotFit,
        NotAvailable,
        NotRestorable,
    ),
)
async def run_counterfactual(
    body: Annotated[Otherwise, Body(openapi_examples=_EXAMPLES)], session: TheSession, here: Here
) -> Response:
    """Both runs from that tick on: where they begin, tick by tick what moved, and how each ends.

    Both are as if nothing more had been said, so they differ in this and nothing else. No session is made.
    """
    if sum(each is not None for each in (body.move, body.actions, body.planners)) != 1:
        raise invalid([FieldProblem("move", "say either a move, actions or two planners")])
    timeline, status = session.timeline.copy(), session.status
    if body.at_tick is not None:
        tick = body.at_tick
    elif body.planners is not None:
        tick = timeline.state.world.episode_start
    else:
        tick = timeline.tick if body.actions else max(0, timeline.tick - 1)
    actions = _world_actions(body.actions or [], session.language)

    otherwise: _Otherwise = actions
    if body.move is not None:
        otherwise = Move(body.move)
    elif body.planners is not None:
        otherwise = (body.planners[0], body.planners[1])
    try:
        value = await run_on_timeline(
            here,
            timeline,
            EPISODE_TICKS,
            _compare,
            session.narrator,
            status,
            timeline,
            tick,
            otherwise,
            body.ticks,
        )
    except QuestionError as error:
        field = "move" if error.code in ("off_road", "same_move") else "at_tick"
        sentence = refusals(session.language).beside(error.code, error.facts)
        raise invalid([FieldProblem(field, sentence)]) from error
    except EditError as error:
        kind = NotAvailable if error.category == "not-available" else DoesNotFit
        sentence = refusals(session.language).edit(error)
        field = "planners" if body.planners is not None else f"actions.{error.field}"
        raise kind(sentence, errors=[FieldProblem(field, sentence)]) from error
    return json_response(value, headers=etag(status.sequence))


def _compare(
    narrator: NarratorProtocol,
    status: SessionStatus,
    timeline: Timeline,
    tick: int,
    otherwise: _Otherwise,
    told: int,
) -> dict[str, Any]:
    if isinstance(otherwise, Move):
        compared = compare_move(timeline, tick, otherwise)
    elif isinstance(otherwise, tuple):
        compared = compare_planners(timeline, tick, otherwise)
    else:
        compared = compare_change(timeline, tick, otherwise)
    texts = narrator.side_by_side(compared)
    return beside_json(status, compared, told, texts, _parting(narrator, compared))


def _parting(narrator: NarratorProtocol, compared: SideBySide) -> dict[str, Any] | None:
    found = parting(compared)
    if found is None:
        return None
    one, first, other, second = found
    return {
        "tick": one.world.tick,
        "real": {"move": first.move, "text": narrator.decision(first, one)},
        "changed": {"move": second.move, "text": narrator.decision(second, other)},
    }


def _world_actions(actions: list[Action], language: str) -> list[WorldAction]:
    """The actions, if all of them change the road. Raises `NotAvailable` or `Invalid`."""
    changing: list[WorldAction] = []
    for position, action in enumerate(actions):
        sentence = refusal_of(action, language)
        if sentence is not None:
            raise NotAvailable(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
        if not is_world_action(action):
            raise invalid([FieldProblem(f"actions.{position}", "changes nothing on the road")])
        changing.append(cast(WorldAction, action))
    return changing
