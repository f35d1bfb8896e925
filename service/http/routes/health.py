"""Health checks, at the root: `/healthz` (alive) and `/readyz` (ready to serve). Open to all."""

from __future__ import annotations

from fastapi import APIRouter, Response

from service.contract import answers as schemas
from service.http.deps import Here
from service.http.errors import problem_responses
from service.http.responses import json_response
from service.http.route import operation_id
from service.problems import NotSaved
from service.version import VERSION

router = APIRouter(tags=["operating"], generate_unique_id_function=operation_id)


@router.get("/healthz", response_model=schemas.Health, summary="Alive, and how punctual")
async def read_health(here: Here) -> Response:
    """Answers as long as the service runs; tells how late its latest ticks were."""
    return json_response(
        {
            "status": "ok",
            "version": VERSION,
            "sessions": here.manager.live_count,
            "watchers": here.manager.subscriber_count,
            "tick_lateness": here.clock.lateness(),
            "shards": [],
        }
    )


@router.get(
    "/readyz", response_model=schemas.Ready, summary="Ready to serve", responses=problem_responses(NotSaved)
)
async def read_readiness(here: Here) -> Response:
    """Whether the store answers."""
    await here.store.newest(1)
    return json_response({"status": "ready"})
