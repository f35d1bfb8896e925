"""Metrics of one service for Prometheus: how late ticks are, how long commands and the store take, refusals.

Nothing is counted by session or by client, so the number of lines stays what it is.
`service.http.routes.metrics` is the route.
"""

from __future__ import annotations

import inspect
import time
from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate
from typing import Any, Literal, cast

from prometheus_client import CollectorRegistry, Counter, Gauge, disable_created_metrics
from prometheus_client.core import CounterMetricFamily, HistogramMetricFamily, Metric

from service.problems import KINDS
from service.server_timing import PARTS, Part, told_to
from service.sessions.manager import SessionManager
from service.sessions.persistence.snapshot_scheduler import SNAPSHOT_RESULTS
from service.store import Store
from service.work.executor import FATES

LATENESS_S = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1.0)
COMMAND_S = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5)
STORE_S = (0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.5, 1.0, 5.0)
"""Bounds of the buckets, in seconds."""

Channel = Literal["rest", "socket"]
CHANNELS: tuple[Channel, ...] = ("rest", "socket")

BackupFate = Literal["made", "failed"]
BACKUP_FATES: tuple[BackupFate, ...] = ("made", "failed")

_SLUGS = frozenset(kind.slug for kind in KINDS)

disable_created_metrics()  # type: ignore[no-untyped-call] # a second series for each, of no use here


class CommandTimer:
    """Times one command and its parts, from entering to leaving."""

    __slots__ = ("_began", "_observe", "_parts")

    def __init__(self, observe: Callable[[float], None], parts: Callable[[Part, float], None]) -> None:
        self._observe = observe
        self._parts = told_to(parts)

    def __enter__(self) -> None:
        self._began = time.perf_counter()
        self._parts.__enter__()

    def __exit__(self, *_: object) -> None:
        self._parts.__exit__()
        self._observe(time.perf_counter() - self._began)


class LoopHistogram:
    """A histogram that one thread observes: that of the event loop.

    The library's takes two locks and a comparison for each bucket, which each tick (`python -m bench.live`)
    and each command (`python -m bench.commands`) would pay for several times.
    """

    __slots__ = ("_bounds", "_counts", "_sum_s")

    def __init__(self, bounds_s: Sequence[float]) -> None:
        self._bounds = tuple(bounds_s)
        self._counts = [0] * (len(self._bounds) + 1)
        self._sum_s = 0.0

    def observe(self, seconds: float) -> None:
        """Counts one duration."""
        self._counts[bisect_left(self._bounds, seconds)] += 1
        self._sum_s += seconds

    def buckets(self) -> list[tuple[str, float]]:
        """The counts by their bounds, cumulative as Prometheus wants them."""
        return list(zip([*map(str, self._bounds), "+Inf"], accumulate(self._counts), strict=True))

    @property
    def sum_s(self) -> float:
        """All durations together."""
        return self._sum_s


def histogram_family(
    name: str, text: str, labels: Sequence[str], histograms: Iterable[tuple[tuple[str, ...], LoopHistogram]]
) -> HistogramMetricFamily:
    """Histograms of one name, by the values of their labels."""
    family = HistogramMetricFamily(name, text, labels=list(labels))
    for values, each in histograms:
        family.add_metric(list(values), each.buckets(), each.sum_s)
    return family


class Metrics:
    """The metrics of one service."""

    def __init__(self) -> None:
        self.registry = registry = CollectorRegistry()
        self._sessions = Gauge("roadtalk_sessions", "Live sessions", registry=registry)
        self._sleeping = Gauge(
            "roadtalk_sleeping_sessions",
            "Sessions kept and not live, which wake when asked for",
            registry=registry,
        )
        self._watchers = Gauge(
            "roadtalk_watchers", "Subscribers: open streams, sockets and events alike", registry=registry
        )
        self.lateness = LoopHistogram(LATENESS_S)
        self._commands = {channel: LoopHistogram(COMMAND_S) for channel in CHANNELS}
        self._parts = {(channel, part): LoopHistogram(COMMAND_S) for channel in CHANNELS for part in PARTS}
        self._observe_part = {channel: _observe_parts(self._parts, channel) for channel in CHANNELS}
        self.store = LoopHistogram(STORE_S)
        self._snapshots: Callable[[], Mapping[str, int]] = dict
        self._work: Callable[[], Mapping[str, int]] = dict
        self._work_running = Gauge(
            "roadtalk_work_running", "Dear requests that a worker process is at", registry=registry
        )
        self._work_waiting = Gauge(
            "roadtalk_work_waiting", "Dear requests that wait for a worker process", registry=registry
        )
        registry.register(cast(Any, self))
        refusals = Counter("roadtalk_refusals", "Problems answered over HTTP", ("kind",), registry=registry)
        self._expired = Counter(
            "roadtalk_expired_sessions", "Stored sessions deleted as unused", registry=registry
        )
        backups = Counter("roadtalk_backups", "Backups, by what became of them", ("fate",), registry=registry)
        self._backups = {fate: backups.labels(fate) for fate in BACKUP_FATES}
        self._refusals = {slug: refusals.labels(slug) for slug in sorted(_SLUGS)}

    def read_from(self, manager: SessionManager) -> None:
        """Sets where the gauges and the counts of snapshots are read."""
        self._sessions.set_function(lambda: manager.live_count)
        self._sleeping.set_function(lambda: manager.evicted_count)
        self._watchers.set_function(lambda: manager.subscriber_count)
        self._work_running.set_function(lambda: manager.work.queue.running)
        self._work_waiting.set_function(lambda: manager.work.queue.waiting)
        self._work = lambda: {fate: manager.work.fates[fate] for fate in FATES}
        self._snapshots = lambda: {fate: manager.snapshots.counts[fate] for fate in SNAPSHOT_RESULTS}

    def command(self, channel: Channel) -> CommandTimer:
        """Times a command that came by a channel, and its parts."""
        return CommandTimer(self._commands[channel].observe, self._observe_part[channel])

    def count_refusal(self, slug: str) -> None:
        """Counts a problem that is answered."""
        self._refusals[slug].inc()

    def count_expired(self) -> None:
        """Counts a session that was deleted because nobody had used it."""
        self._expired.inc()

    def count_backup(self, fate: BackupFate) -> None:
        """Counts a backup that was made, or was not."""
        self._backups[fate].inc()

    def collect(self) -> Iterator[Metric]:
        """What is counted elsewhere: snapshots by their keeper, and durations; called by the registry."""
        family = CounterMetricFamily(
            "roadtalk_snapshots", "Snapshots of sessions, by what became of them", labels=["fate"]
        )
        for fate, count in self._snapshots().items():
            family.add_metric([fate], count)
        yield family
        work = CounterMetricFamily("roadtalk_work", "Dear requests, by what became of them", labels=["fate"])
        for fate, count in self._work().items():
            work.add_metric([fate], count)
        yield work
        yield histogram_family(
            "roadtalk_tick_lateness_seconds", "From a tick's deadline to its start", (), [((), self.lateness)]
        )
        commands = [((channel,), each) for channel, each in self._commands.items()]
        yield histogram_family(
            "roadtalk_command_seconds", "From a command to its answer", ("channel",), commands
        )
        yield histogram_family(
            "roadtalk_command_part_seconds",
            "Of it: the sentence read, done on a copy, kept",
            ("channel", "part"),
            self._parts.items(),
        )
        yield histogram_family(
            "roadtalk_store_seconds", "One call to the store, durable when it is done", (), [((), self.store)]
        )


def _observe_parts(
    parts: Mapping[tuple[Channel, Part], LoopHistogram], channel: Channel
) -> Callable[[Part, float], None]:
    observe = {part: parts[channel, part].observe for part in PARTS}
    return lambda part, seconds: observe[part](seconds)


class _TimedStore:
    """A store whose every call is timed; otherwise the store itself."""

    def __init__(self, store: Store, histogram: LoopHistogram) -> None:
        self._store = store
        self._histogram = histogram

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._store, name)
        if not inspect.iscoroutinefunction(found):
            return found

        async def call(*args: Any, **named: Any) -> Any:
            began = time.perf_counter()
            try:
                return await found(*args, **named)
            finally:
                self._histogram.observe(time.perf_counter() - began)

        # Found without this method from now on.
        setattr(self, name, call)
        return call


def time_store(store: Store, histogram: LoopHistogram) -> Store:
    """The same store, with the time of each call observed."""
    return cast(Store, _TimedStore(store, histogram))
