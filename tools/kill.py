"""A real service killed at random moments under load: `python -m tools.kill --rounds 100`.

Clients talk to it in threads, each to a session of its own. What is in the middle of being asked when
the process dies has an unknown outcome: it is sent again under the same idempotency key once the service
is back. Afterwards the log must hold exactly what was asked, in order, once each; replaying it compares
the digest of every entry. Snapshots are kept after little work, so that sessions come back by them as well as
without. With `--database postgres` the same on a PostgreSQL server of its own.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from urllib.request import urlopen
from uuid import uuid4

import httpx

from tests.support.ports import lasting_port
from tests.support.postgres import binaries, serving

ROUNDS_OF_A_SESSION = 8
SNAPSHOT_WORK = 15
START_S = 120
TEXTS = ("step {n}", "set potholes to {n}", "step {n}", "set barriers to {n}", "step {n}", "undo", "redo")


class LostError(AssertionError):
    """A promise was broken."""


class Service:
    """A service process that can be killed."""

    def __init__(self, database: str) -> None:
        self.port = lasting_port()
        self.url = f"http://127.0.0.1:{self.port}"
        command = [sys.executable, "-m", "service", "serve", "--port", str(self.port), "--database", database]
        self.process = subprocess.Popen(
            command,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env=os.environ | {"ROADTALK_SNAPSHOT_WORK": str(SNAPSHOT_WORK)},
        )
        try:
            self._wait()
        except BaseException:
            self.kill()
            raise

    def _wait(self) -> None:
        until = time.monotonic() + START_S
        while time.monotonic() < until:
            if self.process.poll() is not None:
                raise LostError(f"the service did not start again: {self.process.stderr.read().decode()}")  # type: ignore[union-attr]
            try:
                with urlopen(f"{self.url}/readyz"):
                    return
            except OSError:
                time.sleep(0.02)
        raise LostError(f"the service did not answer within {START_S} s")

    def kill(self, by: signal.Signals = signal.SIGKILL) -> None:
        """Ends the process, and waits until it is gone."""
        self.process.send_signal(by)
        self.process.wait()
        self.process.stderr.close()  # type: ignore[union-attr]


@dataclass
class Client:
    """One who talks to a session of its own, and remembers what was said and answered."""

    dice: random.Random
    said: dict[str, list[str]] = field(default_factory=dict)
    """What was asked, by session; all but perhaps the last is acknowledged."""
    path: str = ""
    moving: bool = False
    """Whether the next thing asked is a new session."""
    pending: tuple[str, dict[str, object], str] | None = None
    acknowledged: int = 0
    retried: int = 0

    def talk(self, url: str, stop: threading.Event) -> None:
        """Ask until the service is gone."""
        with httpx.Client(verify=False, base_url=url, timeout=60) as http:
            try:
                if self.pending is not None:
                    self.retried += 1
                    self._send(http)
                while not stop.is_set():
                    self._next()
                    self._send(http)
            except httpx.TransportError:
                pass  # what is pending is asked again

    def _next(self) -> None:
        if self.moving or not self.path:
            body: dict[str, object] = {"seed": self.dice.randrange(1000), "paused": True}
            self.pending = ("/api/v1/sessions", body, uuid4().hex)
            return
        said = self.said[self.path]
        # The first is something to undo, so that none is refused.
        text = TEXTS[len(said) % len(TEXTS)].format(n=1 + (len(said) // len(TEXTS)) % 6)
        self.pending = (f"{self.path}/commands", {"text": text}, uuid4().hex)

    def _send(self, http: httpx.Client) -> None:
        assert self.pending is not None
        path, body, key = self.pending
        answer = self._ask(http, path, body, key)
        if not answer.is_success:
            raise LostError(f"{body} was refused: {answer.text}")
        self.pending = None
        if "text" not in body:
            self.path, self.moving = answer.headers["location"], False
            self.said[self.path] = []
            return
        self.said[self.path].append(str(body["text"]))
        if answer.json()["sequence"] != len(self.said[self.path]):
            raise LostError(f"{body} became {answer.json()['sequence']}, not {len(self.said[self.path])}")
        self.acknowledged += 1

    def _ask(self, http: httpx.Client, path: str, body: dict[str, object], key: str) -> httpx.Response:
        return http.post(path, json=body, headers={"Idempotency-Key": key})

    def check(self, http: httpx.Client, path: str) -> None:
        """The session holds what was acknowledged, in order, and at most what is pending besides."""
        answer = http.get(f"{path}/recording")
        if not answer.is_success:
            raise LostError(f"{path} did not come back: {answer.text}")
        kept, said = [entry["text"] for entry in answer.json()["entries"]], self.said[path]
        of_pending = self.pending is not None and self.pending[0].startswith(path)
        if kept[: len(said)] != said or len(kept) > len(said) + of_pending:
            raise LostError(
                f"{path} holds {len(kept)} entries where {len(said)} were acknowledged, or others"
            )


@dataclass
class Report:
    """What came of it."""

    rounds: int = 0
    acknowledged: int = 0
    retried: int = 0
    sessions: int = 0
    snapshots: int = 0
    """how often a session came back by one"""
    unfit: int = 0


def run(
    database: str, rounds: int, seed: int = 1, clients: int = 4, most_s: float = 1.0, least: int = 0
) -> Report:
    """Kill it so many times, each time after so many answers at the least. Raises `LostError`."""
    dice = random.Random(seed)
    talkers = [Client(random.Random(dice.random())) for _ in range(clients)]
    for each in range(rounds):
        service = Service(database)
        try:
            _one_round(service, talkers, dice.uniform(0.1, most_s), least)
        finally:
            service.kill()
        if each % ROUNDS_OF_A_SESSION == ROUNDS_OF_A_SESSION - 1:
            for talker in talkers:
                talker.moving = True
    service = Service(database)
    try:
        with httpx.Client(verify=False, base_url=service.url, timeout=60) as http:
            for talker in talkers:
                for path in talker.said:
                    talker.check(http, path)
            used, unfit = _snapshots(http)
    finally:
        service.kill(signal.SIGTERM)
    return Report(
        rounds,
        sum(talker.acknowledged for talker in talkers),
        sum(talker.retried for talker in talkers),
        sum(len(talker.said) for talker in talkers),
        used,
        unfit,
    )


def _snapshots(http: httpx.Client) -> tuple[int, int]:
    """How many sessions came back by a snapshot, and how many have one that did not fit."""
    figures = http.get("/metrics").text
    used, unfit = (
        int(float(re.search(rf'roadtalk_snapshots_total{{fate="{fate}"}} (\S+)', figures)[1]))  # type: ignore[index]
        for fate in ("used", "unfit")
    )
    return used, unfit


def _one_round(service: Service, talkers: list[Client], for_s: float, least: int) -> None:
    before = sum(talker.acknowledged for talker in talkers)
    with httpx.Client(verify=False, base_url=service.url, timeout=60) as http:
        for talker in talkers:
            if talker.path:
                talker.check(http, talker.path)
    stop, failed = threading.Event(), []

    def talk(talker: Client) -> None:
        try:
            talker.talk(service.url, stop)
        except (AssertionError, LookupError, httpx.HTTPError) as error:
            failed.append(error)

    threads = [threading.Thread(target=talk, args=(talker,)) for talker in talkers]
    for thread in threads:
        thread.start()
    time.sleep(for_s)
    # On a slow machine more than that.
    while sum(talker.acknowledged for talker in talkers) < before + least:
        if failed or not any(thread.is_alive() for thread in threads):
            break
        time.sleep(0.01)
    service.process.send_signal(signal.SIGKILL)
    stop.set()
    for thread in threads:
        thread.join()
    if failed:
        raise failed[0]


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--clients", type=int, default=4)
    parser.add_argument("--database", choices=("sqlite", "postgres"), default="sqlite")
    given = parser.parse_args()
    with ExitStack() as stack:
        if given.database == "sqlite":
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            database = f"sqlite:///{folder}/roads.db"
        else:
            programs = binaries()
            if programs is None:
                parser.error("no PostgreSQL server is installed")
            database = stack.enter_context(serving(programs)).new_database()
        began = time.monotonic()
        report = run(database, given.rounds, given.seed, given.clients)
        print(
            f"{given.database}: {report.rounds} rounds, {report.sessions} sessions, {report.acknowledged} "
            f"acknowledged, {report.retried} asked again; 0 lost, 0 twice, 0 digests that differ; "
            f"at the end {report.snapshots} came back by a snapshot, {report.unfit} could not; "
            f"{time.monotonic() - began:.0f} s"
        )


if __name__ == "__main__":
    main()
