"""How fast evaluations run: episodes a second on one process and on all cores, and what keeping them costs.

    python -m bench evaluations
    python -m bench.evaluations --priority 1000000 --astar 100000

The processes are started and warm before the clock runs. The processor time is that of all processes
together; other work on the machine does not lengthen it as it does the seconds. Kept are the packed figures,
in a SQLite file, part by part as the service does.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import tempfile
import time
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from functools import partial
from threading import Event
from typing import Any

from service.evaluations.kinds import part_key
from service.store import JobRecord, open_store
from sim.evaluate import Evaluation, Part
from sim.evaluate.executor import LocalProcesses
from sim.evaluate.run import pack_part, summarize_parts


def timed_part(spec: Mapping[str, Any], piece: Part, cancelled: Callable[[], bool]) -> tuple[float, bytes]:
    """The processor time that a part takes in its process, in seconds, and what it comes to."""
    began = time.process_time()
    body = pack_part(spec, piece, cancelled)
    return time.process_time() - began, body


def run(spec: Evaluation, processes: int) -> tuple[float, float, dict[Part, bytes]]:
    """Seconds that the episodes take, the summary included; of the processor; and what the parts came to."""
    executor = LocalProcesses(processes)
    work, parts = partial(timed_part, spec.to_json()), spec.parts()
    try:
        warm = [part for part in (parts[0], parts[-1]) for _ in range(processes)]
        list(executor.run(work, warm, Event()))
        began, busy = time.perf_counter(), time.process_time()
        timed = dict(executor.run(work, parts, Event()))
        found = {part: body for part, (_, body) in timed.items()}
        summarize_parts(spec, found, lambda: False)
        taken = sum(seconds for seconds, _ in timed.values()) + time.process_time() - busy
        return time.perf_counter() - began, taken, found
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


def main(priority: int = 100_000, rules: int = 20_000, astar: int = 5_000) -> None:
    """Print a row for each planner."""
    cores = os.cpu_count() or 1
    head = f"{'planner':<10}{'episodes':>12}{'processes':>11}{'seconds':>9}{'episodes/s':>12}"
    print(f"{head}{'processor s':>13}{'of one, a second':>18}{'kept in s':>11}")
    for planner, episodes in (("priority", priority), ("rules", rules), ("astar", astar)):
        spec = Evaluation(planners=(planner,), episodes=episodes)
        for processes in dict.fromkeys((1, cores)):
            seconds, busy, parts = run(spec, processes)
            kept = asyncio.run(keep(parts))
            row = f"{planner:<10}{episodes:>12,}{processes:>11}{seconds:>9.2f}"
            figures = f"{episodes / seconds:>12,.0f}{busy:>13.2f}{episodes / busy:>18,.0f}{kept:>11.2f}"
            print(f"{row}{figures}", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--priority", type=int, default=100_000, help="episodes with priority")
    parser.add_argument("--rules", type=int, default=20_000, help="episodes with rules")
    parser.add_argument("--astar", type=int, default=5_000, help="episodes with astar")
    main(**vars(parser.parse_args()))
