"""How late ticks are while planners that mean harm drive other sessions.

`python -m tools.hostile_lateness` prints it. The first figures are from before: the same sessions,
with nobody hostile. A hostile planner that was taken over from is let drive again every second.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
import tempfile
import time

from service.app import create_app
from service.sessions.scheduler.clock import Lateness
from service.sessions.scheduler.wheel_clock import WheelClock
from service.sessions.session import Session
from service.sessions.utterance import Utterance
from service.settings import Settings
from service.store import MemoryStore
from sim import planner_names
from sim.actions import SetMode
from sim.config import Config
from sim.types import Mode
from tests.support import faulty_planners
from tests.support.hostile_planners import HOSTILE


class _Counting(WheelClock):
    """A clock that keeps every lateness since it was last asked."""

    def __init__(self) -> None:
        self.samples: list[float] = []
        super().__init__(late=lambda late_s: self.samples.append(late_s))

    def taken(self) -> Lateness:
        samples, self.samples = self.samples, []
        return Lateness.from_samples(samples)


async def measured(others: int, seconds: float) -> None:
    """Print the figures without and with them."""
    clock = _Counting()
    settings = Settings(database="memory:", max_sessions=others + len(HOSTILE) + 1)
    app = create_app(settings, store=MemoryStore(), clock=clock)
    async with app.router.lifespan_context(app):
        manager = app.state.context.manager
        for seed in range(others):
            await manager.create(None, Config(seed=seed), paused=False)
        await asyncio.sleep(1.0)
        clock.taken()
        await asyncio.sleep(seconds)
        _tell("nobody hostile", clock.taken())
        hostile: list[Session] = []
        for seed, planner in enumerate(HOSTILE):
            config = Config(seed=seed, planner=planner)
            hostile.append(await manager.create(None, config, paused=False))
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            await asyncio.sleep(1.0)
            for session in hostile:
                if session.run.mode is Mode.MANUAL:
                    await session.change(Utterance(actions=(SetMode(mode=Mode.AUTO),)))
        _tell(f"{len(hostile)} hostile", clock.taken())
        print(
            "hostile ticks:", " ".join(f"{each.run.config.planner}:{each.timeline.tick}" for each in hostile)
        )


def _tell(who: str, late: Lateness) -> None:
    print(f"{who:>15}: {late.ticks} ticks, late p50 {late.p50_ms} p99 {late.p99_ms} max {late.max_ms} ms")


def main() -> None:
    """Read the options and measure."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--others", type=int, default=100, help="sessions that behave, two ticks a second")
    options.add_argument("--seconds", type=float, default=30.0)
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        faulty_planners.package(folder, HOSTILE, "hostile")
        sys.path.insert(0, folder)
        planner_names.forget_installed()
        asyncio.run(measured(given.others, given.seconds))


if __name__ == "__main__":
    main()
