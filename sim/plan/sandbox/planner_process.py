"""The process of one planner: starting, asking, pausing and killing it. For the planners' thread."""

from __future__ import annotations

import asyncio
import logging
import os
import signal
import socket
import sys
from contextlib import suppress
from typing import Final

from sim.plan.sandbox.answer import MOST_BYTES, CodedError, fault_of, load_json
from sim.plan.sandbox.spawner import Spawner

_LOG = logging.getLogger(__name__)

CHECK_BYTES: Final = 32_768
"""Most bytes of a full answer for the conformance check."""
LOG_BYTES: Final = 500
"""Most bytes of a process's output that are logged; the rest is dropped."""

_PRINTED_BYTES, _PRINTED_S = 4_096, 0.02
"""Size and interval of reads from a process's output, which slow down a process that floods it."""
_LATE_READ_S: Final = 0.005
"""Time for reading an answer that has come when the time limit ends."""
_CAN_PAUSE: Final = sys.platform == "linux"


class NoAnswerError(Exception):
    """No answer in time; the message follows the planner's name and says which limit was reached."""


class PlannerProcess:
    """A planner's process and the socket to it."""

    def __init__(self, name: str, spawner: Spawner) -> None:
        self._name = name
        self._spawner = spawner
        self._number = 0
        self._process: int | None = None
        self._reader: asyncio.StreamReader | None = None
        self._writer: asyncio.StreamWriter | None = None
        self._reading: asyncio.Future[None] | None = None
        self._reaping: asyncio.Future[None] | None = None

    async def start(self, target: str) -> None:
        """Starts the process. Raises `CodedError`."""
        ours, theirs = socket.socketpair()
        printed, printing = os.pipe()
        try:
            self._process = await self._spawner.start(target, theirs.fileno(), printing)
        except BaseException:
            ours.close()
            os.close(printed)
            raise
        finally:
            theirs.close()
            os.close(printing)
        self._reading = asyncio.ensure_future(self._read_printed(printed))
        self._reader, self._writer = await asyncio.open_unix_connection(sock=ours, limit=CHECK_BYTES)

    async def ready(self, within_s: float) -> None:
        """Waits until the planner is loaded. Raises `NoAnswerError` and `FaultError`."""
        told = load_json(await self._read_answer(0, MOST_BYTES, within_s, "did not start"))
        if told != {"ready": True}:
            raise fault_of(told)
        self._pause()

    async def exchange(self, what: bytes, most: int, within_s: float, late: str) -> bytes:
        """Sends a line and returns the line that answers it. Raises `NoAnswerError` and `CodedError`."""
        assert self._writer is not None
        self._number += 1
        if _CAN_PAUSE:
            self._signal(signal.SIGCONT)
        self._writer.write(b"%d %s\n" % (self._number, what))
        told = await self._read_answer(self._number, most, within_s, late)
        self._pause()
        return told

    async def _read_answer(self, number: int, most: int, within_s: float, late: str) -> bytes:
        assert self._reader is not None
        try:
            line = await self._read_line(within_s)
        except TimeoutError:
            raise NoAnswerError(f"{late} within {within_s:g} s") from None
        except asyncio.LimitOverrunError:
            raise CodedError("too-long") from None
        except (asyncio.IncompleteReadError, ConnectionError):
            raise await self._exit_fault() from None
        if len(line) > most:
            raise CodedError("too-long")
        which, _, told = line.partition(b" ")
        if which != b"%d" % number:
            raise CodedError("out-of-turn")
        return told

    async def _read_line(self, within_s: float) -> bytes:
        """Reads a line. Raises `TimeoutError` if it is not there after `within_s` seconds.

        A busy service may run this thread late: an answer that came in time is then read after the timeout.
        """
        assert self._reader is not None
        try:
            async with asyncio.timeout(within_s):
                return await self._reader.readuntil()
        except TimeoutError:
            async with asyncio.timeout(_LATE_READ_S):
                return await self._reader.readuntil()

    async def _exit_fault(self) -> CodedError:
        """Returns the fault for a closed socket: how the process ended, if it did."""
        assert self._process is not None
        for _ in range(20):
            code = await self._spawner.code(self._process)
            if code is not None:
                return CodedError(
                    "died", f"exit status {code}" if code >= 0 else f"killed by {_signal_name(-code)}"
                )
            await asyncio.sleep(0.01)
        return CodedError("closed")

    def kill(self) -> None:
        """Kills the process and its process group."""
        self._signal(signal.SIGKILL)
        if self._process is not None:
            self._reaping = asyncio.ensure_future(self._reap(self._process))
            self._process = None
        if self._reading is not None:
            self._reading.cancel()
        if self._writer is not None:
            self._writer.transport.abort()

    async def wait_until_reaped(self) -> None:
        """Waits until a killed process is reaped."""
        if self._reaping is not None:
            await self._reaping

    async def _reap(self, process: int) -> None:
        with suppress(OSError, ValueError):  # the spawner has ended, and its children with it
            await self._spawner.reap(process)

    def _pause(self) -> None:
        if _CAN_PAUSE:
            self._signal(signal.SIGSTOP)

    def _signal(self, number: int) -> None:
        if self._process is not None:
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process, number)

    async def _read_printed(self, printed: int) -> None:
        """Logs the beginning of the process's output and discards the rest slowly."""
        loop, reader = asyncio.get_running_loop(), asyncio.StreamReader(limit=_PRINTED_BYTES)
        with os.fdopen(printed, "rb", buffering=0) as end:
            transport, _ = await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), end)
            kept = b""
            try:
                while part := await reader.read(_PRINTED_BYTES):
                    kept += part[: LOG_BYTES - len(kept)]
                    await asyncio.sleep(_PRINTED_S)
            finally:
                transport.close()
                if kept:
                    _LOG.info("the planner %s printed: %s", self._name, ascii(kept.decode(errors="replace")))


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
