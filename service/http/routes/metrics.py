"""`/metrics`, at the root: the figures of `service.http.metrics` for Prometheus."""

from __future__ import annotations

from fastapi import APIRouter, Response
from fastapi.responses import PlainTextResponse
from prometheus_client.exposition import CONTENT_TYPE_LATEST, generate_latest

from service.http.deps import Here
from service.http.route import GuardedRoute, operation_id

router = APIRouter(tags=["operating"], route_class=GuardedRoute, generate_unique_id_function=operation_id)


@router.get("/metrics", response_class=PlainTextResponse, summary="Figures for Prometheus")
async def read_metrics(here: Here) -> Response:
    """Sessions and streams, lateness of ticks, time of commands and of the store, refusals by kind."""
    return Response(generate_latest(here.metrics.registry), media_type=CONTENT_TYPE_LATEST)
