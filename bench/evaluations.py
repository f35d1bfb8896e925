"""How fast evaluations run: episodes a second on one process and on all cores, and what keeping them costs.

    python -m bench evaluations
    python -m bench.evaluations --priority 1000000 --astar 100000

The processes are started and warm before the clock runs. Kept are the packed figures, in a SQLite file, part
by part as the service does.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import tempfile
import time
from collections.abc import Mapping
from datetime import UTC, datetime
from functools import partial
from threading import Event

from service.evaluations.kinds import part_key
from service.store import JobRecord, open_store
from sim.evaluate import Evaluation, Part
from sim.evaluate.executor import LocalProcesses
from sim.evaluate.run import pack_part, summarize_parts


def run(spec: Evaluation, processes: int) -> tuple[float, dict[Part, bytes]]:
    """Seconds that the episodes take, the summary included, and what the parts came to."""
    executor = LocalProcesses(processes)
    work, parts = partial(pack_part, spec.to_json()), spec.parts()
    try:
        warm = [parts[-1]] * processes
        list(executor.run(work, warm, Event()))
        began = time.perf_counter()
        found = dict(executor.run(work, parts, Event()))
        summarize_parts(spec, found, lambda: False)
        return time.perf_counter() - began, found
    finally:
        executor.close()


async def keep(parts: Mapping[Part, bytes]) -> float:
    """Seconds that it takes to keep the parts."""
    with tempfile.TemporaryDirectory() as folder:
        store = open_store(f"sqlite:///{folder}/bench.db")
        await store.open()
        record = JobRecord(
            id="bench", kind="evaluation", state="running", created_at=datetime.now(UTC), spec={}
        )
        await store.create_job(record)
        began = time.perf_counter()
        for number, (part, body) in enumerate(parts.items()):
            await store.save_job_part("bench", part_key(part), body, number)
        taken = time.perf_counter() - began
        await store.close()
    return taken


def main(priority: int = 100_000, astar: int = 5_000) -> None:
    """Print a row for each planner."""
    cores = os.cpu_count() or 1
    print(
        f"{'planner':<10}{'episodes':>12}{'processes':>11}{'seconds':>9}{'episodes/s':>12}{'kept in s':>11}"
    )
    for planner, episodes in (("priority", priority), ("astar", astar)):
        spec = Evaluation(planners=(planner,), episodes=episodes)
        for processes in dict.fromkeys((1, cores)):
            seconds, parts = run(spec, processes)
            kept = asyncio.run(keep(parts))
            row = f"{planner:<10}{episodes:>12,}{processes:>11}{seconds:>9.2f}"
            print(f"{row}{episodes / seconds:>12,.0f}{kept:>11.2f}", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--priority", type=int, default=100_000, help="episodes with priority")
    parser.add_argument("--astar", type=int, default=5_000, help="episodes with astar")
    main(**vars(parser.parse_args()))
