"""`/sessions/{id}/forecast`: what the vehicle and the movers are about to do, as figures."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Query, Response

from service.contract.forecast import Expected
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import json_response
from service.http.route import api_router
from service.http.session_json import told_decision
from service.http.ticks import check_tick
from service.http.work import run_on_timeline
from service.problems import Invalid, NotRestorable, UnknownSession
from service.sessions.narrator_protocol import NarratorProtocol
from sim.decide import sense
from sim.forecast import predict
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Cell, Outcome

router = api_router("watching")

MOST_AHEAD = 16
"""Ticks that are forecast at most."""

Ahead = Annotated[int, Query(ge=1, le=MOST_AHEAD, description="How far ahead.")]
PathTicks = Annotated[
    int, Query(ge=0, le=MOST_AHEAD, description="Over how many ticks the vehicle's own path is driven ahead.")
]


@router.get(
    "/sessions/{session_id}/forecast",
    response_model=Expected,
    summary="What is about to happen",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def read_forecast(
    session: TheSession,
    here: Here,
    ticks: Ahead = 1,
    tick: Annotated[
        int | None, Query(ge=0, le=MAX_INTEGER, description="At an earlier tick than now.")
    ] = None,
    path: PathTicks = 0,
) -> Response:
    """What the vehicle decides at a tick, and the movers rolled out from there as the planners see it.

    Their first tick is exact; later ones suppose that nobody gives way to the vehicle or brakes for it.
    """
    way = session.timeline.copy()
    if tick is not None:
        check_tick(tick, way.tick)
    ticks_to = path + (1 if tick is None else 1 + way.work_to(tick))
    value = await run_on_timeline(here, way, ticks_to, _expect, session.narrator, way, tick, ticks, path)
    return json_response(value)


def _expect(
    narrator: NarratorProtocol, way: Timeline, tick: int | None, ticks: int, path: int
) -> dict[str, Any]:
    run = way.state if tick is None else way.at(tick)
    step = way.taken(run)
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
    value = None if decision is None else told_decision(narrator, run, decision)
    exact = ticks == 1 or not run.config.reacting
    told = {"tick": now, "decision": value, "exact": exact, "ahead": ahead}
    return told | {"path": _drive_on(run, path)} if path else told


def _drive_on(run: SimState, ticks: int) -> list[Cell]:
    """The first ego's cells in the ticks to come, until its episode ends."""
    cells = []
    for _ in range(ticks):
        if run.world.outcome is not Outcome.RUNNING:
            break
        run = step(run).state
        cells.append(run.world.road.cell(run.world.avs[0]))
    return cells
