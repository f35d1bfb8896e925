"""`/metrics` for Prometheus: how many, how late, how long, and what was refused.

Counting must cost next to nothing where it happens, thousands of times a second: a histogram here is a
list of whole numbers, made into Prometheus' own only when it is asked for. Nothing is counted by session
or by client, so the number of lines stays what it is.
"""

from __future__ import annotations

import inspect
import time
from bisect import bisect_left
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, cast

import orjson
from fastapi import APIRouter, Request, Response
from fastapi.responses import PlainTextResponse
from prometheus_client import CollectorRegistry
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily, Metric
from prometheus_client.exposition import CONTENT_TYPE_LATEST, generate_latest
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.api.context import context_of
from service.problems import KINDS, MEDIA_TYPE
from service.store import Store

LATENESS_S = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1.0)
COMMAND_S = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5)
STORE_S = (0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.5, 1.0, 5.0)

_COMMANDS = ("/commands", "/actions", "/step", "/ask")
_SLUGS = frozenset(kind.slug for kind in KINDS)

router = APIRouter(tags=["operating"])


class Histogram:
    """How often a time fell between which bounds."""

    __slots__ = ("_bounds", "_counts", "_sum")

    def __init__(self, bounds: Sequence[float]) -> None:
        self._bounds = bounds
        self._counts = [0] * (len(bounds) + 1)
        self._sum = 0.0

    def observe(self, seconds: float) -> None:
        """Count one more."""
        self._counts[bisect_left(self._bounds, seconds)] += 1
        self._sum += seconds

    def family(self, name: str, documentation: str) -> Metric:
        """As Prometheus has it: each bound counts all up to it."""
        buckets, total = [], 0
        for bound, count in zip((*self._bounds, "+Inf"), self._counts, strict=True):
            total += count
            buckets.append((str(bound), total))
        return HistogramMetricFamily(name, documentation, buckets=buckets, sum_value=self._sum)


class Metrics:
    """What one service counts."""

    def __init__(self) -> None:
        self.lateness = Histogram(LATENESS_S)
        self.commands = Histogram(COMMAND_S)
        self.store = Histogram(STORE_S)
        self.refusals: Counter[str] = Counter()

    def families(self, sessions: int, watchers: int) -> Iterator[Metric]:
        """Everything, as it is now."""
        yield GaugeMetricFamily("roadtalk_sessions", "Live sessions", value=sessions)
        yield GaugeMetricFamily("roadtalk_watchers", "Open streams", value=watchers)
        yield self.lateness.family("roadtalk_tick_lateness_seconds", "From a tick's deadline to its start")
        yield self.commands.family("roadtalk_command_seconds", "From a command, asked by HTTP, to its answer")
        yield self.store.family("roadtalk_store_seconds", "One call to the store, durable when it is done")
        refused = CounterMetricFamily("roadtalk_refusals", "Problems answered over HTTP", labels=["kind"])
        for kind in sorted(_SLUGS):
            refused.add_metric([kind], self.refusals[kind])
        yield refused


class Counted:
    """Times commands and counts refusals."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._app = app
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One connection."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        refused = False

        async def counting(message: Message) -> None:
            nonlocal refused
            if message["type"] == "http.response.start":
                refused = message["status"] >= 400 and _is_problem(message["headers"])
            elif refused and message["type"] == "http.response.body":
                refused = False
                self._metrics.refusals[_kind(message.get("body", b""))] += 1
            await send(message)

        began = time.perf_counter()
        try:
            await self._app(scope, receive, counting)
        finally:
            if scope["method"] == "POST" and scope["path"].endswith(_COMMANDS):
                self._metrics.commands.observe(time.perf_counter() - began)


def _is_problem(headers: Sequence[tuple[bytes, bytes]]) -> bool:
    return any(name == b"content-type" and value.startswith(MEDIA_TYPE.encode()) for name, value in headers)


def _kind(body: bytes) -> str:
    slug = str(orjson.loads(body)["type"]).removeprefix("/problems/")
    return slug if slug in _SLUGS else "internal"


class _Timed:
    """A store whose every call is timed; otherwise the store itself."""

    def __init__(self, store: Store, into: Histogram) -> None:
        self._store = store
        self._into = into

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._store, name)
        if not inspect.iscoroutinefunction(found):
            return found

        async def timed(*args: Any, **named: Any) -> Any:
            began = time.perf_counter()
            try:
                return await found(*args, **named)
            finally:
                self._into.observe(time.perf_counter() - began)

        # Found here from now on, without another look.
        setattr(self, name, timed)
        return timed


def timed(store: Store, into: Histogram) -> Store:
    """The same store, with the time of each call counted."""
    return cast(Store, _Timed(store, into))


class _Now:
    """Lets Prometheus' own writer read a service."""

    def __init__(self, families: Sequence[Metric]) -> None:
        self._families = families

    def collect(self) -> Iterator[Metric]:
        """What there is."""
        yield from self._families


@router.get("/metrics", response_class=PlainTextResponse, summary="Figures for Prometheus")
async def metrics(request: Request) -> Response:
    """Live sessions and streams, lateness of ticks, time of commands and of the store, refusals by kind."""
    manager = context_of(request).manager
    counted = cast(Metrics, request.app.state.metrics)
    registry = CollectorRegistry(auto_describe=False)
    registry.register(cast(Any, _Now(list(counted.families(manager.live, manager.watchers)))))
    return Response(generate_latest(registry), media_type=CONTENT_TYPE_LATEST)
