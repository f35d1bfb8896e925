"""Whether SQLite's log of the latest changes (`-wal`) is whole, which SQLite itself does not tell.

SQLite stops reading at the first frame that does not fit and treats the rest as an unfinished change. That is
right after a power cut, but after damage it silently loses acknowledged changes. Each change is on disk
before the next begins, so only the last can be unfinished: if a complete change follows an unreadable one,
the log is damaged. Damage to the very last change, or a file that was cut off, looks like an unfinished
change, and cannot be found.
"""

from __future__ import annotations

import struct
from pathlib import Path

_HEADER, _FRAME = 32, 24
_MAGIC = 0x377F0682
"""Its lowest bit is the order of bytes in the sums."""

_Sums = tuple[int, int]


def defect(path: Path) -> str | None:
    """What is wrong with the log beside a database, in words; None where nothing is, or there is no log."""
    wal = path.with_name(f"{path.name}-wal")
    try:
        content = wal.read_bytes()
    except FileNotFoundError:
        return None
    if len(content) <= _HEADER or not any(content):
        return None
    magic, _, page, _, *salts, one, two = struct.unpack(">8I", content[:_HEADER])
    order = ">" if magic & 1 else "<"
    if magic & ~1 != _MAGIC or _sums(content[: _HEADER - 8], (0, 0), order) != (one, two):
        return f"{wal.name} has no readable beginning"
    frames = [
        content[at : at + _FRAME + page]
        for at in range(_HEADER, len(content) - _FRAME - page + 1, _FRAME + page)
    ]
    bad = _first_unreadable(frames, (one, two), salts, order)
    if bad is None:
        return None
    finished = False
    for frame in frames[bad:]:
        _, pages_then, *its = struct.unpack(">4I", frame[:16])
        if its != salts:
            continue
        if finished:
            return f"{wal.name} cannot be read from change {bad + 1} of {len(frames)} on"
        finished = pages_then != 0
    return None


def _first_unreadable(frames: list[bytes], before: _Sums, salts: list[int], order: str) -> int | None:
    for number, frame in enumerate(frames):
        *its, one, two = struct.unpack(">4I", frame[8:_FRAME])
        before = _sums(frame[_FRAME:], _sums(frame[:8], before, order), order)
        if its != salts or before != (one, two):
            return number
    return None


def _sums(content: bytes, before: _Sums, order: str) -> _Sums:
    """SQLite's running sums over pairs of 32 bits."""
    one, two = before
    words = iter(struct.unpack(f"{order}{len(content) // 4}I", content))
    for word in words:
        one = (one + word + two) & 0xFFFFFFFF
        two = (two + next(words) + one) & 0xFFFFFFFF
    return one, two
