"""Live sessions, each watched by one socket: how late ticks are, what they cost, what is missed.

The service is the real command in a process of its own, with its file database; the clients are another, so
that their work is not the service's. Each session is simulated, its decision put into words, and all of it
sent. Lateness is the service's own measure, from a tick's deadline to its beginning, over all ticks of the
stretch that is measured; a delay is what a client sees: how much later than the session's steady pace a tick
arrives.

    python -m bench.live --sessions 200 --seconds 20
    python -m bench.live --write          # the whole table, into bench/LIVE.md
"""

from __future__ import annotations

import argparse
import asyncio
import gc
import re
import sys
import time
from array import array
from collections import defaultdict
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TypeVar

import httpx
import uvloop

from bench.serving import Service, machine, serving
from bench.sockets import opened
from tests.support import postgres
from tests.support.postgres import binaries

AT_ONCE = 40
"""Sessions asked for at the same time."""

SETTLE_S = 3.0
"""Between the last socket's opening and the beginning of what is measured."""

PROMISED_S = 0.02
"""Ticks later than this are too late."""

Done = TypeVar("Done")

RESULTS = Path(__file__).parent / "LIVE.md"
_TICK = b'{"type":"tick","tick":'
_BUCKET = re.compile(r'roadtalk_tick_lateness_seconds_bucket\{[^}]*le="([^"]+)"[^}]*\} ([\d.e+]+)')


@dataclass(frozen=True, slots=True)
class Load:
    """What is asked of the service."""

    sessions: int
    hz: float = 2.0
    hurried: int = 0
    """further sessions that run as fast as possible, watched too"""
    workers: int = 1
    """processes of the service; more than one have PostgreSQL for their database"""
    planner: str | None = None
    """None: that of new sessions"""

    def __str__(self) -> str:
        more = f" + {self.hurried} at max" if self.hurried else ""
        processes = f", {self.workers} workers" if self.workers > 1 else ""
        planner = f", {self.planner}" if self.planner is not None else ""
        return f"{self.sessions} at {self.hz:g} Hz{more}{processes}{planner}"


@dataclass(frozen=True, slots=True)
class Memory:
    """What the service held, in megabytes: at first, with all sessions, with all sockets, at last."""

    base_mb: float
    made_mb: float
    watched_mb: float
    last_mb: float

    def told(self, sessions: int) -> str:
        """A session that has begun to run, what its socket adds, and what both came to."""
        made, watched = self.made_mb - self.base_mb, self.watched_mb - self.made_mb
        parts = (made, watched, self.last_mb - self.base_mb)
        return " | ".join(f"{1e3 * part / sessions:.0f} kB" for part in parts)


@dataclass(frozen=True, slots=True)
class Figures:
    """What came of it."""

    load: Load
    ticks_a_s: float
    p50_ms: float
    p99_ms: float
    max_ms: float
    in_time: float
    """share of ticks not later than `PROMISED_S`"""
    delay_p50_ms: float
    delay_p99_ms: float
    cpu: float
    """share of one core"""
    memory: Memory
    missed: int

    @property
    def tick_us(self) -> float:
        """Processor time of a tick, with everything that belongs to it."""
        return 1e6 * self.cpu / self.ticks_a_s if self.ticks_a_s else 0.0


class Heard:
    """What one socket heard while it counted."""

    def __init__(self) -> None:
        self.arrivals_s = array("d")
        self.ticks = array("q")
        self.states = 0
        self.count = 0

    def __call__(self, message: bytes) -> None:
        """One message."""
        if message.startswith(_TICK):
            self.count += 1
            self.arrivals_s.append(time.perf_counter())
            self.ticks.append(int(message[22 : message.index(b",", 22)]))
        elif message.startswith(b'{"type":"state"'):
            self.states += 1

    def clear(self) -> None:
        """Begin to count."""
        self.__init__()  # type: ignore[misc]

    @property
    def missed(self) -> int:
        """Ticks that were not heard, told or not."""
        return (self.ticks[-1] - self.ticks[0] + 1 - len(self.ticks)) if self.ticks else 0

    def delays_ms(self, period_s: float) -> list[float]:
        """How much later than the promptest message each arrived, against a steady pace."""
        offsets = [at - tick * period_s for at, tick in zip(self.arrivals_s, self.ticks, strict=True)]
        least = min(offsets, default=0.0)
        return [1e3 * (offset - least) for offset in offsets]


def main(arguments: list[str] | None = None) -> None:
    """Run the measurement and print its figures."""
    parser = argparse.ArgumentParser(
        prog="bench.live", description=__doc__.splitlines()[0] if __doc__ else None
    )
    parser.add_argument("--sessions", type=int, default=200)
    parser.add_argument("--hz", type=float, default=2.0)
    parser.add_argument("--hurried", type=int, default=0, help="further sessions at `max` speed")
    parser.add_argument("--workers", type=int, default=1, help="processes of the service (extra `cluster`)")
    parser.add_argument("--planner", help="of all sessions")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--write", action="store_true", help="measure the whole table into bench/LIVE.md")
    options = parser.parse_args([] if arguments is None else arguments)
    loads = [Load(options.sessions, options.hz, options.hurried, options.workers, options.planner)]
    if options.write:
        twos = [Load(sessions) for sessions in (1_000, 2_000, 3_000, 4_000)]
        loads = [*twos, Load(100, 60.0), Load(200, 60.0), Load(400, 60.0), Load(200), Load(200, hurried=10)]
    rows = [_HEAD, _RULE]
    print("\n".join(rows), flush=True)
    for load in loads:
        with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
            rows.append(_row(runner.run(measured(load, options.seconds))))
        print(rows[-1], flush=True)
        gc.collect()
    if options.write:
        RESULTS.write_text(_TEXT.format(machine=machine(), seconds=options.seconds, table="\n".join(rows)))


async def measured(load: Load, seconds: float) -> Figures:
    """A service under this load, looked at for so long."""
    room = load.sessions + load.hurried + 10
    async with AsyncExitStack() as stack:
        database = await stack.enter_async_context(_postgres()) if load.workers > 1 else None
        service = await stack.enter_async_context(
            serving(database=database, workers=load.workers, max_sessions=room)
        )
        async with httpx.AsyncClient(base_url=service.url, timeout=60) as client:
            base_mb = service.memory_mb()
            paces = [load.hz] * load.sessions + [None] * load.hurried
            streams = await _all([partial(_made, client, pace, load.planner) for pace in paces])
            await asyncio.sleep(SETTLE_S)
            made_mb = service.memory_mb()
            heard = [Heard() for _ in streams]
            sockets = await _all(
                [partial(opened, service.url, *each) for each in zip(streams, heard, strict=True)]
            )
            await asyncio.sleep(SETTLE_S)
            memory = Memory(base_mb, made_mb, service.memory_mb(), 0.0)
            figures = await _look(load, service, client, heard, memory, seconds)
        for socket in sockets:
            socket.close()
    return figures


@asynccontextmanager
async def _postgres() -> AsyncIterator[str]:
    """A database of a PostgreSQL server of its own."""
    programs = binaries()
    if programs is None:
        raise SystemExit("several workers need PostgreSQL, and none is installed")
    with postgres.serving(programs) as server:
        yield await server.database()


async def _look(
    load: Load,
    service: Service,
    client: httpx.AsyncClient,
    heard: list[Heard],
    memory: Memory,
    seconds: float,
) -> Figures:
    steady = heard[: load.sessions]
    for each in heard:
        each.clear()
    before = await _buckets(client)
    cpu_s, began_s = service.cpu_s(), time.perf_counter()
    worst_ms = 0.0
    for _ in range(max(1, round(seconds * 2))):
        await asyncio.sleep(0.5)
        worst_ms = max(worst_ms, (await client.get("/healthz")).json()["tick_lateness"]["max_ms"])
    busy_s, wall_s = service.cpu_s() - cpu_s, time.perf_counter() - began_s
    after = await _buckets(client)
    counts = {bound: count - before[bound] for bound, count in after.items()}
    delays = sorted(delay for each in steady for delay in each.delays_ms(1 / load.hz))
    return Figures(
        load=load,
        ticks_a_s=sum(each.count + each.missed for each in heard) / wall_s,
        p50_ms=_quantile_ms(counts, 0.5),
        p99_ms=_quantile_ms(counts, 0.99),
        max_ms=worst_ms,
        in_time=counts[PROMISED_S] / max(1.0, counts[float("inf")]),
        delay_p50_ms=_at(delays, 0.5),
        delay_p99_ms=_at(delays, 0.99),
        cpu=busy_s / wall_s,
        memory=replace(memory, last_mb=service.memory_mb()),
        missed=sum(each.missed for each in steady),
    )


async def _made(client: httpx.AsyncClient, hz: float | None, planner: str | None) -> str:
    """The stream of a new session; `hz` None is as fast as possible."""
    config = {} if planner is None else {"planner": planner}
    made = (await client.post("/api/v1/sessions", json={"config": config})).raise_for_status().json()
    speed = "max" if hz is None else hz * made["config"]["step_seconds"]
    if speed != 1.0:
        action = {"do": "set", "parameter": "playback_speed", "value": speed}
        done = await client.post(f"{made['links']['self']}/actions", json={"actions": [action]})
        done.raise_for_status()
    return str(made["links"]["stream"])


async def _all(works: list[Callable[[], Awaitable[Done]]]) -> list[Done]:
    gate = asyncio.Semaphore(AT_ONCE)

    async def one(work: Callable[[], Awaitable[Done]]) -> Done:
        async with gate:
            return await work()

    return await asyncio.gather(*(one(work) for work in works))


async def _buckets(client: httpx.AsyncClient) -> dict[float, float]:
    """How many ticks were up to so late, in seconds, since the service began."""
    counts: defaultdict[float, float] = defaultdict(float)  # of all shards
    for bound, count in _BUCKET.findall((await client.get("/metrics")).text):
        counts[float(bound)] += float(count)
    return dict(sorted(counts.items()))


def _quantile_ms(counts: dict[float, float], share: float) -> float:
    """A quantile of counted times, drawn straight between two bounds."""
    wanted, below, low = share * counts[float("inf")], 0.0, 0.0
    for bound, count in counts.items():
        if count >= wanted:
            if bound == float("inf"):
                break
            return 1e3 * (low + (bound - low) * (wanted - below) / max(1.0, count - below))
        below, low = count, bound
    return 1e3 * low


def _at(ordered: list[float], share: float) -> float:
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] if ordered else 0.0


_HEAD = (
    "| sessions | ticks/s | lateness p50 | p99 | max | ≤ 20 ms | arrival p50 | p99 | core | CPU a tick "
    "| session | + socket | at last | missed |"
)
_RULE = "| --- |" + " ---: |" * 13


def _row(found: Figures) -> str:
    return (
        f"| {found.load} | {found.ticks_a_s:.0f} | {found.p50_ms:.1f} ms | {found.p99_ms:.1f} ms "
        f"| {found.max_ms:.0f} ms | {100 * found.in_time:.2f} % | {found.delay_p50_ms:.1f} ms "
        f"| {found.delay_p99_ms:.1f} ms | {100 * found.cpu:.0f} % | {found.tick_us:.0f} µs "
        f"| {found.memory.told(found.load.sessions + found.load.hurried)} | {found.missed} |"
    )


_TEXT = """# Live sessions

Written by `python -m bench.live --write`. {machine}; {seconds:g} s each. The service is one process; the
clients, which share the machine with it, are another. Every session is simulated, its decision put into
words, and sent to one socket.

{table}

*Lateness* is from a tick's deadline to its beginning, of all ticks of the stretch (quantiles between the
bounds of `/metrics`); *arrival* is how much later than the session's own steady pace a message is there, at
the clients. *CPU a tick* is processor time of the whole service process, all threads, for each tick:
simulation, decision, words, message and sending. *Session* is the memory that each
has taken a few seconds after all were made, before anyone watches, *+ socket* what the process grew by when
each was watched, *at last* both at the end. *Missed* are ticks that a socket at the steady pace was not sent.
"""


if __name__ == "__main__":
    main(sys.argv[1:])
