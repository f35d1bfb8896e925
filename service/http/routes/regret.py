"""`/sessions/{id}/regret`: each decision against the optimum of its own moment."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot
from typing import Annotated, Any

from fastapi import Query, Request, Response

from service.contract.forecast import Judged
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.prefer import ACCEPTED, Prefer, respond_async
from service.http.responses import json_response
from service.http.route import api_router
from service.http.ticks import check_tick
from service.problems import Invalid, NotRestorable, UnknownSession
from service.work.progress import tell
from service.work.units import search_units
from sim.oracle.regret import regret
from sim.session.timeline import Timeline
from sim.state import SimState

router = api_router("watching")

MOST_JUDGED = 200
"""Decisions that are judged at most in one answer, each by a search."""

SEARCHES = 4
"""Searches that one decision takes to be judged: the decision itself, and what the best would have been."""


@router.get(
    "/sessions/{session_id}/regret",
    response_model=Judged,
    summary="What decisions cost against the best",
    responses=ACCEPTED | problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def read_regret(
    session: TheSession,
    here: Here,
    request: Request,
    first: Annotated[int, Query(alias="from", ge=0, le=MAX_INTEGER, description="First tick.")] = 0,
    limit: Annotated[int, Query(ge=1, le=MOST_JUDGED)] = 60,
    prefer: Prefer = None,  # noqa: ARG001
) -> Response:
    """Each decision against the optimum of its own moment, which is searched for here and now."""
    way = session.timeline.copy()
    check_tick(first, way.tick, "from")
    stop = min(way.tick, first + limit)
    units = (stop - first) * SEARCHES * search_units(way.state)

    async def make() -> Response:
        items = await here.manager.work.run(units, _judge_all, way, first, stop)
        return json_response({"from": first, "now": way.tick, "items": items, "more": stop < way.tick})

    return await respond_async(request, here, session.id, "regret", units, make)


def _judge_all(way: Timeline, first: int, stop: int) -> list[dict[str, Any]]:
    judged = []
    for each in _judge(way, first, stop):
        judged.append(each)
        tell((each["tick"] + 1 - first) / (stop - first))
    return judged


def _judge(way: Timeline, first: int, stop: int) -> Iterator[dict[str, Any]]:
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
            "clearance_m": _clearance_m(run),
        }


def _clearance_m(run: SimState) -> float | None:
    """How near the vehicle is to anything else, centre to centre [m]."""
    column, row = run.world.road.cell(run.world.av)
    apart = [hypot(thing.cell[0] - column, thing.cell[1] - row) for thing in run.world.things()]
    return round(min(apart) * run.config.cell_m, 2) if apart else None
