"""The world's speed, against limits, a plain twin, a C loop and peers, all in one run.

    python -m bench sim          the table
    python -m bench.sim --write  and into bench/RESULTS.md

Ratios are of medians of interleaved repetitions, so that a machine that slows down slows down both.
"""

from __future__ import annotations

import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from bench import peers
from bench.c_loop import CLoop
from sim.batch import Batch, BatchPlanner
from sim.config import Config
from sim.forecast import Forecast
from sim.search.reachability import shortest_plan, steps_left
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome
from tests.support import twin

WORLDS, TICKS, REPEATS = 4096, 1000, 7
LONGER = 4
"""Starting a thread takes a while on a shared machine, so two are measured on longer runs."""
RESULTS = Path(__file__).parent / "RESULTS.md"


@dataclass(frozen=True)
class Line:
    """One figure: what, how much, the limit if there is one, and whether it holds."""

    what: str
    value: str
    limit: str = ""
    holds: bool | None = None

    def row(self) -> str:
        """The line of a table."""
        mark = "" if self.holds is None else "yes" if self.holds else "**no**"
        return f"| {self.what} | {self.value} | {self.limit} | {mark} |"


def main() -> None:
    """Measure everything and print the table."""
    lines = [*loops(), *plans(), *live(), *loading(), *others()]
    table = "\n".join(
        ["| what | measured | limit | holds |", "| --- | --- | --- | --- |", *map(Line.row, lines)]
    )
    print(table)
    if "--write" in sys.argv:
        head = (
            "# The world's speed\n\n"
            "Written by `python -m bench.sim --write`; how to read it is in `README.md`.\n\n"
            f"{_processor()}, {os.cpu_count()} cores, Python {platform.python_version()}, "
            f"{time.strftime('%Y-%m-%d')}\n\n"
        )
        RESULTS.write_text(head + table + "\n")


def loops() -> list[Line]:
    """Decisions a second: batch, C, two threads, learning environment, twin."""
    configs = [Config(seed=seed) for seed in range(WORLDS)]
    batch = Batch(configs, after="restart")
    fresh = Batch(configs, after="next")
    batch.run(50)
    fresh.run(50)
    contestants: dict[str, Callable[[], None]] = {
        "one": lambda: batch.run(TICKS),
        "one, longer": lambda: batch.run(LONGER * TICKS),
        "two, longer": lambda: batch.run(LONGER * TICKS, threads=2),
        "next": lambda: fresh.run(TICKS // 4),
    }
    try:
        c_loop = CLoop(configs)
        check = Batch(configs, after="restart")
        c_loop.run(200)
        check.run(200)
        assert c_loop.agrees_with(check), "the C loop is not the same loop"
        contestants["c"] = lambda: c_loop.run(TICKS)
    except LookupError as missing:
        print(missing)
    seconds = _interleaved(contestants)
    one, gain = WORLDS * TICKS / seconds["one"], seconds["one, longer"] / seconds["two, longer"]
    plain = _twin_rate()
    lines = [
        Line("batch `priority`, one core", f"{one / 1e6:.0f} M decisions/s", "80 M", one >= 8e7),
        Line(
            "… against the plain twin",
            f"{one / plain:.0f} × ({plain / 1e3:.0f} k/s)",
            "500 ×",
            one >= 500 * plain,
        ),
    ]
    if "c" in seconds:
        c_rate = WORLDS * TICKS / seconds["c"]
        told = f"{one / c_rate:.2f} × ({c_rate / 1e6:.0f} M/s)"
        lines.append(Line("… against the C loop", told, "0.8 ×", one >= 0.8 * c_rate))
    lines += [
        Line("… two threads against one", f"{gain:.2f} ×", "1.8 ×", gain >= 1.8),
        Line(
            "… with a fresh road for every episode, results held",
            f"{WORLDS * (TICKS // 4) / seconds['next'] / 1e6:.0f} M ticks/s",
        ),
        Line("learning environment, 4,096 at once", f"{_learning_rate() / 1e6:.2f} M steps/s"),
    ]
    return lines


def plans() -> list[Line]:
    """Microseconds for a plan, from the start of a default road and along a run."""
    lines = []
    limits_us: tuple[tuple[BatchPlanner, float], ...] = (("bfs", 2.0), ("weighted", 20.0))
    for planner, limit_us in limits_us:
        batch = Batch([Config(seed=seed) for seed in range(WORLDS)], after="stop")
        batch.moves(planner)
        start_us = _median(partial(batch.least, planner)) / WORLDS * 1e6
        spent, taken = 0.0, 0
        while (batch.outcomes == 0).any():
            running = int((batch.outcomes == 0).sum())
            began = time.perf_counter()
            moves = batch.moves(planner)
            spent, taken = spent + time.perf_counter() - began, taken + running
            batch.step(moves)
        lines.append(
            Line(
                f"{planner} plan in batch, at the start of a road (mean along it)",
                f"{start_us:.2f} µs ({spent / taken * 1e6:.2f} µs)",
                f"{limit_us:g} µs",
                start_us <= limit_us,
            )
        )
    starts, along = [], []
    for seed in range(60):
        run = SimState.start(Config(seed=seed))
        while run.world.outcome is Outcome.RUNNING:
            began = time.perf_counter()
            limit = steps_left(run.config, run.world.episode_tick)
            shortest_plan(Forecast.of_truth(run.world, run.config, limit), limit)
            (starts if run.world.episode_tick == 0 else along).append(time.perf_counter() - began)
            run = step(run).state
    start_us, along_us = statistics.median(starts) * 1e6, statistics.mean([*starts, *along]) * 1e6
    lines.append(
        Line(
            "exact plan live, mean along a run (median at the start)",
            f"{along_us:.0f} µs ({start_us:.0f} µs)",
            "100 µs",
            along_us <= 100,
        )
    )
    return lines


def live() -> list[Line]:
    """A tick of one live world with its full trace."""
    lines = []
    limits_us = {"priority": 150.0, "astar": 3000.0, "dijkstra": None, "bfs": None}
    for planner, limit_us in limits_us.items():
        times = []
        for seed in range(60):
            run = SimState.start(Config(seed=seed, planner=planner))
            while run.world.outcome is Outcome.RUNNING:
                began = time.perf_counter()
                tick = step(run)
                times.append(time.perf_counter() - began)
                run = tick.state
        times.sort()
        median, tail = times[len(times) // 2] * 1e6, times[int(len(times) * 0.99)] * 1e6
        lines.append(
            Line(
                f"live tick with full trace, `{planner}`: median (99 %)",
                f"{median:.0f} µs ({tail:.0f} µs)",
                "" if limit_us is None else f"{limit_us:g} µs",
                None if limit_us is None else median <= limit_us,
            )
        )
    return lines


def loading() -> list[Line]:
    """Importing, compiling, and loading what was compiled, each in a process of its own."""
    bare = "import time; t = time.perf_counter(); import sim.state; print(time.perf_counter() - t)"
    imported = min(float(_python(bare)) for _ in range(5))
    loaded = _python(
        "import sim, sim.state, sys; print(int('numba' in sys.modules or 'numpy' in sys.modules))"
    )
    batch = (
        "import time; t = time.perf_counter()\n"
        "from sim.batch import Batch; from sim.config import Config\n"
        "b = Batch([Config(seed=s) for s in range(64)], after='restart'); b.run(1)\n"
        "b.moves('bfs'); b.moves('weighted')\n"
        "print(time.perf_counter() - t)"
    )
    with tempfile.TemporaryDirectory() as folder:
        first, cached = (float(_python(batch, NUMBA_CACHE_DIR=folder)) for _ in range(2))
    return [
        Line("`import sim.state`", f"{imported * 1e3:.0f} ms", "150 ms", imported <= 0.15),
        Line(
            "… without numba or numpy", "yes" if loaded.strip() == "0" else "no", "yes", loaded.strip() == "0"
        ),
        Line("batch with all three planners: first time, compiling", f"{first:.1f} s"),
        Line("… from cache, numba's own import included", f"{cached:.2f} s"),
    ]


def others() -> list[Line]:
    """Peers, and what the same unit costs here."""
    lines = [
        Line(f"peer: {name}", "not installed" if steps is None else f"{steps / 1e3:.1f} k steps/s")
        for name, steps in peers.measured()
    ]
    try:
        lines.append(
            Line("peer: networkx A*, graph built before", f"{peers.networkx_plan() * 1e6:.0f} µs a plan")
        )
    except ImportError:
        lines.append(Line("peer: networkx A*", "not installed"))
    return lines


def _twin_rate() -> float:
    positions = [twin.position(SimState.start(Config(seed=seed)).world) for seed in range(40)]

    def episodes() -> int:
        made = 0
        for start in positions:
            now = start
            for _ in range(30):
                _, now = twin.step(now)
                made += 1
                if now.outcome is not Outcome.RUNNING:
                    now = start
        return made

    return peers.rate(episodes)


def _learning_rate() -> float:
    try:
        from sim.env import RoadVectorEnv
    except ImportError:
        return float("nan")
    many = RoadVectorEnv(WORLDS, action_mask=False)
    many.reset(seed=0)
    actions = np.zeros(WORLDS, np.int64)

    def step() -> int:
        many.step(actions)
        return WORLDS

    return peers.rate(step)


def _interleaved(contestants: dict[str, Callable[[], None]]) -> dict[str, float]:
    """Median seconds of each, taken in turns."""
    seconds: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(REPEATS):
        for name, work in contestants.items():
            began = time.perf_counter()
            work()
            seconds[name].append(time.perf_counter() - began)
    return {name: statistics.median(times) for name, times in seconds.items()}


def _median(work: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        work()
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def _python(code: str, **environment: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, **environment},
    )
    return done.stdout


def _processor() -> str:
    try:
        names = [
            line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")
        ]
        return names[0].partition(":")[2].strip()
    except (OSError, IndexError):
        return platform.processor() or platform.machine()


if __name__ == "__main__":
    main()
