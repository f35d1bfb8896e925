"""Files that are there as a whole or not at all, whatever happens while they are written."""

from __future__ import annotations

import errno
import glob
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import IO

PARTIAL = ".partial"
"""How the name of a file ends that is still being written."""


@contextmanager
def whole_file(path: Path, *, replace: bool = False) -> Iterator[IO[bytes]]:
    """A file to write, which gets its name when it is on disk; nothing is left where writing fails.

    Raises `OSError`; `FileExistsError` where the name is taken and `replace` is false.
    """
    if path.exists() and not replace:
        raise _taken(path)
    with NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", suffix=PARTIAL, delete=False) as file:
        written = Path(file.name)
        try:
            yield file
            file.flush()
            os.fsync(file.fileno())
            if path.exists() and not replace:  # somebody else took the name meanwhile
                raise _taken(path)
            os.replace(written, path)
        except BaseException:
            written.unlink(missing_ok=True)
            raise
    sync_folder(path.parent)


def _taken(path: Path) -> FileExistsError:
    return FileExistsError(errno.EEXIST, "is there already", str(path))


def remove_partial(path: Path) -> None:
    """Remove what an earlier process left half written for a name."""
    for left in path.parent.glob(f".{glob.escape(path.name)}.*{PARTIAL}"):
        left.unlink(missing_ok=True)


def sync_folder(folder: Path) -> None:
    """Make names in a folder durable, where the system can."""
    try:
        opened = os.open(folder, os.O_RDONLY)
    except OSError:  # Windows opens no folders
        return
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def new_partial(path: Path) -> Path:
    """An empty file for something that is written in full before it is read; whoever made it removes it."""
    with NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", suffix=PARTIAL, delete=False) as file:
        return Path(file.name)
