"""`/sessions/{id}/percept`: what the vehicle sees, beside what is there."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Query, Response

from service.contract.percept import Sensed
from service.http.deps import TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import json_response
from service.http.route import api_router
from service.http.ticks import check_tick
from service.problems import Invalid, NotRestorable, UnknownSession
from service.sessions.scheduler.offload import QUESTION_S, run_in_thread
from sim.decide import sense
from sim.explain.misperception import misperception
from sim.perceive.sources import reporting_devices
from sim.session.timeline import Timeline

router = api_router("watching")


@router.get(
    "/sessions/{session_id}/percept",
    response_model=Sensed,
    summary="What the vehicle sees",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def read_percept(
    session: TheSession,
    tick: Annotated[
        int | None, Query(ge=0, le=MAX_INTEGER, description="At an earlier tick than now.")
    ] = None,
) -> Response:
    """What the sensor of the first ego shows at a tick, how sure it is, and what it makes up or misses.

    The planner is shown what is seen, and nothing else.
    """
    way = session.timeline.copy()
    if tick is not None:
        check_tick(tick, way.tick)
    return json_response(await run_in_thread(False, QUESTION_S, lambda: _percept_json(way, tick)))


def _percept_json(way: Timeline, tick: int | None) -> dict[str, Any]:
    run = way.state if tick is None else way.at(tick)
    config, percept, wrong = run.config, sense(run)[0], misperception(run)
    devices = reporting_devices(run.world, config, percept)
    made_up = {thing.id for thing in wrong.phantoms}
    return {
        "tick": run.world.tick,
        "sensor": config.sensor,
        "weather": config.weather,
        "time_of_day": config.time_of_day,
        "seen": [
            {
                "id": thing.id,
                "kind": thing.kind,
                "cell": thing.cell,
                "likelihood": percept.likelihoods.get(thing.id, 1.0),
                "sensors": devices.get(thing.id, ()),
                "real": thing.id not in made_up,
            }
            for thing in percept.things()
        ],
        "missed": [thing.id for thing in wrong.missed],
    }
