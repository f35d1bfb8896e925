"""How long a session of 10,000 entries takes to come back, and to fork: `python -m bench.restore`.

Four sessions: counts set and steps in turn, the same with mixed actions (things added and removed, undone
and redone, moves, modes), 10,000 mixed entries over 50,000 ticks, and some with moves in time among them.
Each comes back by its whole log, and by the snapshot that was kept while it was talked to, as after a kill;
then it is asked for past ticks at once. Where it is not said otherwise, times are CPU time of the process: on
a machine that does other work as well, only that can be compared.
"""

from __future__ import annotations

import asyncio
import gc
import random
import statistics
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Awaitable, Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from service import actions as contract
from service.narration import Narrator
from service.problems import ProblemError
from service.sessions.manager import SessionManager
from service.sessions.scheduler.wheel_clock import WheelClock
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.utterance import Utterance
from service.settings import Settings
from service.store import SqlStore
from sim.config import Config

ENTRIES = 10_000
LOOKS = 200
FORKS = 20

Said = dict[str, Any]


def counts_and_steps(entries: int) -> Iterator[Said]:
    """A count set, a step, and so on."""
    for number in range(entries):
        if number % 2:
            yield {"do": "step", "ticks": 1}
        else:
            yield {"do": "set_count", "kind": "pothole", "count": 1 + number // 2 % 6}


def mixed(entries: int, ticks: int) -> Iterator[Said]:
    """Whatever people do, with steps of so many ticks in every other entry."""
    dice = random.Random(5)
    others: list[Said] = [
        {"do": "add", "kind": "pothole", "count": 1},
        {"do": "add", "kind": "vehicle", "count": 2, "where": {"side": "ahead"}},
        {"do": "remove", "kind": "everything", "count": "all", "where": {"lane": "left"}},
        {"do": "set_count", "kind": "vehicle", "count": 9},
        {"do": "mode", "mode": "manual"},
        {"do": "mode", "mode": "auto"},
        {"do": "drive", "move": "left"},
        {"do": "prefer", "preference": "cautious"},
        {"do": "undo"},
        {"do": "redo"},
        {"do": "reset"},
        {"do": "save", "name": "here"},
    ]
    for number in range(entries):
        yield {"do": "step", "ticks": ticks} if number % 2 else dice.choice(others)


def with_moves_in_time(entries: int) -> Iterator[Said]:
    """The same, and now and then back in time, to a name or by ticks, or a pause."""
    dice = random.Random(6)
    moves: list[Said] = [
        {"do": "load", "name": "here"},
        {"do": "rewind", "ticks": 3},
        {"do": "rewind", "ticks": 200},
        {"do": "pause"},
        {"do": "resume"},
        {"do": "set", "parameter": "playback_speed", "value": 2},
    ]
    for said in mixed(entries, 5):
        yield dice.choice(moves) if dice.random() < 0.1 else said


async def measure(name: str, script: Callable[[int], Iterator[Said]], entries: int, folder: Path) -> None:
    """Make a session and let it go; then see how it comes back."""
    store = SqlStore(f"sqlite:///{folder}/{name.replace(' ', '-')}.db")
    await store.open()
    services = SessionServices(store, WheelClock(), Narrator.load(), Settings())
    manager = SessionManager(services)
    session = await manager.create("long", Config(seed=7), paused=True)
    sayings = script(10**9)
    while session.sequence < entries:
        try:
            await session.change(Utterance(actions=contract.load([next(sayings)])))
        except ProblemError:
            continue
    ends, kept = (session.run.world.digest(), session.timeline.tick), Counter(manager.snapshots.counts)
    # Nothing is kept at the end, as after a kill; what is due already would have been kept meanwhile.
    await manager.snapshots.flush()
    kept += manager.snapshots.counts - kept
    snapshot = await store.snapshot(session.id)
    identity = session.id
    del session, manager
    gc.collect()
    gc.freeze()  # as the service does once it has started
    if snapshot is None:
        raise SystemExit("no snapshot was kept")
    print(
        f"{name}: {entries} entries, {ends[1]} ticks; {kept['kept']} snapshots were kept, the last after "
        f"entry {snapshot.sequence} of {len(snapshot.body) / 1000:.0f} kB",
        flush=True,
    )
    await come_back(f"{name}, by its snapshot", services, identity, ends)
    await store.save_snapshot(replace(snapshot, checksum="none of it is used"))
    await come_back(f"{name}, by its whole log", services, identity, ends)
    await store.close()


async def come_back(name: str, services: SessionServices, session_id: str, ends: tuple[str, int]) -> None:
    """Bring a session back, look at ticks of it by chance, and fork it."""
    again = SessionManager(services)
    back, restored_s, restored_cpu_s = await timed(lambda: again.get(session_id))
    if (back.run.world.digest(), back.timeline.tick) != ends:
        raise SystemExit("it came back as another")
    tick = back.timeline.tick
    dice = random.Random(1)
    looks, rewinds, forks, walls = [], [], [], []
    for _ in range(LOOKS):
        at = dice.randrange(tick)
        looks.append(spent(lambda at=at: back.timeline.at(at)))
        rewinds.append(spent(lambda at=at: back.timeline.copy().rewind(at)))
    for number in range(FORKS):
        at = dice.randrange(tick) if number % 2 else tick
        await again.snapshots.flush()
        child, wall_s, cpu_s = await timed(lambda at=at: again.fork(back, at))
        if child.run != back.timeline.at(at):
            raise SystemExit("a fork is another")
        forks.append(cpu_s * 1000)
        walls.append(wall_s * 1000)
    last = child.id
    await again.snapshots.flush()
    await again.close()
    third = SessionManager(services)
    _, _, woken_s = await timed(lambda: third.get(last))
    print(
        f"{name}: restored in {restored_cpu_s:.2f} s "
        f"({restored_s:.2f} s by the clock); at a tick: {told(looks)}; back to a tick: {told(rewinds)}; "
        f"fork: {told(forks)} (by the clock {told(walls)}); a fork restored in {woken_s:.2f} s",
        flush=True,
    )
    await third.close()


async def timed(work: Callable[[], Awaitable[Session]]) -> tuple[Session, float, float]:
    """What it answers, and the seconds it took: by the clock, and of this process."""
    began, cpu = time.perf_counter(), time.process_time()
    found = await work()
    return found, time.perf_counter() - began, time.process_time() - cpu


def spent(work: Callable[[], object]) -> float:
    """Milliseconds of CPU time that it took."""
    began = time.process_time()
    work()
    return (time.process_time() - began) * 1000


def told(times: list[float]) -> str:
    """Median and worst."""
    return f"median {statistics.median(times):.1f} ms, worst of {len(times)} {max(times):.1f} ms"


async def everything(entries: int) -> None:
    """All four."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        await measure("counts and steps", counts_and_steps, entries, folder)
        await measure("mixed", lambda most: mixed(most, 1), entries, folder)
        await measure("mixed and long", lambda most: mixed(most, 10), entries, folder)
        await measure("with moves in time", with_moves_in_time, entries, folder)


def main(entries: int = ENTRIES) -> None:
    """Measure sessions of so many entries."""
    asyncio.run(everything(entries))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
