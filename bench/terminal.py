"""From starting a command of `roadtalk` to its first line, every command of it.

Each is started five times with the bytecode of all modules in place, and stopped once it has said something.
*First* is whatever comes first; *answer* is standard output alone, which a pipe reads, and is left out where
that is a matter of work. Figures are the middle of five; the process's own processor time up to its answer
stands beside, since on a busy machine the clock tells of other programs.

    python -m bench.terminal
    python -m bench.terminal say watch
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from selectors import EVENT_READ, DefaultSelector
from statistics import median
from typing import NamedTuple

from bench.serving import cpu_s
from tests.support.service_process import ServiceProcess

RUNS = 5
LATEST_S = 60.0
AIM_S = 0.5
"""For the first line, by the clock; by processor time where the machine is busy."""

ALONE: dict[str, list[str]] = {
    "--version": [],
    "--help": [],
    "planners": [],
    "doctor": [],
    "scenario": ["list"],
    "evaluate": ["run 2 episodes", "--processes", "1"],
    "worst": ["find a road where A* fails", "--worlds", "2", "--processes", "1"],
    "check-planner": ["rules", "--help"],
    "language-eval": [],
    "language-fuzz": [],
    "replay": ["none.json"],
    "quiz": [],
    "play": ["--help"],
}
"""Commands that need no service, with what they are given."""
AT_WORK = {"evaluate", "worst", "language-eval", "language-fuzz", "quiz"}
"""Commands whose answer is awaited by nobody who measures a start."""
WITH_SERVICE: dict[str, list[str]] = {
    "sessions": [],
    "say": ["where are you?"],
    "watch": ["--ticks", "1"],
}
"""Commands that talk to a running service."""


class Took(NamedTuple):
    """Seconds from the start of a command."""

    first_s: float
    answer_s: float | None
    cpu_s: float


def first_lines(arguments: list[str], *, answer: bool) -> Took:
    """When a command first says anything and, if asked for, when its answer begins."""
    began = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-m", "service", *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, "COLUMNS": "100"},
    )
    assert process.stdout is not None
    assert process.stderr is not None
    seen: dict[str, float] = {}
    used = 0.0
    with DefaultSelector() as selector:
        selector.register(process.stdout, EVENT_READ, "out")
        selector.register(process.stderr, EVENT_READ, "err")
        while selector.get_map() and ("out" not in seen if answer else not seen):
            left = LATEST_S - (time.perf_counter() - began)
            if left <= 0:
                break
            for key, _ in selector.select(left):
                used = _cpu_s(process.pid, used)
                if os.read(key.fd, 4096):
                    seen.setdefault(key.data, time.perf_counter() - began)
                else:
                    selector.unregister(key.fileobj)
    process.kill()
    process.communicate()
    if not seen:
        raise RuntimeError(f"{arguments} said nothing")
    return Took(min(seen.values()), seen.get("out"), used)


def _cpu_s(pid: int, before: float) -> float:
    try:
        return cpu_s(pid)
    except (FileNotFoundError, IndexError):
        return before


def row(name: str, arguments: list[str]) -> str:
    """A command's line of the table."""
    took = [first_lines([name, *arguments], answer=name not in AT_WORK) for _ in range(RUNS)]
    first = median(each.first_s for each in took)
    answers = [each.answer_s for each in took if each.answer_s is not None]
    answer = f"{median(answers):6.2f}" if answers else "     –"
    used = median(each.cpu_s for each in took)
    mark = "" if min(first, used) <= AIM_S else f"  over {AIM_S:g} s"
    return f"{name:<14} {first:6.2f} {answer} {used:6.2f}{mark}"


def main(names: list[str] | None = None) -> None:
    """Print the table of all commands, or of those that are named."""
    wanted = set(names or ())
    print(f"{'command':<14} {'first':>6} {'answer':>6} {'CPU':>6}   seconds, middle of {RUNS}")
    for name, arguments in ALONE.items():
        if not wanted or name in wanted:
            print(row(name, arguments), flush=True)
    if wanted and not wanted & set(WITH_SERVICE):
        return
    with tempfile.TemporaryDirectory() as folder:
        service = ServiceProcess(Path(folder) / "terminal.db")
        service.start()
        try:
            service.session(seed=4)
            for name, arguments in WITH_SERVICE.items():
                if not wanted or name in wanted:
                    print(row(name, [*arguments, "--url", service.url]), flush=True)
        finally:
            service.kill()


if __name__ == "__main__":
    main(sys.argv[1:])
