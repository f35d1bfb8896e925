"""Who has a SQLite file open when it is locked, as far as it can be known truly.

Linux tells of every lock which process holds it; elsewhere, and on file systems that name files otherwise,
nobody is named. Looked up in a list, not by trying the lock: closing a file that was opened for that would
let go of locks of this very process.
"""

from __future__ import annotations

import os
from itertools import pairwise
from pathlib import Path

_LOCKS = Path("/proc/locks")

_ADVICE = "Stop that one, or name another file in ROADTALK_DATABASE"


def told(path: Path) -> str:
    """Who holds a locked file, in a sentence, and what can be done."""
    process = holder(path)
    if process is None:
        return f"another program, perhaps another Roadtalk service, has it open. {_ADVICE}"
    if process == os.getpid():
        return f"this service has it open already (process {process})"
    return f"{_who(process)} (process {process}) has it open. {_ADVICE}"


def holder(path: Path) -> int | None:
    """The process that holds a lock on a file, None where that is not known."""
    try:
        about = path.stat()
        lines = _LOCKS.read_text("ascii").splitlines()
    except (OSError, ValueError):
        return None
    name = f"{os.major(about.st_dev):02x}:{os.minor(about.st_dev):02x}:{about.st_ino}"
    for line in lines:
        # "1: POSIX  ADVISORY  WRITE 5419 fe:00:2679013 1073741824 1073742335"; with "->" it only waits
        fields = line.split()
        if len(fields) == 8 and fields[5] == name and fields[4].isdecimal() and fields[4] != "0":
            return int(fields[4])
    return None


def _who(process: int) -> str:
    try:
        said = Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return "another program"
    by_name = any(Path(word).name == "roadtalk" for word in said[:2])
    if not by_name and ("-m", "service") not in pairwise(said):
        return "another program"
    return "another Roadtalk service" if "serve" in said else "another Roadtalk program"
