"""A worker process, from the service's side: starts it, sends it calls, kills it."""

from __future__ import annotations

import asyncio
import sys
from asyncio.subprocess import PIPE, Process
from contextlib import suppress
from typing import Final

from service.work.codec import LENGTH
from service.work.worker_main import READY

START_S: Final = 60.0
"""Time for a process to start; a second is usual, on a busy machine more."""


_PROGRAM: Final = "import sys; sys.path[:] = sys.argv[2:]; from service.work.worker_main import main; main(int(sys.argv[1]))"
"""It imports from where the service does, whatever folder that was started in."""


class WorkerLostError(Exception):
    """The process ended before it answered: killed for its memory, or by somebody."""


class Worker:
    """One worker process; started when it is first needed, and again after it was killed."""

    def __init__(self, memory_mb: int) -> None:
        self._memory_mb = memory_mb
        self._process: Process | None = None

    @property
    def pid(self) -> int | None:
        """The process, while there is one."""
        return None if self._process is None else self._process.pid

    async def call(self, packed: bytes) -> bytes:
        """The answer to a packed call. Raises `WorkerLostError`; kills the process when cancelled."""
        try:
            process = self._process or await self._start()
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(LENGTH.pack(len(packed)))
            process.stdin.write(packed)
            await process.stdin.drain()
            head = await process.stdout.readexactly(LENGTH.size)
            return await process.stdout.readexactly(LENGTH.unpack(head)[0])
        except (asyncio.IncompleteReadError, OSError) as error:
            self.kill()
            raise WorkerLostError("the worker process ended before it answered") from error
        except BaseException:  # lost before it began, or cancelled: what is under way is of no use to anybody
            self.kill()
            raise

    def kill(self) -> None:
        """End the process at once, whatever it does."""
        process, self._process = self._process, None
        if process is not None:
            with suppress(ProcessLookupError):
                process.kill()

    async def _start(self) -> Process:
        command = [sys.executable, "-c", _PROGRAM, str(self._memory_mb), *sys.path]
        self._process = process = await asyncio.create_subprocess_exec(*command, stdin=PIPE, stdout=PIPE)
        assert process.stdout is not None
        try:
            async with asyncio.timeout(START_S):
                said = await process.stdout.readline()
        except TimeoutError:
            said = b""
        if said != READY:
            raise WorkerLostError("the worker process did not start")
        return process
