"""The spawner: one process, loaded once, from which the processes of planners are forked."""

from __future__ import annotations

import asyncio
import json
import os
import socket
import subprocess
import sys
from typing import Any, Final

from sim.plan.sandbox.answer import CodedError

START_S: Final = 20.0
"""Time limit for a process to start and load its planner."""
_PASSED_ON: Final = (
    "PATH",
    "HOME",
    "LANG",
    "LC_ALL",
    "LC_CTYPE",
    "TMPDIR",
    "TZ",
    "VIRTUAL_ENV",
    "LD_LIBRARY_PATH",
)
"""Environment variables that are passed on; keys and passwords of the service are not."""
_ONE_THREAD: Final = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class Spawner:
    """The spawner process, from which planners' processes are forked. For the planners' thread."""

    def __init__(self) -> None:
        self._turn = asyncio.Lock()
        self._process: subprocess.Popen[bytes] | None = None
        self._socket: socket.socket | None = None

    async def start(self, target: str, *files: int) -> int:
        """Starts a planner's process with these files; returns its process id. Raises `CodedError`."""
        try:
            number = await self._request({"start": target, "paths": _paths()}, *files)
        except (OSError, ValueError) as error:
            raise CodedError("unstartable", detail=str(error)) from error
        assert number is not None
        return number

    async def code(self, number: int) -> int | None:
        """The exit code of a process, negative for a signal; None while it runs."""
        return await self._request({"look": number})

    async def reap(self, number: int) -> None:
        """Has a killed process reaped; its process id may then be reused."""
        await self._request({"reap": number})

    def end(self) -> None:
        """Ends the spawner and, on Linux, all processes it has started."""
        if self._socket is not None:
            self._socket.close()
        if self._process is not None:
            self._process.kill()
            self._process.wait()
        self._socket = self._process = None

    async def _request(self, request: dict[str, Any], *files: int) -> int | None:
        loop = asyncio.get_running_loop()
        async with self._turn:
            if self._socket is None or self._process is None or self._process.poll() is not None:
                self.end()
                self._begin()
            line = self._socket
            assert line is not None
            try:
                async with asyncio.timeout(START_S):
                    socket.send_fds(line, [json.dumps(request).encode() + b"\n"], list(files))
                    answer = b""
                    while not answer.endswith(b"\n"):
                        part = await loop.sock_recv(line, 256)
                        if not part:
                            raise ConnectionError("the process that starts planners has ended")
                        answer += part
            except OSError:  # a planner may have stopped or killed it; TimeoutError is an OSError, too
                self.end()
                raise
        found = json.loads(answer)
        return found if isinstance(found, int) else None

    def _begin(self) -> None:
        ours, theirs = socket.socketpair()
        ours.setblocking(False)
        environment = {key: os.environ[key] for key in _PASSED_ON if key in os.environ}
        environment |= _ONE_THREAD | {"PYTHONPATH": os.pathsep.join(_paths()), "PYTHONDONTWRITEBYTECODE": "1"}
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "sim.plan.sandbox.spawner_main"],
                stdin=theirs.fileno(),
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                env=environment,
                start_new_session=True,  # Linux schedules by session
            )
        self._socket = ours


def _paths() -> list[str]:
    return [os.path.abspath(path) for path in sys.path]
