"""From starting the command to its first answer, beside a bare FastAPI app; and what `--version` takes.

Each is started five times, in turn, with the bytecode of all modules in place. *Cold* is without compiled
grammar, as after an upgrade; *warm* with it. The time is from the start of the process to the first 200. CPU
is what the process has used by then: on a busy machine only that tells anything.
"""

from __future__ import annotations

import http.client
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median
from typing import NamedTuple

RUNS = 5
LATEST_S = 120.0
POLL_S = 0.002

_BARE = """
import sys, uvicorn
from fastapi import FastAPI
app = FastAPI()
@app.get("/healthz")
async def healthz():
    return {"status": "ok"}
uvicorn.run(app, port=int(sys.argv[1]), log_level="warning")
"""


class Took(NamedTuple):
    """Seconds from the start of a process: by the clock, and of CPU time."""

    wall_s: float
    cpu_s: float


def first_answer(command: Sequence[str], port: int, environment: dict[str, str]) -> Took:
    """How long a server takes to its first 200."""
    began = time.perf_counter()
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
    try:
        while not _answers(port):
            if process.poll() is not None or time.perf_counter() - began > LATEST_S:
                raise RuntimeError(f"{command[1:4]} did not answer")
            time.sleep(POLL_S)
        return Took(time.perf_counter() - began, _cpu_s(process.pid))
    finally:
        process.terminate()
        process.wait()


def whole_run(command: Sequence[str], environment: dict[str, str]) -> Took:
    """How long a command takes to its end."""
    before, began = os.times(), time.perf_counter()
    subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=True)
    after = os.times()
    cpu_s = after.children_user + after.children_system - before.children_user - before.children_system
    return Took(time.perf_counter() - began, cpu_s)


def main() -> None:
    """Print a line for each."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cache = folder / "cache"
        kept = {"ROADTALK_CACHE_DIR": str(cache), "PYTHONPYCACHEPREFIX": str(folder / "pyc")}
        environment = os.environ | kept
        environment.pop("PYTHONDONTWRITEBYTECODE", None)

        def bare() -> Took:
            port = _free_port()
            return first_answer([sys.executable, "-c", _BARE, str(port)], port, environment)

        def served() -> Took:
            port = _free_port()
            database = f"sqlite:///{folder / 'sessions.db'}"
            serve = ["serve", "--port", str(port), "--database", database]
            return first_answer([sys.executable, "-m", "service", *serve], port, environment)

        def cold() -> Took:
            shutil.rmtree(cache, ignore_errors=True)
            return served()

        def told(option: str) -> Took:
            return whole_run([sys.executable, "-m", "service", option], environment)

        kinds: dict[str, Callable[[], Took]] = {
            "bare FastAPI app": bare,
            "serve, cold": cold,
            "serve, warm": served,
            "--version": lambda: told("--version"),
            "--help": lambda: told("--help"),
        }
        for run in kinds.values():
            run()  # writes bytecode
        took: dict[str, list[Took]] = {kind: [] for kind in kinds}
        for _ in range(RUNS):
            for kind, run in kinds.items():
                took[kind].append(run())
    _print(took)


def _print(took: dict[str, list[Took]]) -> None:
    least = _medians(next(iter(took.values())))
    for kind, times in took.items():
        wall_s, cpu_s = _medians(times)
        beside = f"{wall_s / least.wall_s:5.2f} x  CPU {cpu_s / least.cpu_s:5.2f} x"
        print(f"  {kind:18} {wall_s:6.3f} s  CPU {cpu_s:6.3f} s   {beside}")


def _medians(times: Sequence[Took]) -> Took:
    return Took(median(each.wall_s for each in times), median(each.cpu_s for each in times))


def _answers(port: int) -> bool:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
    try:
        connection.request("GET", "/healthz")
        return connection.getresponse().status == 200
    except OSError:
        return False
    finally:
        connection.close()


def _cpu_s(process: int) -> float:
    """CPU time of a process so far; 0 where the system does not say."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, ValueError):
        return 0.0


def _free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        port: int = listener.getsockname()[1]
        return port


if __name__ == "__main__":
    main()
