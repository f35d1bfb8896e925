"""Metrics of one service for Prometheus: how late ticks are, how long commands and the store take, refusals.

Nothing is counted by session or by client, so the number of lines stays what it is.
`service.http.routes.metrics` is the route.
"""

from __future__ import annotations

import inspect
import time
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping
from itertools import accumulate
from typing import Any, Literal, cast

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, disable_created_metrics
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


class LatenessHistogram:
    """How late ticks are, for one thread.

    Every tick is observed. The library's histogram takes two locks for each, which live sessions pay for
    (`python -m bench.live`); only the clock's thread observes here.
    """

    __slots__ = ("_counts", "_sum_s")

    def __init__(self) -> None:
        self._counts = [0] * (len(LATENESS_S) + 1)
        self._sum_s = 0.0

    def observe(self, lateness_s: float) -> None:
        """Counts one tick."""
        self._counts[bisect_left(LATENESS_S, lateness_s)] += 1
        self._sum_s += lateness_s

    def collect(self) -> HistogramMetricFamily:
        """The counts, cumulative as Prometheus wants them."""
        bounds = [*map(str, LATENESS_S), "+Inf"]
        return HistogramMetricFamily(
            "roadtalk_tick_lateness_seconds",
            "From a tick's deadline to its start",
            buckets=list(zip(bounds, accumulate(self._counts), strict=True)),
            sum_value=self._sum_s,
        )


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
        self.lateness = LatenessHistogram()
        commands = Histogram(
            "roadtalk_command_seconds",
            "From a command to its answer",
            ("channel",),
            buckets=COMMAND_S,
            registry=registry,
        )
        parts = Histogram(
            "roadtalk_command_part_seconds",
            "Of it: the sentence read, done on a copy, kept",
            ("channel", "part"),
            buckets=COMMAND_S,
            registry=registry,
        )
        # Looked up once: finding a child by its labels takes longer than counting.
        self._commands = {channel: commands.labels(channel).observe for channel in CHANNELS}
        self._parts = {channel: _observe_parts(parts, channel) for channel in CHANNELS}
        self.store = Histogram(
            "roadtalk_store_seconds",
            "One call to the store, durable when it is done",
            buckets=STORE_S,
            registry=registry,
        )
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
        return CommandTimer(self._commands[channel], self._parts[channel])

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
        """What is counted elsewhere: snapshots by their keeper, lateness of ticks; called by the registry."""
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
        yield self.lateness.collect()


def _observe_parts(parts: Histogram, channel: Channel) -> Callable[[Part, float], None]:
    observe = {part: parts.labels(channel, part).observe for part in PARTS}
    return lambda part, seconds: observe[part](seconds)


class _TimedStore:
    """A store whose every call is timed; otherwise the store itself."""

    def __init__(self, store: Store, histogram: Histogram) -> None:
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


def time_store(store: Store, histogram: Histogram) -> Store:
    """The same store, with the time of each call observed."""
    return cast(Store, _TimedStore(store, histogram))
