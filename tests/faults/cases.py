"""Faults of disk, file and clock, done to a real service process, and what comes of them.

Each function does one kind of fault and yields a row for every form of it: what whoever asks is told, how
long the event loop was held meanwhile, how much of what was acknowledged is lost, and whether the service
is well again once the fault is gone. `report` prints them, `test_cases` asserts them.
"""

from __future__ import annotations

import os
import resource
import shutil
import sqlite3
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx

from tests.faults.process import NotStartedError, Watched
from tests.faults.talk import Talk

STALL_S = 0.05
"""The longest a fault may hold the event loop."""


class CannotError(Exception):
    """This machine does not let this fault be made; the message says what it lacks."""


class ForbiddenError(CannotError):
    """It lacks a permission, which nothing that is installed gives."""


@dataclass(frozen=True)
class Row:
    """What came of one fault. `held_s` is None where no service ran, `lost` where nothing can be asked."""

    fault: str
    answer: str
    held_s: float | None = None
    lost: int = 0
    well: bool = True


def told(answer: httpx.Response) -> str:
    """An answer as its status, its type and its sentence."""
    if answer.is_success:
        return str(answer.status_code)
    problem = answer.json()
    return f"{answer.status_code} {problem['type'].removeprefix('/problems/')}: {problem['detail']}"


def url(path: Path) -> str:
    """The database's."""
    return f"sqlite:///{path}"


# The disk


@contextmanager
def small_disk(at: Path, size: str) -> Iterator[Path]:
    """A file system of its own. Raises `CannotError`; there is no way to one but by mounting."""
    at.mkdir()
    if shutil.which("mount") is None:
        raise CannotError("there is no program to mount with (Debian: apt-get install mount)")
    command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(at)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise ForbiddenError(f"nothing can be mounted here: {done.stderr.strip()}")
    try:
        yield at
    finally:
        subprocess.run(["umount", str(at)], check=True)


def full_disk(folder: Path) -> Iterator[Row]:
    """No room: database and log lines on one small disk."""
    with small_disk(folder / "disk", "2m") as disk:
        ballast = disk / "ballast"

        def fill(_: Watched) -> None:
            ballast.write_bytes(bytes(max(0, shutil.disk_usage(disk).free - 32_768)))

        yield _while_writing(
            "disk full (with its log on it)",
            disk / "roads.db",
            fill,
            lambda _: ballast.unlink(),
            errors=disk / "log",
        )


def file_too_large(folder: Path) -> Iterator[Row]:
    """A limit on the size of files, which needs no root."""

    def limit(service: Watched, size: int) -> None:
        resource.prlimit(service.process.pid, resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))

    path = folder / "roads.db"
    yield _while_writing(
        "file size limit reached",
        path,
        lambda service: limit(service, (folder / "roads.db-wal").stat().st_size + 20_000),
        lambda service: limit(service, resource.RLIM_INFINITY),
    )


def _while_writing(
    fault: str,
    path: Path,
    begin: Callable[[Watched], None],
    end: Callable[[Watched], None],
    errors: Path | None = None,
) -> Row:
    service = Watched(url(path), errors=errors)
    try:
        talk = Talk.begin(service)
        begin(service)
        refused = talk.until_refused(service)
        for _ in range(20):
            talk.say(service)
        readable = service.http.get(f"{talk.path}/state").json()["sequence"] == len(talk.said)
        held = service.beats()
        end(service)
        well = readable and talk.say(service).is_success
    finally:
        service.kill()
    return Row(fault, told(refused), held, *_after(path, talk, well))


def _after(path: Path, talk: Talk, well: bool = True) -> tuple[int, bool]:
    """What a service that is started afterwards has lost, and whether it works."""
    service = Watched(url(path))
    try:
        return talk.lost(service), talk.say(service).is_success and well
    finally:
        service.stop()


# Files that cannot be had


def locked(folder: Path) -> Iterator[Row]:
    """Another program holds the file: before the service, and while it runs."""
    path = folder / "roads.db"
    service = Watched(url(path))
    talk = Talk.begin(service)
    with closing(sqlite3.connect(path, timeout=0)) as other:
        try:
            other.execute("BEGIN EXCLUSIVE")
            outcome = "the other program got the lock"
        except sqlite3.OperationalError as error:
            outcome = f"the other program is told: {error}"
    answer = talk.say(service)
    held = service.beats()
    service.stop()
    yield Row("another program wants the file", f"{told(answer)}; {outcome}", held, *_after(path, talk))
    with closing(sqlite3.connect(path)) as other:
        other.execute("PRAGMA locking_mode=EXCLUSIVE")
        other.execute("BEGIN EXCLUSIVE")
        began = time.monotonic()
        answer_at_start = _refusal(path)
        waited = time.monotonic() - began
        other.rollback()
    assert waited < 120
    yield Row("file locked, 5 s and more, at the start", answer_at_start, None, *_after(path, talk))


def read_only(folder: Path) -> Iterator[Row]:
    """The file, its folder, its disk."""
    before = _mortal()
    made = folder / "own"
    made.mkdir()
    path = made / "roads.db"
    service = Watched(url(path))
    talk = Talk.begin(service)
    service.stop()
    for fault, of, mode in (
        ("file read-only", path, 0o444),
        ("folder read-only", made, 0o555),
        ("file unreadable", path, 0o000),
    ):
        was = of.stat().st_mode
        of.chmod(mode)
        answer = _refusal(path, before)
        of.chmod(was)
        yield Row(fault, answer, None, *_after(path, talk))


def _mortal() -> list[str]:
    """What takes from root the right to pass over the modes of files."""
    if os.geteuid() != 0:
        return []
    if shutil.which("setpriv") is None:
        raise CannotError("root needs setpriv to be refused anything (Debian: apt-get install util-linux)")
    caps = "-dac_override,-dac_read_search"
    return ["setpriv", "--bounding-set", caps, "--inh-caps", caps]


def read_only_disk(folder: Path) -> Iterator[Row]:
    """A disk that was mounted for reading."""
    with small_disk(folder / "disk", "2m") as disk:
        path = disk / "roads.db"
        service = Watched(url(path))
        talk = Talk.begin(service)
        service.stop()
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        answer = _refusal(path)
        subprocess.run(["mount", "-o", "remount,rw", str(disk)], check=True)
        yield Row("disk read-only", answer, None, *_after(path, talk))


def _refusal(path: Path, before: list[str] | None = None) -> str:
    """What is said by a service that is not to start."""
    try:
        service = Watched(url(path), before=before or [])
    except NotStartedError as refusal:
        lines = str(refusal).strip().splitlines()
        return f"not started: {lines[-1]}" if len(lines) == 1 else f"not started, in {len(lines)} lines"
    service.stop()
    return "STARTED"


# Damage


@dataclass(frozen=True)
class Damage:
    """Something done to the file of a service that stopped, or was killed (its log still there)."""

    name: str
    do: Callable[[Path], None]
    killed: bool = False


def _overwrite(path: Path, at: int, content: bytes) -> None:
    with path.open("r+b") as file:
        file.seek(at)
        file.write(content)


def _noise(size: int) -> bytes:
    return bytes((7 * at + 131) % 251 for at in range(size))


def _page_of_entries(path: Path) -> None:
    at = path.read_bytes().rindex(b"set potholes") // 4096 * 4096
    _overwrite(path, at, _noise(4096))


def _one_number(path: Path) -> None:
    """What no structure shows: another number in what was done."""
    with closing(sqlite3.connect(path)) as connection:
        (sequence, actions) = connection.execute(
            "SELECT sequence, actions FROM entries WHERE sequence = 2"
        ).fetchone()
        digits = [place for place, each in enumerate(actions) if each.isdigit()]
        other = actions[: digits[0]] + str((int(actions[digits[0]]) + 1) % 9) + actions[digits[0] + 1 :]
        connection.execute("UPDATE entries SET actions = ? WHERE sequence = ?", (other, sequence))
        connection.commit()


def _log(path: Path) -> Path:
    return path.with_name(f"{path.name}-wal")


DAMAGES = (
    Damage("beginning overwritten", lambda path: _overwrite(path, 0, _noise(64))),
    Damage("first page overwritten", lambda path: _overwrite(path, 100, _noise(3_900))),
    Damage("a page in the middle overwritten", _page_of_entries),
    Damage("cut off in the middle", lambda path: os.truncate(path, path.stat().st_size // 2)),
    Damage("not a database at all", lambda path: path.write_text("roads " * 4_000)),
    Damage("one number of one entry changed", _one_number),
    Damage("log of changes: beginning overwritten", lambda path: _overwrite(_log(path), 0, _noise(32)), True),
    Damage(
        "log of changes: middle overwritten",
        lambda path: _overwrite(_log(path), _log(path).stat().st_size // 2, _noise(64)),
        True,
    ),
    Damage(
        "main file, with a log: first page overwritten", lambda path: _overwrite(path, 0, _noise(4_096)), True
    ),
)


def damaged(folder: Path) -> Iterator[Row]:
    """The file, in many ways; in its place comes a copy, and all is well."""
    whole: dict[bool, tuple[Path, Talk]] = {}
    for killed in (False, True):
        path = folder / f"whole-{killed}" / "roads.db"
        path.parent.mkdir()
        service = Watched(url(path))
        whole[killed] = path, Talk.begin(service, 30)
        (service.kill if killed else service.stop)()
    for damage in DAMAGES:
        path, talk = whole[damage.killed]
        place = folder / "damaged"
        shutil.copytree(path.parent, place)
        damage.do(place / "roads.db")
        before = {each.name: each.read_bytes() for each in place.iterdir() if not each.name.endswith("-shm")}
        held: float | None = None
        lost = 0
        try:
            service = Watched(url(place / "roads.db"))
        except NotStartedError as refusal:
            answer = f"not started: {str(refusal).strip().splitlines()[-1].replace(str(place), '')}"
            left = {name: (place / name).read_bytes() for name in before} == before
            answer += "" if left else " FILES WERE CHANGED"
        else:
            service.beats()
            answer = told(service.http.get(f"{talk.path}/state"))
            if answer == "200":
                lost = talk.lost(service)
            held = service.beats()
            service.stop()
        shutil.rmtree(place)
        yield Row(f"damaged: {damage.name}", answer, held, lost)
    for path, talk in whole.values():
        yield Row("the whole file put back", "201", None, *_after(path, talk))


# The clock

_FAKETIME = "/usr/lib/*/faketime/libfaketimeMT.so.1"


def clock_jumps(folder: Path) -> Iterator[Row]:
    """The wall clock, while a session runs: by libfaketime, which stands between Python and the kernel."""
    found = sorted(Path("/").glob(_FAKETIME.lstrip("/")))
    if not found:
        raise CannotError("libfaketime is not installed (Debian: apt-get install libfaketime)")
    for name, jump in (("+3 days", "+3d"), ("-400 days", "-400d")):
        yield _clock_jump(folder / f"roads{jump}.db", folder / f"clock{jump}", str(found[0]), name, jump)


def _clock_jump(path: Path, clock: Path, library: str, name: str, jump: str) -> Row:
    clock.write_text("+0d")
    fake = {
        "LD_PRELOAD": library,
        "FAKETIME_TIMESTAMP_FILE": str(clock),
        "FAKETIME_CACHE_DURATION": "1",
        "FAKETIME_DONT_FAKE_MONOTONIC": "1",
        # Else it takes Python's own lock to wait until a moment of the wall clock, which has always passed:
        # threads that wait for it then run in circles, jump or no jump, and hold the loop up themselves.
        "FAKETIME_FORCE_MONOTONIC_FIX": "0",
    }
    service = Watched(url(path), environment=fake)
    try:
        talk = Talk.begin(service)
        running = service.http.post("/api/v1/sessions", json={"seed": 3}).headers["location"]
        body, key = {"text": "add a pothole"}, {"Idempotency-Key": "before-the-jump"}
        first = service.http.post(f"{talk.path}/commands", json=body, headers=key)
        talk.said.append(body["text"])
        service.beats()
        clock.write_text(jump)
        _until(lambda: service.http.get("/healthz").headers["date"][:16] != first.headers["date"][:16])
        again = service.http.post(f"{talk.path}/commands", json=body, headers=key)
        before = service.http.get(f"{running}/state").json()["tick"]
        newer = Talk.begin(service)
        answer = talk.say(service)
        _until(lambda: service.http.get(f"{running}/state").json()["tick"] > before)
        listed = [item["id"] for item in service.http.get("/api/v1/sessions").json()["items"]]
        well = again.json() == first.json() and listed[0] in newer.path
        held = service.beats()
    finally:
        service.kill()
    kept = "a key sent again is answered the same; the session runs on"
    return Row(f"clock jumps {name}", f"{told(answer)}; {kept}", held, *_after(path, talk, well))


def _until(true: Callable[[], bool], within_s: float = 60) -> None:
    end = time.monotonic() + within_s
    while not true():
        if time.monotonic() > end:
            raise AssertionError("it did not come to pass")
        time.sleep(0.02)


CASES = (full_disk, file_too_large, locked, read_only, read_only_disk, damaged, clock_jumps)
"""What needs no server."""
