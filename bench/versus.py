"""This checkout's speed against that of another one, in one run.

    python -m bench.versus OTHER_CHECKOUT [--seconds 8] [--only tick env]

Both run the same work (`bench/versus_work.py`) in processes of their own, in turns, so that a machine that
slows down slows down both. Processes are started anew for each round, since the layout of memory alone is
worth some per cent; both have the same hash seed. What is told is CPU time; the ratio of the medians of a
round, of the middle round (above 1: this checkout is slower); and between which ratios half of the pairs of
repetitions lie. A row that says "came to something else" compares different work.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

HERE: Final = Path(__file__).parents[1]
WORK: Final = Path(__file__).with_name("versus_work.py")
CACHES: Final = Path(__file__).with_name("out") / "versus"
"""Compiled code of both, so that nothing is written into the other checkout."""
ROUNDS: Final = 3
LEAST: Final = 3
"""Repetitions of a round, however long one takes."""


class Worker:
    """A process that works with the code of one checkout."""

    def __init__(self, checkout: Path, hash_seed: int) -> None:
        """Started at once; it waits for what is asked."""
        environment = os.environ | {
            "PYTHONPATH": str(checkout),
            "PYTHONHASHSEED": str(hash_seed),  # the order of sets is part of the work
            "PYTHONPYCACHEPREFIX": str(CACHES / "bytecode"),
            "NUMBA_CACHE_DIR": str(CACHES / "numba"),
        }
        # -P: the folder of the script has modules of the same names as the project's.
        self._process = subprocess.Popen(
            [sys.executable, "-P", str(WORK)],
            cwd=checkout,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def __enter__(self) -> Worker:
        """For `with`."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the process."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait(60)

    def ask(self, *question: object) -> Any:
        """The answer to a question. Raises `RuntimeError` where the process ended instead."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(question) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"the process ended at {question}")
        return json.loads(line)


@dataclass
class Row:
    """What was measured of one kind of work: for each round (here, other) CPU seconds of its repetitions."""

    name: str
    rounds: list[list[tuple[float, float]]] = field(default_factory=list)
    units: int = 1
    note: str = ""

    def told(self) -> str:
        """The line of a table."""
        if not self.rounds:
            return f"| {self.name} | | | | {self.note} |"
        pairs = [pair for each in self.rounds for pair in each]
        here, other = (statistics.median(side) / self.units * 1e6 for side in zip(*pairs, strict=True))
        ratio = statistics.median(_ratio(each) for each in self.rounds)
        ratios = sorted(one / two for one, two in pairs)
        low, high = ratios[len(ratios) // 4], ratios[-1 - len(ratios) // 4]
        return f"| {self.name} | {other:.4g} | {here:.4g} | {ratio:.3f} | {low:.3f} – {high:.3f}{self.note} |"


def _ratio(pairs: Sequence[tuple[float, float]]) -> float:
    here, other = (statistics.median(side) for side in zip(*pairs, strict=True))
    return here / other


def measured(checkout: Path, name: str, seconds: float, workers: tuple[Worker, Worker], row: Row) -> None:
    """Repetitions of one round of one kind of work; each takes turns at being first."""
    here, other = (worker.ask("prepare", name) for worker in workers)
    for answer, where in ((here, HERE), (other, checkout)):
        if "missing" in answer:
            row.note = f"not in {where}: {answer['missing']}"
            return
    if (here["came_to"], here["units"]) != (other["came_to"], other["units"]):
        row.note = ", **came to something else**"
    row.units = here["units"]
    each = here["seconds"] + other["seconds"]
    pairs: list[tuple[float, float]] = []
    for repetition in range(max(LEAST, round(seconds / ROUNDS / each))):
        turns = workers if repetition % 2 else workers[::-1]
        times = {worker: worker.ask("work", name)["seconds"] for worker in turns}
        pairs.append((times[workers[0]], times[workers[1]]))
    row.rounds.append(pairs)


def main(checkout: Path, seconds: float, only: Sequence[str]) -> None:
    """Print the table."""
    rows: dict[str, Row] = {}
    for number in range(ROUNDS):
        with ExitStack() as stack:
            here, other = (stack.enter_context(Worker(each, number)) for each in (HERE, checkout))
            workers = here, other
            for name in here.ask("names"):
                if not only or any(part in name for part in only):
                    measured(checkout, name, seconds, workers, rows.setdefault(name, Row(name)))
    print("| CPU µs of one | other | here | here / other | half of all pairs |")
    print("| --- | --- | --- | --- | --- |")
    print(*(row.told() for row in rows.values()), sep="\n")


if __name__ == "__main__":
    form = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=form)
    parser.add_argument("checkout", type=Path, help="the folder of the other checkout")
    parser.add_argument("--seconds", type=float, default=8.0, help="for each row, both checkouts together")
    parser.add_argument("--only", nargs="*", default=(), help="parts of the names of rows")
    given = parser.parse_args()
    main(given.checkout.resolve(), given.seconds, given.only)
