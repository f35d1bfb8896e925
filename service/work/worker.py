"""A worker process, from the service's side: starts it, sends it calls, kills it.

A thread waits for each answer, without the interpreter lock; so no event loop owns the process, and one that
nobody refers to any more is ended.
"""

from __future__ import annotations

import subprocess
import sys
import threading
import weakref
from contextlib import suppress
from subprocess import PIPE, Popen
from typing import IO, Final

from anyio import CapacityLimiter, to_thread

from service.work.codec import LENGTH, SHARE
from service.work.progress import Heard
from service.work.worker_main import READY

END_S: Final = 2.0
"""How long a killed process is waited for at the end of this program; it takes tens of milliseconds."""

_PROGRAM: Final = (
    "import sys; sys.path[:] = sys.argv[2:]; "
    "from service.work.worker_main import main; main(int(sys.argv[1]))"
)
"""It imports from where the service does, whatever folder that was started in."""


class WorkerLostError(Exception):
    """The process ended before it answered: killed for its memory, or by somebody."""


class Worker:
    """One worker process, for one call at a time; started when needed, and again after it was killed."""

    def __init__(self, memory_mb: int) -> None:
        self._memory_mb = memory_mb
        self._one = CapacityLimiter(1)
        self._lock = threading.Lock()
        self._kills = 0
        self._process: Popen[bytes] | None = None
        self._ending: weakref.finalize[[Popen[bytes]], Worker] | None = None

    @property
    def pid(self) -> int | None:
        """The process, while there is one."""
        process = self._process
        return None if process is None else process.pid

    async def call(self, packed: bytes, heard: Heard | None = None) -> bytes:
        """The answer to a packed call. Raises `WorkerLostError`; kills the process when cancelled.

        `heard`: told how much of it is done, by calls that tell that.
        """
        try:
            return await to_thread.run_sync(
                self._exchange, packed, self._kills, heard, limiter=self._one, abandon_on_cancel=True
            )
        except BaseException:  # what is under way is of no use to anybody
            self.kill()
            raise

    def kill(self) -> None:
        """End the process at once, whatever it does."""
        with self._lock:
            self._kills += 1
            self._process = None
            ending, self._ending = self._ending, None
        if ending is not None:
            ending()

    def _exchange(self, packed: bytes, kills: int, heard: Heard | None) -> bytes:
        try:
            process = self._process or self._start(kills)
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(LENGTH.pack(len(packed)))
            process.stdin.write(packed)
            process.stdin.flush()
            answer = _read_answer(process.stdout, heard)
        except (OSError, ValueError) as error:  # a pipe that is broken, or was closed by `kill`
            raise WorkerLostError(str(error)) from error
        if not answer:
            raise WorkerLostError("the worker process ended before it answered")
        return answer

    def _start(self, kills: int) -> Popen[bytes]:
        command = [sys.executable, "-c", _PROGRAM, str(self._memory_mb), *sys.path]
        process = Popen(command, stdin=PIPE, stdout=PIPE)
        with self._lock:
            ending = weakref.finalize(self, _end, process)
            if self._kills == kills:
                self._process, self._ending = process, ending
        if self._process is not process:
            ending()
        assert process.stdout is not None
        if process.stdout.readline() != READY:
            raise WorkerLostError("the worker process did not start")
        return process


def _read_answer(answers: IO[bytes], heard: Heard | None) -> bytes:
    """The next answer, after what is told of its progress; empty at the end of the pipe."""
    while True:
        head = answers.read(LENGTH.size)
        size = LENGTH.unpack(head)[0] if len(head) == LENGTH.size else None
        if size != 0:
            return b"" if size is None else answers.read(size)
        share = answers.read(SHARE.size)
        if len(share) == SHARE.size and heard is not None:
            heard(SHARE.unpack(share)[0])


def _end(process: Popen[bytes]) -> None:
    """Kill a process, and wait for its end in a thread: giving back its memory takes tens of milliseconds."""
    process.kill()
    try:
        threading.Thread(target=_reap, args=(process,), name="reaper", daemon=True).start()
    except RuntimeError:  # this program ends
        _reap(process, END_S)


def _reap(process: Popen[bytes], limit_s: float | None = None) -> None:
    """Wait for the end of a killed process, as long as that takes: on a busy machine it may be seconds."""
    with suppress(subprocess.TimeoutExpired):
        process.wait(limit_s)
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            with suppress(OSError, ValueError, RuntimeError):  # broken, or read by a thread at this moment
                pipe.close()
