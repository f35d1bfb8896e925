"""Computed data kept in files from one start to the next, each under the digest of what it is made of.

What is kept is plain data (`marshal`: reading it runs nothing). A file is used only if this user owns it,
nobody else may write it, it was made of the same sources by the same version of Python, and it is whole.
Whatever is wrong with it, or with the folder, it counts as not there, and nothing is said: all of it can be
computed again.
"""

from __future__ import annotations

import contextlib
import hashlib
import marshal
import os
import stat
import sys
import tempfile
from pathlib import Path
from typing import Any, Final

FOLDER_VARIABLE: Final = "ROADTALK_CACHE_DIR"
"""Names the folder; set to nothing, nothing is kept."""

_DIGEST_BYTES: Final = 32


def cache_folder() -> Path | None:
    """Where computed data is kept; None where nothing shall be, or no place is known."""
    given = os.environ.get(FOLDER_VARIABLE)
    if given is not None:
        return Path(given) if given else None
    with contextlib.suppress(RuntimeError):  # a user without a home
        if sys.platform == "win32":
            base = os.environ.get("LOCALAPPDATA")
            return Path(base) / "roadtalk" / "cache" if base else None
        if sys.platform == "darwin":
            return Path.home() / "Library" / "Caches" / "roadtalk"
        base = os.environ.get("XDG_CACHE_HOME")
        return (Path(base) if base else Path.home() / ".cache") / "roadtalk"
    return None


def digest_of(*parts: bytes) -> bytes:
    """A digest of sources, in which no two lists of parts are alike; the version of Python is part of it."""
    digest = hashlib.blake2b(digest_size=_DIGEST_BYTES)
    for part in (sys.version.encode(), *parts):
        digest.update(len(part).to_bytes(8, "big"))
        digest.update(part)
    return digest.digest()


def read_cached(name: str, sources: bytes) -> Any:
    """What is kept under a name for these sources; None where that is nothing usable."""
    folder = cache_folder()
    if folder is None:
        return None
    try:
        file = os.open(folder / name, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0))
        with open(file, "rb") as opened:
            if not _is_ours(os.fstat(opened.fileno())):
                return None
            content = opened.read()
        head, payload = content[: 2 * _DIGEST_BYTES], content[2 * _DIGEST_BYTES :]
        return marshal.loads(payload) if head == sources + digest_of(payload) else None
    except (OSError, ValueError, EOFError, TypeError):
        return None


def write_cached(name: str, sources: bytes, value: Any) -> None:
    """Keep plain data for the next start: a reader finds all of it or what was there before."""
    folder = cache_folder()
    if folder is None:
        return
    try:
        payload = marshal.dumps(value)
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        file, path = tempfile.mkstemp(dir=folder, prefix=f".{name}.")  # readable and writable by us alone
    except (OSError, ValueError):
        return
    try:
        with open(file, "wb") as opened:
            opened.write(sources + digest_of(payload) + payload)
        os.replace(path, folder / name)
    except OSError:
        with contextlib.suppress(OSError):
            os.unlink(path)


def _is_ours(status: os.stat_result) -> bool:
    """Whether a file is one that nobody else can have written."""
    if not stat.S_ISREG(status.st_mode):
        return False
    if not hasattr(os, "geteuid"):  # Windows: the folder is the user's own
        return True
    return status.st_uid == os.geteuid() and not status.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
