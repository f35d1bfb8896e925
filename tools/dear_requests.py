"""What dear requests do to others: a table of tick lateness, `/healthz`, memory and outcomes.

`python -m tools.dear_requests` prints it. A service runs in a process of its own with sessions that behave,
at two ticks a second. Ten clients at once send each request of `tools.dear_cases` for some seconds, and hang
up; also sockets that never read, and live sessions whose ticks are dear. Before and after stands the same
without any dear request, since the machine has a say in it. Lateness is read from `/metrics`, so that its
99th percentile is the bound of a bucket. What the machine has no say in is how much processor time the event
loop's thread took between two turns.
"""

from __future__ import annotations

import argparse
import asyncio
import http.client
import json
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Awaitable, Callable
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import psutil
from websockets.asyncio.client import connect

from tools.dear_cases import CASES, LONG_QUESTION, ROADS, STEPS_BEFORE, Case

ROOT = Path(__file__).parents[1]
HEALTH_EVERY_S = 0.02
CLIENTS = 10


class Health(threading.Thread):
    """Asks `/healthz` again and again, in a thread of its own."""

    def __init__(self, url: str) -> None:
        super().__init__(daemon=True)
        self._address = urlsplit(url).netloc
        self._samples: list[float] = []

    def run(self) -> None:
        """Until the program ends."""
        connection = http.client.HTTPConnection(self._address, timeout=60)
        while True:
            began = time.perf_counter()
            try:
                connection.request("GET", "/healthz")
                connection.getresponse().read()
            except (OSError, http.client.HTTPException):
                return  # the service has ended
            self._samples.append(time.perf_counter() - began)
            time.sleep(HEALTH_EVERY_S)

    def taken(self) -> list[float]:
        """Seconds that each answer took since this was last asked, sorted."""
        samples, self._samples = self._samples, []
        return sorted(samples)


class Table:
    """Measures one row after another."""

    def __init__(self, url: str, pid: int) -> None:
        self._http = httpx.AsyncClient(base_url=url, timeout=600, limits=httpx.Limits(max_connections=None))
        self._process = psutil.Process(pid)
        self._health = Health(url)
        self.ids: dict[str, str] = {}
        self.worst_s = (0.0, 0.0)

    async def prepare(self, others: int) -> None:
        """Make the sessions that behave, and those that are asked."""
        for seed in range(others):
            await self._post("/sessions", {"seed": seed})
        for name, config in ROADS.items():
            made = await self._post("/sessions", {"config": {**config, "seed": 1}, "paused": True})
            self.ids[name] = made["id"]
            if ticks := STEPS_BEFORE.get(name):
                await self._post(f"/sessions/{made['id']}/step", {"ticks": ticks})
        self._health.start()

    async def row(self, name: str, seconds: float, load: Callable[[Counter[str]], Awaitable[None]]) -> None:
        """Measure while a load is on."""
        outcomes: Counter[str] = Counter()
        self._health.taken()
        before = await self._lateness()
        await self._loop()
        try:
            async with asyncio.timeout(seconds):
                await load(outcomes)
                await asyncio.sleep(seconds)
        except TimeoutError:
            pass
        ticks, p99, over = _difference(before, await self._lateness())
        held = await self._loop()
        health = self._health.taken() or [0.0]
        slow = health[int((len(health) - 1) * 0.99)]
        rss = self._process.memory_info().rss / 1e6
        children = self._process.children(recursive=True)
        workers = sum(child.memory_info().rss for child in children) / 1e6
        told = " ".join(f"{what}×{count}" for what, count in outcomes.most_common())
        print(
            f"| {name[:70]} | {held * 1e3:.0f} | {ticks} | {p99} | {over:.1f} | {slow * 1e3:.0f} "
            f"| {health[-1] * 1e3:.0f} | {rss:.0f} + {workers:.0f} | {told} |",
            flush=True,
        )

    async def ask(self, case: Case, outcomes: Counter[str]) -> None:
        """Ten clients that send a case again and again."""
        path = "/api/v1" + case.path.format(**self.ids)

        async def client() -> None:
            while True:
                began = time.perf_counter()
                try:
                    async with asyncio.timeout(case.hang_up_s):
                        answer = await self._http.request(case.method, path, json=case.body)
                    outcomes[_outcome(answer)] += 1
                    # Refusals are not what is measured here, and not a flood of them.
                    await asyncio.sleep(0.2 if answer.is_error else 0.0)
                except TimeoutError:
                    outcomes["hung up"] += 1
                except asyncio.CancelledError:
                    if time.perf_counter() - began > 0.5:
                        outcomes["under way"] += 1
                    raise

        async with asyncio.TaskGroup() as group:
            for _ in range(CLIENTS):
                group.create_task(client())

    async def silent_sockets(self, outcomes: Counter[str]) -> None:
        """Sockets that send a hundred long questions each and never read."""
        url = str(self._http.base_url).replace("http", "ws", 1).rstrip("/")
        path = f"{url}/api/v1/sessions/{self.ids['star']}/stream"
        message = json.dumps({"type": "command", "id": "1", "text": LONG_QUESTION})

        async def client() -> None:
            async with connect(path, max_queue=1, compression=None) as stream:
                for _ in range(100):
                    await stream.send(message)
                    outcomes["sent"] += 1
                await asyncio.sleep(600)

        async with asyncio.TaskGroup() as group:
            for _ in range(CLIENTS):
                group.create_task(client())

    async def dear_sessions(self, outcomes: Counter[str]) -> None:
        """Live sessions whose ticks are dear."""
        made = []
        for seed, name in enumerate(("star", "exact", "star", "long", "exact")):
            body = {"config": {**ROADS[name], "seed": seed + 5}}
            made.append((await self._post("/sessions", body))["id"])
        try:
            await asyncio.sleep(600)
        finally:
            for each in made:
                await self._http.delete(f"/api/v1/sessions/{each}")
                outcomes["run"] += 1

    async def _post(self, path: str, body: object) -> dict[str, str]:
        answer = await self._http.post(f"/api/v1{path}", json=body)
        answer.raise_for_status()
        value: dict[str, str] = answer.json()
        return value

    async def _loop(self) -> float:
        """The longest hold of the event loop since this was last asked, in seconds of processor time."""
        return float((await self._http.get("/loop")).text)

    async def _lateness(self) -> dict[float, float]:
        """Ticks up to each bound of lateness, in seconds."""
        text = (await self._http.get("/metrics")).text
        name = "roadtalk_tick_lateness_seconds_bucket"
        found = (line.split() for line in text.splitlines() if line.startswith(name))
        return {float(label.split('"')[1]): float(count) for label, count in found}


def _outcome(answer: httpx.Response) -> str:
    if not answer.is_error:
        return str(answer.status_code)
    return f"{answer.status_code} {answer.json()['type'].rpartition('/')[2]}"


def _difference(before: dict[float, float], after: dict[float, float]) -> tuple[int, str, float]:
    """Ticks between two readings, the bound of 99 % of them, in ms, and how many % were later than 20 ms."""
    counts = {bound: after[bound] - before[bound] for bound in after}
    ticks = counts[float("inf")]
    p99 = next((bound for bound, count in counts.items() if count >= 0.99 * ticks), float("inf"))
    late = 100 * (1 - counts[0.02] / ticks) if ticks else 0.0
    return int(ticks), f"≤ {p99 * 1e3:g}", late


async def measured(url: str, pid: int, others: int, seconds: float, only: str) -> None:
    """Print the table."""
    table = Table(url, pid)
    await table.prepare(others)
    print(
        "| request | loop held, CPU ms | ticks | lateness p99, ms | later than 20 ms, % "
        "| healthz p99, ms | max | MB | outcomes |"
    )
    print("| --- " * 9 + "|", flush=True)

    async def nothing(_: Counter[str]) -> None:
        await asyncio.sleep(seconds)

    await table.row("nothing", 2 * seconds, nothing)
    for case in CASES:
        if only in case.name:
            await table.row(case.name, seconds, lambda outcomes, case=case: table.ask(case, outcomes))
    if not only:
        await table.row("sockets that never read", 2 * seconds, table.silent_sockets)
        await table.row("live sessions with dear ticks", 3 * seconds, table.dear_sessions)
        await table.row("nothing, afterwards", 2 * seconds, nothing)


def main() -> None:
    """Read the options, start a service and measure it."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--others", type=int, default=50, help="sessions that behave, two ticks a second")
    options.add_argument("--seconds", type=float, default=4.0, help="for each row")
    options.add_argument("--only", default="", help="rows whose name contains this")
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "tools.watched_service", "serve", "--port", "0"]
        command += ["--database", f"sqlite:///{folder}/roadtalk.db"]
        service = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)
        try:
            assert service.stdout is not None
            url = service.stdout.readline().rsplit(" ", 1)[-1].strip()
            asyncio.run(measured(url, service.pid, given.others, given.seconds, given.only))
            began = time.perf_counter()
            service.terminate()
            service.wait(30)
            print(f"SIGTERM: ended after {time.perf_counter() - began:.1f} s")
        finally:
            service.kill()
            service.wait()


if __name__ == "__main__":
    main()
