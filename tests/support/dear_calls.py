"""Calls for worker processes in tests: ones that never end, die, need too much memory or raise."""

from __future__ import annotations

import os
import signal
import time

from service.problems import FieldProblem, Invalid, PreconditionFailed
from service.work.progress import tell
from sim.session.errors import EditError


def add(one: int, other: int) -> int:
    return one + other


def process_id() -> int:
    return os.getpid()


def never_end() -> None:
    while True:
        time.sleep(60)


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def take_memory(megabytes: int) -> int:
    return len(bytearray(megabytes * 1024 * 1024))


def refuse(how: str) -> None:
    raise {
        "invalid": Invalid("no", errors=[FieldProblem("here", "no")]),
        "stale": PreconditionFailed(3),
        "edit": EditError("no_such_lane", "where", lane=9, lanes=8),
    }[how]


def niceness() -> int:
    return os.nice(0)


def tell_twice() -> str:
    """Tells its progress on the way."""
    tell(0.25)
    tell(0.75)
    return "done"
