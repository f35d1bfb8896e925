"""The program of a worker process: runs one call at a time, at low priority, within a limit of memory.

It ends when the service does: a thread reads the calls, and the end of that pipe ends the process even in the
midst of a call.
"""

from __future__ import annotations

import os
import queue
import signal
import threading
from contextlib import suppress
from functools import partial
from importlib import import_module
from typing import BinaryIO, Final

from service.work.codec import LENGTH, SHARE, run_call
from service.work.progress import tell_through

NICE: Final = 10
"""How much lower than the service's its priority is."""

READY: Final = b"ready\n"

LOADED: Final = ("service.sessions.session", "service.sessions.persistence.replay", "service.narration")
"""What most calls need, imported before the first one comes."""


def main(memory_mb: int) -> None:
    """Answer calls until the pipe ends."""
    calls = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    _silence()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the service's; it ends this process
    lower_priority()
    limit_memory(memory_mb)
    waiting: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    for name in LOADED:
        import_module(name)
    answers.write(READY)
    answers.flush()
    tell_through(partial(_write_share, answers))
    threading.Thread(target=_read, args=(calls, waiting), daemon=True).start()
    while True:
        answer = run_call(waiting.get())
        answers.write(LENGTH.pack(len(answer)))
        answers.write(answer)
        answers.flush()


def lower_priority() -> None:
    """Leave the processor to the service where both want it."""
    with suppress(AttributeError, OSError):
        os.nice(NICE)


def limit_memory(megabytes: int) -> None:
    """Let allocations fail beyond so much memory, where the system can."""
    try:
        import resource

        size = megabytes * 1024 * 1024
        resource.setrlimit(resource.RLIMIT_DATA, (size, size))
    except (ImportError, AttributeError, OSError, ValueError):  # not on this system
        return


def _write_share(answers: BinaryIO, share: float) -> None:
    """Tell the service how much of the call is done; in the thread of the call, so before its answer."""
    answers.write(LENGTH.pack(0) + SHARE.pack(share))
    answers.flush()


def _read(calls: BinaryIO, waiting: queue.SimpleQueue[bytes]) -> None:
    while True:
        head = calls.read(LENGTH.size)
        call = calls.read(LENGTH.unpack(head)[0]) if len(head) == LENGTH.size else b""
        if not call:
            os._exit(0)
        waiting.put(call)


def _silence() -> None:
    """Point the standard streams elsewhere: what a planner prints is no answer."""
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 0)
    os.dup2(nothing, 1)
    os.close(nothing)
