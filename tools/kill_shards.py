"""Shards of a service killed at random moments under load: `python -m tools.kill_shards --rounds 20`.

As `tools.kill`, but the service goes on: of its processes one after the other is killed, and clients that get
503 or lose their connection ask again under the same idempotency key. Afterwards every session holds exactly
what was asked, in order, once each. A session that comes back is replayed, which compares the digest of every
entry. How long each session of the killed shard was away is measured from the kill to the next answer.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

from tests.support.postgres import binaries, serving
from tools.kill import SNAPSHOT_WORK, START_S, Client, LostError

RETRY_S = 0.02
AWAY_S = 120
"""How long a shard may be away at most."""


class ShardedService:
    """A service of several shards, as a process."""

    def __init__(self, database: str, workers: int, environment: dict[str, str] | None = None) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="roadtalk-")
        out, self.errors = Path(self._folder.name) / "out", Path(self._folder.name) / "errors"
        command = [sys.executable, "-m", "service", "serve", "--port", "0", "--workers", str(workers)]
        with out.open("w") as stdout, self.errors.open("w") as stderr:
            self.process = subprocess.Popen(
                [*command, "--database", database],
                stdout=stdout,
                stderr=stderr,
                env=os.environ | {"ROADTALK_SNAPSHOT_WORK": str(SNAPSHOT_WORK)} | (environment or {}),
            )
        try:
            self.url = self._address(out)
        except BaseException:
            self.stop()
            raise

    def _address(self, out: Path) -> str:
        until = time.monotonic() + START_S
        while time.monotonic() < until:
            found = re.search(r"http://\S+", out.read_text())
            if found is not None:
                return found.group()
            if self.process.poll() is not None:
                raise LostError(f"the service did not start: {self.errors.read_text()}")
            time.sleep(0.05)
        raise LostError(f"the service did not start within {START_S} s: {self.errors.read_text()}")

    def shards(self) -> list[dict[str, Any]]:
        """What the service tells of its shards."""
        found: list[dict[str, Any]] = httpx.get(f"{self.url}/healthz", timeout=60).json()["shards"]
        return found

    def kill(self, number: int) -> None:
        """Kill the process of a shard."""
        os.kill(self.shards()[number]["process"], signal.SIGKILL)

    def wait_until_up(self) -> None:
        """Return once all shards are up."""
        until = time.monotonic() + AWAY_S
        while any(each["state"] != "up" for each in self.shards()):
            if time.monotonic() > until:
                raise LostError(f"a shard did not come back: {self.errors.read_text()}")
            time.sleep(RETRY_S)

    def stop(self) -> None:
        """Gracefully."""
        self.process.terminate()
        self.process.wait(60)
        self._folder.cleanup()


@dataclass
class PatientClient(Client):
    """One who asks again until there is an answer."""

    away_s: list[float] = field(default_factory=list)
    """how long it got no answer, each time"""

    def _ask(self, http: httpx.Client, path: str, body: dict[str, object], key: str) -> httpx.Response:
        began = time.monotonic()
        asked = 0
        while True:
            answer = http.post(path, json=body, headers={"Idempotency-Key": key})
            asked += 1
            if answer.status_code != 503:
                break
            if time.monotonic() - began > AWAY_S:
                raise LostError(f"no answer within {AWAY_S} s: {answer.text}")
            time.sleep(RETRY_S)
        if asked > 1:
            self.retried += 1
            self.away_s.append(time.monotonic() - began)
        return answer


@dataclass
class Report:
    """What came of it."""

    kills: int
    sessions: int
    acknowledged: int
    retried: int
    away_s: list[float]


def run(service: ShardedService, kills: int, seed: int = 1, clients: int = 4, pause_s: float = 1.0) -> Report:
    """Kill a shard so many times, each after every client had answers. Raises `LostError`."""
    dice = random.Random(seed)
    talkers = [PatientClient(random.Random(dice.random())) for _ in range(clients)]
    workers = len(service.shards())
    stop, failed = threading.Event(), []

    def talk(talker: PatientClient) -> None:
        try:
            talker.talk(service.url, stop)
            if not stop.is_set():
                failed.append(LostError("the entry was lost"))
        except (AssertionError, LookupError, httpx.HTTPError) as error:
            failed.append(error)

    threads = [threading.Thread(target=talk, args=(talker,), daemon=True) for talker in talkers]
    try:
        for thread in threads:
            thread.start()
        for number in range(kills):
            _wait_for_answers(talkers, failed)
            time.sleep(dice.uniform(0, pause_s))
            service.kill(number % workers)
            _wait_for_answers(talkers, failed)
            service.wait_until_up()
            if number % 3 == 2:
                for talker in talkers:
                    talker.moving = True
        stop.set()
        for thread in threads:
            thread.join(AWAY_S)
        if failed:
            raise failed[0]
        with httpx.Client(base_url=service.url, timeout=60) as http:
            for talker in talkers:
                for path in talker.said:
                    talker.check(http, path)
    finally:
        stop.set()
    return Report(
        kills,
        sum(len(talker.said) for talker in talkers),
        sum(talker.acknowledged for talker in talkers),
        sum(talker.retried for talker in talkers),
        [each for talker in talkers for each in talker.away_s],
    )


def _wait_for_answers(talkers: list[PatientClient], failed: list[BaseException]) -> None:
    """Return once every client has been answered again."""
    before = [talker.acknowledged for talker in talkers]
    until = time.monotonic() + 2 * AWAY_S
    while any(talker.acknowledged <= then for talker, then in zip(talkers, before, strict=True)):
        if failed:
            raise failed[0]
        if time.monotonic() > until:
            raise LostError("a client is not answered")
        time.sleep(RETRY_S)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--clients", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pause", type=float, default=1.0, help="Seconds between kills, at most.")
    given = parser.parse_args()
    with ExitStack() as stack:
        programs = binaries()
        if programs is None:
            parser.error("no PostgreSQL server is installed")
        database = stack.enter_context(serving(programs)).new_database()
        service = ShardedService(database, given.workers)
        stack.callback(service.stop)
        report = run(service, given.rounds, given.seed, given.clients, given.pause)
    away = sorted(report.away_s) or [0.0]
    print(
        f"{given.workers} shards, {report.kills} kills, {report.sessions} sessions, {report.acknowledged} "
        f"acknowledged, {report.retried} asked again; 0 lost, 0 twice, 0 digests that differ; a client was "
        f"without an answer for {statistics.median(away):.2f} s (median), {away[-1]:.2f} s at most; "
        f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    )


if __name__ == "__main__":
    main()
