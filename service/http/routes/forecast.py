"""What is expected and what was lost: `forecast`, `regret`. Beside the live path, for who asks.

Leaves out the same in words (`/ask` about `next`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

from anyio import to_thread
from fastapi import APIRouter, Query, Response
from pydantic import Field

from service.contract.parts import Answered, CellPair, Decision
from service.contract.requests import Tick
from service.http.deps import TheSession
from service.http.errors import documented, invalid
from service.http.responses import StrictRoute, json_response
from service.http.session_json import told_decision
from service.problems import FieldProblem, Invalid, NotRestorable, UnknownSession
from service.sessions.scheduler.offload import QUESTION_S, asks_others, off_loop
from sim.decide import sense
from sim.forecast import predict
from sim.oracle.regret import regret
from sim.session.timeline import Timeline
from sim.state import EgoStep, SimState
from sim.types import Move

router = APIRouter(tags=["watching"], route_class=StrictRoute)

MOST_AHEAD = 16
"""Ticks that are foretold at most."""
MOST_JUDGED = 200
"""Decisions that are judged at most in one answer, each against the best that could have been done."""

_MOST = 2**53 - 1


class ExpectedTick(Answered):
    """Where movers are expected to be at a tick to come."""

    tick: Tick
    movers: dict[str, CellPair] = Field(description="Their cells, by id.")


class Expected(Answered):
    """What is expected at a tick: what the vehicle is about to do, and where the movers will be."""

    tick: Tick
    decision: Decision | None = Field(description="The decision taken at it; null where a result stands.")
    exact: bool = Field(
        description="Whether it is sure: false beyond the first tick where others react to the vehicle."
    )
    ahead: list[ExpectedTick]


class JudgedDecision(Answered):
    """A decision against the best that could have been done at its moment."""

    tick: Tick
    move: Move
    blocked: int = Field(description="How many of the six moves would have ended badly or off the road.")
    ticks: int | None = Field(description="Ticks lost; null where the goal is, or was, out of reach.")
    cost: int | None = Field(description="Cost lost, by the configuration's charges; null as for `ticks`.")
    lost: bool = Field(description="Whether the goal could be reached before the move, and not after it.")


class Judged(Answered):
    """Decisions in a row, each with its regret."""

    first: Tick = Field(alias="from")
    now: Tick = Field(description="The session's present tick.")
    items: list[JudgedDecision] = Field(description="None for ticks at which a result stood.")
    more: bool


@router.get(
    "/sessions/{session_id}/forecast",
    response_model=Expected,
    summary="What is about to happen",
    responses=documented(UnknownSession, Invalid, NotRestorable),
)
async def forecast(
    session: TheSession,
    ticks: Annotated[int, Query(ge=1, le=MOST_AHEAD, description="How far ahead.")] = 1,
    tick: Annotated[int | None, Query(ge=0, le=_MOST, description="At an earlier tick than now.")] = None,
) -> Response:
    """What the vehicle decides at a tick, and the movers rolled out from there as the planners see it.

    Their first tick is exact; later ones suppose that nobody gives way to the vehicle or brakes for it.
    """
    way = session.timeline.copy()
    if tick is not None and tick > way.tick:
        raise invalid([FieldProblem("tick", f"has not come yet: it is tick {way.tick}")])
    run, step = await off_loop(asks_others(way), QUESTION_S, lambda: _decided(way, tick))
    decision = None if step is None else step.decision
    expected = predict(sense(run)[0] if step is None else step.percept, ticks)
    if decision is not None:
        expected = expected.after(decision.move)
    road, now = run.world.road, run.world.tick
    ahead = [
        {
            "tick": now + each + 1,
            "movers": {name: road.cell(cell) for cell, name in expected.slices.movers(each).items()},
        }
        for each in range(ticks)
    ]
    told = None if decision is None else told_decision(session.words, run, decision)
    exact = ticks == 1 or not run.config.reacting
    return json_response({"tick": now, "decision": told, "exact": exact, "ahead": ahead})


@router.get(
    "/sessions/{session_id}/regret",
    response_model=Judged,
    summary="What decisions cost against the best",
    responses=documented(UnknownSession, Invalid, NotRestorable),
)
async def regrets(
    session: TheSession,
    first: Annotated[int, Query(alias="from", ge=0, le=_MOST, description="First tick.")] = 0,
    limit: Annotated[int, Query(ge=1, le=MOST_JUDGED)] = 60,
) -> Response:
    """Each decision against the optimum of its own moment, which is searched for here and now."""
    way = session.timeline.copy()
    if first > way.tick:
        raise invalid([FieldProblem("from", f"has not come yet: it is tick {way.tick}")])
    stop = min(way.tick, first + limit)
    items = await to_thread.run_sync(lambda: list(_judged(way, first, stop)))
    return json_response({"from": first, "now": way.tick, "items": items, "more": stop < way.tick})


def _judged(way: Timeline, first: int, stop: int) -> Iterator[dict[str, Any]]:
    for run in way.between(first, stop):
        decision = way.decided(run)
        if decision is None:
            continue
        loss = regret(run, decision.move)
        yield {
            "tick": run.world.tick,
            "move": decision.move,
            "blocked": sum(option.reason.blocks for option in decision.options),
            "ticks": loss.ticks,
            "cost": loss.cost,
            "lost": loss.lost,
        }


def _decided(way: Timeline, tick: int | None) -> tuple[SimState, EgoStep | None]:
    run = way.state if tick is None else way.at(tick)
    return run, way.taken(run)
