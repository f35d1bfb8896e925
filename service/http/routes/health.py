"""`/healthz` and `/readyz`, at the root: is it alive, is it ready to serve."""

from __future__ import annotations

from fastapi import APIRouter, Response

from service.contract import answers as schemas
from service.http.deps import Here
from service.http.errors import documented
from service.http.responses import json_response
from service.problems import NotSaved
from service.version import VERSION

router = APIRouter(tags=["operating"])


@router.get("/healthz", response_model=schemas.Health, summary="Alive, and how punctual")
async def healthz(here: Here) -> Response:
    """Answers as long as the service runs; tells how late its latest ticks were."""
    return json_response(
        {
            "status": "ok",
            "version": VERSION,
            "sessions": here.manager.live,
            "watchers": here.manager.watchers,
            "tick_lateness": here.clock.lateness(),
        }
    )


@router.get("/readyz", response_model=schemas.Ready, summary="Ready to serve", responses=documented(NotSaved))
async def readyz(here: Here) -> Response:
    """Whether the store answers."""
    await here.store.newest(1)
    return json_response({"status": "ready"})
