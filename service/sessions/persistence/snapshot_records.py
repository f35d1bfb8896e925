"""Snapshot records: packed snapshots, and the checks before one is used.

A snapshot only saves time: it is used where everything about it fits, and ignored otherwise. It must be whole
(checksum), of this session, of this very program (`version`: a digest of the sources of the rules and of
sessions), made from the log that is in the store now (the log digest), lead to the world that the log names,
and not be later than the entries that follow. Those entries are replayed and checked like in any replay.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Sequence
from functools import cache
from hashlib import blake2b
from importlib.metadata import PackageNotFoundError
from itertools import takewhile
from pathlib import Path
from typing import Any

import orjson
from pydantic import ValidationError

from service.sessions.persistence.log_position import LogPosition
from service.sessions.persistence.session_snapshot import SessionSnapshot
from service.sessions.persistence.snapshot_codec import decode, encode
from service.store import EntryRecord, SessionRecord, SnapshotRecord
from service.version import VERSION
from sim.plan.safe_planning import is_foreign
from sim.planner_names import installed
from sim.session.saved_config import saved_config
from sim.session.serialization import BeliefError

FORMAT = 2
"""Version of the JSON values."""

MAX_BYTES = 4_000_000
"""Largest packed snapshot; larger ones get fewer intermediate states."""

MAX_PLAIN_BYTES = 200_000_000

_MAX_THINNING = 64

_UNREADABLE = (
    ValueError,
    TypeError,
    LookupError,
    AttributeError,
    ArithmeticError,
    ValidationError,
    zlib.error,
    struct.error,
)

_ROOT = Path(__file__).parents[3]
_SOURCES = ("sim/**/*.py", "service/sessions/**/*.py", "service/actions/*.py")


class UnfitError(Exception):
    """A snapshot that is not used; the message says why."""


class TooLargeError(Exception):
    """A session that is too large for a snapshot."""


@cache
def version() -> str:
    """The version of the format and of the program's sources, since worlds of other rules differ."""
    digest = blake2b(VERSION.encode(), digest_size=16)
    for pattern in _SOURCES:
        for path in sorted(_ROOT.glob(pattern)):
            digest.update(path.relative_to(_ROOT).as_posix().encode() + b"\0" + path.read_bytes())
    return f"{FORMAT}.{digest.hexdigest()}"


def pack(frozen: SessionSnapshot, lines: int) -> SnapshotRecord:
    """The record of a snapshot, for a log of so many lines. Raises `TooLargeError`; in any thread."""
    thinned = 1
    while True:
        try:
            values, planners = encode(frozen, thinned)
        except BeliefError as error:
            raise TooLargeError(str(error)) from error
        values |= {"session": frozen.session, "tick": frozen.timeline.tick, "held": lines}
        values["planners"] = _foreign(planners)
        try:
            body = zlib.compress(orjson.dumps(values), 1)
        except TypeError as error:  # half a character
            raise TooLargeError(str(error)) from error
        if len(body) <= MAX_BYTES:
            break
        thinned *= 4
        if thinned > _MAX_THINNING:
            raise TooLargeError(f"{len(body)} bytes")
    parts = (frozen.session, frozen.sequence, frozen.timeline.tick, version())
    return SnapshotRecord(
        session=frozen.session,
        sequence=frozen.sequence,
        tick=frozen.timeline.tick,
        version=version(),
        checksum=_checksum(parts, body),
        body=body,
    )


def unpack(
    snapshot: SnapshotRecord, record: SessionRecord, entries: Sequence[EntryRecord], lines: int
) -> tuple[SessionSnapshot, int]:
    """The snapshot in a record, and the number of entries it covers. Raises `UnfitError`; in any thread."""
    if snapshot.session != record.id or snapshot.version != version():
        raise UnfitError("it is of another session, or made by another version")
    parts = (snapshot.session, snapshot.sequence, snapshot.tick, snapshot.version)
    try:
        if snapshot.checksum != _checksum(parts, snapshot.body):
            raise UnfitError("it is damaged")
        unpacking = zlib.decompressobj()
        values = orjson.loads(unpacking.decompress(snapshot.body, MAX_PLAIN_BYTES))
        if (values["session"], values["sequence"], values["tick"]) != parts[:3] or values["held"] != lines:
            raise UnfitError("it is of another session or moment, or of a log of another length")
        if values["planners"] != _foreign(values["planners"]):
            raise UnfitError("a planner of another package is another now")
        position = _position(snapshot, record, entries, values["trail"])
        frozen = decode(values, record.id)
        _check(frozen, snapshot, record, entries[position - 1] if position else None)
    except _UNREADABLE as error:
        raise UnfitError(f"it cannot be read: {error!r}") from error
    return frozen, position


def _position(
    snapshot: SnapshotRecord, record: SessionRecord, entries: Sequence[EntryRecord], trail: str
) -> int:
    """The number of entries that the snapshot was made from."""
    shared = 0 if record.branch is None else record.branch.sequence
    log_position, position = LogPosition(record), 0
    for entry in takewhile(lambda each: each.sequence <= snapshot.sequence, entries):
        position += 1
        if entry.sequence > shared:
            log_position.append(entry)
    if log_position.digest.hex() != trail:
        raise UnfitError("it is made of another log")
    until = entries[position].tick if position < len(entries) else record.tick
    if snapshot.tick > until:
        raise UnfitError(f"it stands at tick {snapshot.tick}, beyond tick {until}")
    return position


def _check(
    frozen: SessionSnapshot, snapshot: SnapshotRecord, record: SessionRecord, last: EntryRecord | None
) -> None:
    """Raise `UnfitError` unless the snapshot leads to the state that the log names."""
    config = saved_config(record.config)
    if frozen.timeline.tick != snapshot.tick or frozen.timeline.config != config:
        raise UnfitError("it is of another moment, or another road")
    shared = 0 if record.branch is None else record.branch.sequence
    if last is None or last.sequence <= shared or last.digest is None:
        return
    if frozen.timeline.at(frozen.changed_at).world.digest() != last.digest:
        raise UnfitError("it ends in another world")


def _foreign(planners: Iterable[str]) -> dict[str, str]:
    """The planners of other packages, each with the version of its package."""
    return {name: _version_of(name) for name in sorted(planners) if is_foreign(name)}


def _version_of(planner: str) -> str:
    point = installed().get(planner)
    try:
        return "" if point is None or point.dist is None else f"{point.dist.name} {point.dist.version}"
    except PackageNotFoundError:
        return ""


def _checksum(parts: tuple[Any, ...], body: bytes) -> str:
    return blake2b(orjson.dumps(parts) + body, digest_size=16).hexdigest()
