"""How long a session of 10,000 entries takes to come back, and any tick of it: `python -m bench.restore`."""

from __future__ import annotations

import asyncio
import random
import statistics
import tempfile
import time
from pathlib import Path

from service import actions as contract
from service.narrate import Narrator
from service.sessions.clock import WheelClock
from service.sessions.manager import SessionManager
from service.sessions.session import Surroundings
from service.sessions.utterance import Utterance
from service.settings import Settings
from service.store import SqlStore
from sim.config import Config

ENTRIES = 10_000
LOOKS = 200


async def measure(entries: int, folder: Path) -> None:
    """Make a session, let it go, bring it back, and look at ticks of it by chance."""
    store = SqlStore(f"sqlite:///{folder}/roads.db")
    await store.open()
    around = Surroundings(store, WheelClock(), Narrator.load(), Settings())
    manager = SessionManager(around)
    session = await manager.create("long", Config(seed=7), paused=True)
    for number in range(entries):
        said = (
            {"do": "step", "ticks": 1}
            if number % 2
            else {"do": "set_count", "kind": "pothole", "count": 1 + number // 2 % 6}
        )
        await session.change(Utterance(actions=contract.load([said])))
    digest, tick = session.run.world.digest(), session.timeline.tick
    await manager.close()

    again = SessionManager(around)
    began = time.perf_counter()
    back = await again.get(session.id)
    restored_s = time.perf_counter() - began
    if back.run.world.digest() != digest or back.timeline.tick != tick:
        raise SystemExit("it came back as another")
    dice, looks = random.Random(1), []
    for _ in range(LOOKS):
        at = dice.randrange(tick)
        began = time.perf_counter()
        back.timeline.at(at)
        looks.append((time.perf_counter() - began) * 1000)
    looks.sort()
    print(
        f"{entries} entries, {tick} ticks: restored in {restored_s:.2f} s; a tick by chance: "
        f"median {statistics.median(looks):.1f} ms, worst of {LOOKS} {looks[-1]:.1f} ms"
    )
    await again.close()
    await store.close()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        asyncio.run(measure(ENTRIES, Path(made)))
