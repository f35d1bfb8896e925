"""The service as a process of its own, for measuring: started, looked at from outside, ended."""

from __future__ import annotations

import asyncio
import os
import platform
import re
import sys
import tempfile
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

START_S = 60.0


@dataclass
class Service:
    """Where it is, and its process."""

    url: str
    process: asyncio.subprocess.Process

    @property
    def pid(self) -> int:
        """The process's number."""
        return self.process.pid

    @property
    def alive(self) -> bool:
        """Whether it still runs."""
        return self.process.returncode is None

    def cpu_s(self) -> float:
        """Processor time it has used, user and system, all its threads and processes."""
        return sum(cpu_s(pid) for pid in self._processes())

    def memory_mb(self) -> float:
        """Memory it holds, with its processes; what they share is counted in each."""
        return sum(memory_mb(pid) for pid in self._processes())

    def _processes(self) -> list[int]:
        found = [self.pid]
        for pid in found:  # grows: the children of its children, too
            for children in Path(f"/proc/{pid}/task").glob("*/children"):
                found += map(int, children.read_text().split())
        return found


def cpu_s(pid: int) -> float:
    """Processor time a process has used, user and system, all its threads."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory_mb(pid: int) -> float:
    """Memory a process holds."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


@asynccontextmanager
async def serving(
    *, database: str | None = None, quiet: bool = False, workers: int = 1, **settings: object
) -> AsyncIterator[Service]:
    """The real command with a file database of its own, or another; `settings` as in the environment.

    `quiet`: what it has to say of each piece of rubbish is not shown. More than one of the `workers` are
    shards of a cluster, which need a PostgreSQL `database`.
    """
    given = {f"ROADTALK_{name.upper()}": str(value) for name, value in settings.items()}
    with tempfile.TemporaryDirectory() as folder:
        kept = database or f"sqlite:///{folder}/measured.db"
        process = await asyncio.create_subprocess_exec(
            sys.executable, "-m", "service", "serve", "--port", "0", "--database", kept,
            "--workers", str(workers),
            stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.DEVNULL if quiet else None,
            env={**os.environ, **given},
        )  # fmt: skip
        assert process.stdout is not None
        line = (await asyncio.wait_for(process.stdout.readline(), START_S)).decode()
        found = re.search(r"http://[\d.:]+", line)
        if found is None:
            raise SystemExit("the service did not start")
        try:
            yield Service(found[0], process)
        finally:
            if process.returncode is None:
                process.terminate()
            await process.wait()


def machine() -> str:
    """This machine in a few words."""
    model = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    name = model[1] if model else platform.machine()
    return f"{name}, {os.cpu_count()} cores, Python {platform.python_version()}"
