"""Faults of a database server, done to a real PostgreSQL under a real service; rows as in `cases`."""

from __future__ import annotations

import signal
import threading
import time
from collections import Counter
from collections.abc import Iterator
from uuid import uuid4

import httpx

from tests.faults.cases import CannotError, Row, told
from tests.faults.process import Watched
from tests.faults.talk import Talk
from tests.support.postgres import Server, binaries, serving

KILLS = 3
TALKERS = 4
STUCK_S = 5.0


def server_faults(_: object = None) -> Iterator[Row]:
    """Locked, standing still, killed under load."""
    programs = binaries()
    if programs is None:
        raise CannotError("no PostgreSQL server is installed")
    with serving(programs) as server:
        yield table_locked(server)
        yield server_gone(server)
        yield killed_under_load(server)


def table_locked(server: Server) -> Row:
    """Another one holds the table for longer than is waited."""
    database = server.new_database()
    service = Watched(database)
    try:
        talk = Talk.begin(service)
        with server.locked(database, "entries"):
            service.beats()
            began = time.monotonic()
            refused = talk.say(service)
            waited = time.monotonic() - began
            held = service.beats()
        well = talk.say(service).is_success
        fault = f"PostgreSQL: table locked by another ({waited:.1f} s waited)"
        return Row(fault, told(refused), held, talk.lost(service), well)
    finally:
        service.stop()


def server_gone(server: Server) -> Row:
    """Killed with nothing under way, and started again."""
    service = Watched(server.new_database())
    try:
        talk = Talk.begin(service)
        server.signal(signal.SIGKILL)
        refused = talk.say(service)
        for _ in range(20):
            talk.say(service)
        held = service.beats()
        server.start()
        well = talk.say(service).is_success
        return Row("PostgreSQL: kill -9", told(refused), held, talk.lost(service), well)
    finally:
        service.stop()


def killed_under_load(server: Server, kills: int = KILLS) -> Row:
    """Killed while many write: whatever has no success is sent again under its key until it has."""
    service = Watched(server.new_database())
    try:
        talks = [Talk.begin(service) for _ in range(TALKERS)]
        stop, answers = threading.Event(), Counter[int]()
        threads = [threading.Thread(target=_load, args=(service, talk, stop, answers)) for talk in talks]
        for thread in threads:
            thread.start()
        for _ in range(kills):
            time.sleep(0.5)
            server.signal(signal.SIGKILL)
            time.sleep(0.3)
            server.start()
        time.sleep(0.5)
        stop.set()
        for thread in threads:
            thread.join()
        held = service.beats()
        lost = sum(talk.lost(service) for talk in talks)
        others = sorted(set(answers) - {200, 503})
        done = f"{answers[200]} acknowledged, {answers[503]} told 503 and sent again"
        fault = f"PostgreSQL: kill -9 under load, {kills} times"
        return Row(fault, f"200; {done}" if not others else f"UNFITTING {others}", held, lost)
    finally:
        service.stop()


def _load(service: Watched, talk: Talk, stop: threading.Event, answers: Counter[int]) -> None:
    with httpx.Client(verify=False, base_url=service.url, timeout=60) as http:
        while not stop.is_set():
            body = {"text": f"set potholes to {1 + len(talk.said) % 9}"}
            key = {"Idempotency-Key": uuid4().hex}
            status = 0
            while status != 200:
                status = http.post(f"{talk.path}/commands", json=body, headers=key).status_code
                answers[status] += 1
                if status != 200:
                    time.sleep(0.02)
                    if stop.is_set() and answers[status] > 10_000:
                        return
            talk.said.append(body["text"])
