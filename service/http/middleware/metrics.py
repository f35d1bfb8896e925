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
from collections.abc import Awaitable, Callable, Iterator, Mapping, Sequence
from itertools import accumulate
from typing import Any, Literal, cast

import orjson
from fastapi import APIRouter, Request, Response
from fastapi.responses import PlainTextResponse
from prometheus_client import CollectorRegistry
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily, Metric
from prometheus_client.exposition import CONTENT_TYPE_LATEST, generate_latest
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.http.deps import context_of
from service.problems import KINDS, MEDIA_TYPE
from service.server_timing import PARTS, Part, told_to
from service.sessions.persistence.snapshot_scheduler import FATES
from service.store import Store

LATENESS_S = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1.0)
COMMAND_S = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5)
STORE_S = (0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.5, 1.0, 5.0)

Channel = Literal["rest", "socket"]
CHANNELS: tuple[Channel, ...] = ("rest", "socket")

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
        """As Prometheus has it."""
        return HistogramMetricFamily(name, documentation, buckets=self.buckets(), sum_value=self.sum_s)

    def buckets(self) -> list[tuple[str, int]]:
        """Each bound counts all up to it."""
        counts = accumulate(self._counts)
        return [(str(bound), total) for bound, total in zip((*self._bounds, "+Inf"), counts, strict=True)]

    @property
    def sum_s(self) -> float:
        """All of it together."""
        return self._sum


def _labelled(
    name: str, documentation: str, labels: tuple[str, ...], histograms: Mapping[Any, Histogram]
) -> Metric:
    family = HistogramMetricFamily(name, documentation, labels=labels)
    for values, histogram in histograms.items():
        family.add_metric(values, histogram.buckets(), histogram.sum_s)
    return family


class Command:
    """The time of one command, from entering to leaving."""

    __slots__ = ("_began", "_parts", "_whole")

    def __init__(self, whole: Histogram, parts: Callable[[Part, float], None]) -> None:
        self._whole = whole
        self._parts = told_to(parts)

    def __enter__(self) -> None:
        self._began = time.perf_counter()
        self._parts.__enter__()

    def __exit__(self, *_: object) -> None:
        self._parts.__exit__()
        self._whole.observe(time.perf_counter() - self._began)


class Metrics:
    """What one service counts."""

    def __init__(self) -> None:
        self.lateness = Histogram(LATENESS_S)
        self.commands = {(channel,): Histogram(COMMAND_S) for channel in CHANNELS}
        self.parts = {(channel, part): Histogram(COMMAND_S) for channel in CHANNELS for part in PARTS}
        self._observers = {channel: self._observer(channel) for channel in CHANNELS}
        self.store = Histogram(STORE_S)
        self.refusals: Counter[str] = Counter()

    def command(self, channel: Channel) -> Command:
        """Times a command that came by a channel, and its parts."""
        return Command(self.commands[channel,], self._observers[channel])

    def _observer(self, channel: Channel) -> Callable[[Part, float], None]:
        observed = {part: self.parts[channel, part].observe for part in PARTS}
        return lambda part, seconds: observed[part](seconds)

    def families(
        self, sessions: int, sleeping: int, watchers: int, snapshots: Mapping[str, int]
    ) -> Iterator[Metric]:
        """Everything, as it is now."""
        yield GaugeMetricFamily("roadtalk_sessions", "Live sessions", value=sessions)
        yield GaugeMetricFamily(
            "roadtalk_sleeping_sessions",
            "Sessions kept and not live, which wake when asked for",
            value=sleeping,
        )
        yield GaugeMetricFamily(
            "roadtalk_watchers", "Subscribers: open streams, sockets and events alike", value=watchers
        )
        yield self.lateness.family("roadtalk_tick_lateness_seconds", "From a tick's deadline to its start")
        yield _labelled(
            "roadtalk_command_seconds", "From a command to its answer", ("channel",), self.commands
        )
        yield _labelled(
            "roadtalk_command_part_seconds",
            "Of it: the sentence read, done on a copy, kept",
            ("channel", "part"),
            self.parts,
        )
        yield self.store.family("roadtalk_store_seconds", "One call to the store, durable when it is done")
        fates = CounterMetricFamily(
            "roadtalk_snapshots", "Snapshots of sessions, by what became of them", labels=["fate"]
        )
        for fate, count in snapshots.items():
            fates.add_metric([fate], count)
        yield fates
        refused = CounterMetricFamily("roadtalk_refusals", "Problems answered over HTTP", labels=["kind"])
        for kind in sorted(_SLUGS):
            refused.add_metric([kind], self.refusals[kind])
        yield refused


class Counted:
    """Times commands and counts refusals."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._app = app
        self._metrics = metrics

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> Awaitable[None]:
        """One connection."""
        if scope["type"] != "http":
            return self._app(scope, receive, send)
        refused = False

        def counting(message: Message) -> Awaitable[None]:
            nonlocal refused
            if message["type"] == "http.response.start":
                refused = message["status"] >= 400 and _is_problem(message["headers"])
            elif refused and message["type"] == "http.response.body":
                refused = False
                self._metrics.refusals[_kind(message.get("body", b""))] += 1
            return send(message)

        is_command = scope["method"] == "POST" and scope["path"].endswith(_COMMANDS)
        return (self._timed if is_command else self._app)(scope, receive, counting)

    async def _timed(self, scope: Scope, receive: Receive, send: Send) -> None:
        with self._metrics.command("rest"):
            await self._app(scope, receive, send)


def _is_problem(headers: Sequence[tuple[bytes, bytes]]) -> bool:
    return any(name == b"content-type" and value.startswith(MEDIA_TYPE.encode()) for name, value in headers)


def _kind(body: bytes) -> str:
    slug = str(orjson.loads(body)["type"]).removeprefix("/problems/")
    return slug if slug in _SLUGS else "internal"


def metrics_of(connection: HTTPConnection) -> Metrics:
    """What the service of a connection counts."""
    return cast(Metrics, connection.app.state.metrics)


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
    """Sessions and streams, lateness of ticks, time of commands and of the store, refusals by kind."""
    manager = context_of(request).manager
    counted = metrics_of(request)
    registry = CollectorRegistry(auto_describe=False)
    snapshots: dict[str, int] = {fate: manager.keeper.fates[fate] for fate in FATES}
    figures = counted.families(manager.live, manager.sleeping, manager.watchers, snapshots)
    registry.register(cast(Any, _Now(list(figures))))
    return Response(generate_latest(registry), media_type=CONTENT_TYPE_LATEST)
