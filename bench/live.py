"""Live sessions at 2 Hz, each watched by one socket: how late ticks are, what they cost, what is missed.

The service is the real command in a process of its own, with its file database; the clients are a
process of their own as well, so that their work is not the service's. Lateness is the service's own
measure (from a tick's deadline to its beginning); delivery is measured by the clients, as how much
later than the session's steady pace a tick message arrives.

    python -m bench.live --sessions 200 --seconds 60
"""

from __future__ import annotations

import argparse
import asyncio
import os
import re
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import httpx
import orjson
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

WARM_UP_S = 3.0
"""Connecting is not what is measured."""

MAX_ATTEMPTS_AT_ONCE = 50


@dataclass
class Heard:
    """What one socket heard while it counted."""

    arrivals_s: list[float] = field(default_factory=list)
    ticks: list[int] = field(default_factory=list)
    missed: int = 0

    @property
    def gaps(self) -> int:
        """Ticks that were not heard, told or not."""
        return (self.ticks[-1] - self.ticks[0] + 1 - len(self.ticks)) if self.ticks else 0

    def delays_ms(self, period_s: float) -> list[float]:
        """How much later than the promptest message each arrived, against a steady pace."""
        offsets = [at - tick * period_s for at, tick in zip(self.arrivals_s, self.ticks, strict=True)]
        return [1e3 * (offset - min(offsets)) for offset in offsets]


def main(arguments: list[str] | None = None) -> None:
    """Run the measurement and print its figures."""
    parser = argparse.ArgumentParser(
        prog="bench.live", description=__doc__.splitlines()[0] if __doc__ else None
    )
    parser.add_argument("--sessions", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=60.0)
    options = parser.parse_args([] if arguments is None else arguments)
    asyncio.run(_measure(options.sessions, options.seconds))


async def _measure(sessions: int, seconds: float) -> None:
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "ROADTALK_MAX_SESSIONS": str(sessions + 10)}
        service = await asyncio.create_subprocess_exec(
            sys.executable, "-m", "service", "serve", "--port", "0", "--database", f"sqlite:///{folder}/live.db",
            stdout=asyncio.subprocess.PIPE, env=environment,
        )  # fmt: skip
        assert service.stdout is not None
        found = re.search(r"http://[\d.:]+", (await service.stdout.readline()).decode())
        if found is None:
            raise SystemExit("the service did not start")
        try:
            await _watch_all(found[0], service.pid, sessions, seconds)
        except* ConnectionClosed:
            raise SystemExit("the service ended while it was measured") from None
        finally:
            if service.returncode is None:
                service.terminate()
            await service.wait()


async def _watch_all(url: str, pid: int, sessions: int, seconds: float) -> None:
    async with httpx.AsyncClient(base_url=url, timeout=60) as client, asyncio.TaskGroup() as group:
        gate = asyncio.Semaphore(MAX_ATTEMPTS_AT_ONCE)
        began = time.perf_counter()
        watching = [group.create_task(_watch(client, url, gate, seconds)) for _ in range(sessions)]
        health = (await client.get("/healthz")).json()
        while health["watchers"] < sessions:
            await asyncio.sleep(0.1)
            health = (await client.get("/healthz")).json()
        connected_s = time.perf_counter() - began
        await asyncio.sleep(WARM_UP_S)
        cpu_began_s, wall_began_s = _cpu_s(pid), time.perf_counter()
        await asyncio.sleep(max(1.0, seconds - 2 * WARM_UP_S))
        busy = (_cpu_s(pid) - cpu_began_s) / (time.perf_counter() - wall_began_s)
        lateness = (await client.get("/healthz")).json()["tick_lateness"]
        memory_mb = _memory_mb(pid)
    heard = [task.result() for task in watching]
    delays = sorted(delay for each in heard for delay in each.delays_ms(0.5))
    print(f"{sessions} sessions at 2 Hz, one socket each, {seconds:g} s (connected in {connected_s:.1f} s)")
    print(
        f"  tick lateness     p50 {lateness['p50_ms']:.2f} ms   p99 {lateness['p99_ms']:.2f} ms   "
        f"max {lateness['max_ms']:.2f} ms   (the service's latest {lateness['ticks']} ticks)"
    )
    print(
        f"  delivery jitter   p50 {_quantile(delays, 0.5):.2f} ms   p99 {_quantile(delays, 0.99):.2f} ms   "
        f"max {delays[-1]:.2f} ms   ({len(delays)} messages)"
    )
    print(f"  service           {100 * busy:.1f} % of one core, {memory_mb:.0f} MB resident")
    gaps, told = sum(each.gaps for each in heard), sum(each.missed for each in heard)
    print(f"  missed            {gaps} ticks, of which told in {told} messages")


async def _watch(client: httpx.AsyncClient, url: str, gate: asyncio.Semaphore, seconds: float) -> Heard:
    """Make a session, watch it, and note what arrives when."""
    heard = Heard()
    async with gate:
        session = (await client.post("/api/v1/sessions", json={})).raise_for_status().json()
        socket = await connect(f"ws{url[4:]}{session['links']['stream']}", compression=None)
    async with socket:
        stop_s = time.perf_counter() + seconds + WARM_UP_S
        while time.perf_counter() < stop_s:
            message = orjson.loads(await socket.recv())
            if message["type"] == "tick":
                heard.arrivals_s.append(time.perf_counter())
                heard.ticks.append(message["tick"])
            elif message["type"] == "state":
                heard.missed += 1
    return heard


def _quantile(ordered: list[float], share: float) -> float:
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def _cpu_s(pid: int) -> float:
    """Processor time a process has used, user and system."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _memory_mb(pid: int) -> float:
    """Memory a process holds."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


if __name__ == "__main__":
    main(sys.argv[1:])
