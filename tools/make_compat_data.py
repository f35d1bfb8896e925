"""Makes the fixtures of a version of the rules, by the code that is here.

`python -m tools.make_compat_data tests/data/v2`, to be run once for each version, before the rules change.
Everything is done in a real service process, over HTTP, and what is expected is what the sessions told
while they were live.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import blake2b
from pathlib import Path
from typing import Any

import httpx

from tests.compat import env_states
from tools.compat_scripts import KEPT, LINKS, RECORDINGS, TAUGHT, Back, Fork, Patch, Script

ROOT = Path(__file__).parents[1]
API = "/api/v1"
EVERY = 10
"""One digest of so many is written down by itself; all of them are in the sum."""
THEN_TICKS = 60
"""How far a session is followed after it was opened again."""
PAGE = 64
START_S = 120.0

Json = dict[str, Any]


@contextmanager
def service(database: str) -> Iterator[httpx.Client]:
    """A service process of its own on a database, stopped gracefully at the end."""
    command = [sys.executable, "-m", "service", "serve", "--port", "0", "--database", database]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        with out.open("w") as told:
            environment = os.environ | {"PYTHONPATH": str(ROOT), "ROADTALK_SNAPSHOT_WORK": "400"}
            process = subprocess.Popen(command, cwd=ROOT, stdout=told, stderr=told, env=environment)
        try:
            with httpx.Client(base_url=_address(out, process), timeout=120) as client:
                yield client
        finally:
            process.terminate()
            process.wait(60)


def _address(out: Path, process: subprocess.Popen[bytes]) -> str:
    until = time.monotonic() + START_S
    while time.monotonic() < until and process.poll() is None:
        found = re.search(r"http://\S+", out.read_text())
        if found is not None:
            return found.group()
        time.sleep(0.05)
    raise RuntimeError(f"the service did not start: {out.read_text()}")


def asked(client: httpx.Client, method: str, path: str, body: Any = None) -> Any:
    """What is answered; raises where it is refused."""
    answer = client.request(method, path if path.startswith(API) else API + path, json=body)
    if not answer.is_success:
        raise RuntimeError(f"{method} {path} {body}: {answer.text}")
    return answer.json()


def played(client: httpx.Client, script: Script, name: str | None = None) -> str:
    """Does what a script says; answers the path of the session it ends in, which has the name."""
    forks = sum(isinstance(deed, Fork) for deed in script.deeds)
    named = {"name": name} if name is not None and not forks else {}
    body: Json = {**script.begin, **named, "paused": True}
    path = API + "/sessions/" + asked(client, "POST", "/sessions", body)["id"]
    for deed in script.deeds:
        match deed:
            case str():
                asked(client, "POST", f"{path}/commands", {"text": deed})
            case int():
                asked(client, "POST", f"{path}/step", {"ticks": deed})
            case dict():
                asked(client, "POST", f"{path}/actions", {"actions": [deed]})
            case Patch(parts):
                asked(client, "PATCH", f"{path}/config", parts)
            case Back(tick):
                asked(client, "POST", f"{path}/rewind", {"tick": tick})
            case Fork(tick, actions):
                forks -= 1
                body = {"at_tick": tick, **({"actions": [*actions]} if actions else {})}
                named = {"name": name} if name is not None and not forks else {}
                path = API + "/sessions/" + asked(client, "POST", f"{path}/forks", {**body, **named})["id"]
            case _:
                asked(client, "POST", f"{path}/actions", {"actions": [*deed]})
    return path


def summed(digests: list[str]) -> str:
    """One sum of many digests."""
    return blake2b("\n".join(digests).encode(), digest_size=16).hexdigest()


def expected(client: httpx.Client, path: str) -> Json:
    """What a session is at every tick, and where it stands."""
    state = asked(client, "GET", f"{path}/state")
    return {
        "tick": state["tick"],
        "digest": state["digest"],
        "episode": state["episode"],
        "planner": state["planner"],
        "metrics": state["metrics"],
        "every": EVERY,
        "digests": (every := _digests(client, path, 0, state["tick"]))[::EVERY],
        "all": summed(every),
    }


def then(client: httpx.Client, path: str) -> Json:
    """How a session goes on, and what it is after its latest change of all is taken back there."""
    now = asked(client, "GET", f"{path}/state")["tick"]
    asked(client, "POST", f"{path}/step", {"ticks": THEN_TICKS})
    on = _digests(client, path, now + 1, now + THEN_TICKS)
    told = {
        "ticks": THEN_TICKS,
        "all": summed(on),
        "metrics": asked(client, "GET", f"{path}/state")["metrics"],
    }
    if asked(client, "GET", f"{path}/state")["undo"]:
        asked(client, "POST", f"{path}/actions", {"actions": [{"do": "undo"}]})
        state = asked(client, "GET", f"{path}/state")
        told["undone"] = {"tick": state["tick"], "digest": state["digest"]}
    return told


def _digests(client: httpx.Client, path: str, first: int, last: int) -> list[str]:
    told: list[str] = []
    for start in range(first, last + 1, PAGE):
        limit = min(PAGE, last + 1 - start)
        page = asked(client, "GET", f"{path}/moments?from={start}&limit={limit}")
        told += [item["state"]["digest"] for item in page["items"]]
    return told


def _trimmed(recording: Json) -> Json:
    entries = [
        {key: value for key, value in each.items() if key != "digest"} for each in recording["entries"]
    ]
    return {**recording, "config": {"seed": recording["config"]["seed"]}, "entries": entries}


def _write(path: Path, value: Any) -> None:
    path.write_text(json.dumps(value, indent=1, ensure_ascii=False) + "\n")


def make_recordings(client: httpx.Client, folder: Path) -> None:
    """A recording and what it must replay to, for each script."""
    folder.mkdir(exist_ok=True)
    for name, script in RECORDINGS.items():
        path = played(client, script, name)
        recording = asked(client, "GET", f"{path}/recording")
        _write(folder / f"{name}.json", _trimmed(recording) if script.trimmed else recording)
        _write(folder / f"{name}.expected.json", {**expected(client, path), "then": then(client, path)})
        print(name, asked(client, "GET", f"{path}/state")["metrics"])


def make_links(client: httpx.Client, folder: Path) -> None:
    """Links that carry their run, and what they must replay to."""
    told: dict[str, Json] = {}
    for name, script in LINKS.items():
        path = played(client, script)
        link = asked(client, "GET", f"{path}/link")
        assert link["carries"]
        told[name] = {"link": link["link"], **expected(client, path), "then": then(client, path)}
    _write(folder / "links.json", told)


def make_database(folder: Path) -> None:
    """A database of kept sessions, in one file, and what each must come back as."""
    with tempfile.TemporaryDirectory() as temporary:
        made = Path(temporary) / "made.db"
        with service(f"sqlite:///{made}") as client:
            for sentence in TAUGHT:
                scratch = asked(client, "POST", "/sessions", {"seed": 1, "paused": True})["id"]
                asked(client, "POST", f"/sessions/{scratch}/commands", {"text": sentence})
                client.delete(f"{API}/sessions/{scratch}").raise_for_status()
            paths = {name: played(client, script, name) for name, script in KEPT.items()}
            told = {name: _kept(client, path) for name, path in paths.items()}
        _one_file(made, folder / "kept.sqlite")
        copy = Path(temporary) / "copy.db"
        shutil.copy(folder / "kept.sqlite", copy)
        with service(f"sqlite:///{copy}") as client:
            for name, path in paths.items():
                told[name]["then"] = then(client, path)
        _write(folder / "kept.expected.json", told)


def _kept(client: httpx.Client, path: str) -> Json:
    session = asked(client, "GET", path)
    saved = asked(client, "GET", f"{path}/saved")["items"]
    return {
        "id": session["id"],
        "sequence": session["sequence"],
        "parent": session["parent"],
        "saved": saved,
        "at_saved": [asked(client, "GET", f"{path}/state?tick={each['tick']}")["digest"] for each in saved],
        **expected(client, path),
    }


def _one_file(database: Path, target: Path) -> None:
    connection = sqlite3.connect(database)
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.execute("PRAGMA journal_mode=DELETE")
    connection.execute("VACUUM")
    counts: Mapping[str, int] = {
        table: connection.execute(f"SELECT count(*) FROM {table}").fetchone()[0]
        for table in ("sessions", "entries", "snapshots", "moments", "phrases")
    }
    connection.close()
    shutil.copy(database, target)
    print(counts, target.stat().st_size)


def main(folder: Path) -> None:
    """Everything there is, into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with service("memory:") as client:
        make_recordings(client, folder / "recordings")
        make_links(client, folder)
    make_database(folder)
    env_states.make(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
