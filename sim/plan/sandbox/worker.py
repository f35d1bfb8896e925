"""Runs planners of other packages, each in a process of its own, where it can hang, crash or leak alone.

One thread with an event loop manages all processes; callers get futures. A process has a time limit to start
and one for each decision. It gets one socket and nothing else of this process (no files, no settings), and is
stopped while it is not asked (Linux). A process that is late or breaks the protocol is killed with its
children and restarted at the next question; after repeated failures it pauses. The number of processes, and
of simultaneous starts, is limited.

`answer` validates answers. A process has the rights of its user: the sandbox protects the service from
errors, not the user's files from malice.
"""

from __future__ import annotations

import asyncio
import atexit
import json
import logging
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Coroutine
from concurrent.futures import Future
from contextlib import asynccontextmanager, suppress
from functools import cache
from typing import TYPE_CHECKING, Any, Final, TypeVar

from sim.config import Config
from sim.perceive import Percept
from sim.plan.sandbox.answer import (
    MOST_BYTES,
    Answer,
    CodedError,
    FaultError,
    answer_of,
    fault_of,
    load_json,
    parse_answer,
)
from sim.plan.sandbox.answer_cache import AnswerCache, answers, key_of
from sim.plan.sandbox.codec import CHECKED, question
from sim.planner_names import installed

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

_LOG = logging.getLogger(__name__)

BUDGET_S: Final = 0.25
"""Time limit of one decision."""
START_S: Final = 20.0
"""Time limit for a process to start and load its planner."""
MOST_PROCESSES: Final = 32
"""Most processes; more planners take turns."""
MOST_AT_ONCE: Final = max(4, os.cpu_count() or 1)
"""Most decisions at the same time, so that each has a processor; others wait."""
MOST_STARTING: Final = 2
"""Most processes that start at the same time; others wait."""
MOST_FAILURES: Final = 5
"""After this many failures in a row a planner pauses for `REST_S`."""
REST_S: Final = 30.0
CHECK_BYTES: Final = 32_768
"""Most bytes of a full answer for the conformance check."""
LOG_BYTES: Final = 500
"""Most bytes of a process's output that are logged; the rest is dropped."""

_PRINTED_BYTES, _PRINTED_S = 4_096, 0.02
"""Size and interval of reads from a process's output, which slow down a process that floods it."""
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
_LATE_READ_S: Final = 0.005
"""Time for reading an answer that has come when the time limit ends."""
_CAN_PAUSE: Final = sys.platform == "linux"

Result = TypeVar("Result")


class NoAnswerError(Exception):
    """No answer in time; the message follows the planner's name and says which limit was reached."""


class Worker:
    """The process of one planner, started at the first question. Thread-safe; answers come in turn."""

    def __init__(
        self,
        name: str,
        target: str,
        budget_s: float = BUDGET_S,
        start_s: float = START_S,
        memory: AnswerCache | None = answers,
    ) -> None:
        """For the planner at `target` ("module:Class"). Without `memory`, answers are not cached."""
        self.name = name
        self._target = target
        self._budget_s = budget_s
        self._start_s = start_s
        self._memory = memory
        self._turn = asyncio.Lock()
        self._line: _Line | None = None
        self._failures = 0
        self._rests_until = 0.0

    def ask(self, percept: Percept, config: Config) -> Future[Answer]:
        """Asks the planner. The future raises `FaultError` or `NoAnswerError`; do not cancel it."""

        async def asked() -> Answer:
            return await self._ask_once(question(percept, config))

        return _planners().submit(asked())

    def ask_in_full(self, percept: Percept, config: Config) -> Future[tuple[Answer, dict[str, Any]]]:
        """As `ask`, with the claims of the decision, which are not validated."""

        async def asked() -> tuple[Answer, dict[str, Any]]:
            async with self._turn:
                values = load_json(await self._exchange(CHECKED + question(percept, config), CHECK_BYTES))
            if "fault" in values:
                raise fault_of(values)
            if set(values) != {"answer", "claims", "changed"} or not isinstance(values["answer"], dict):
                raise CodedError("more")
            return answer_of(values["answer"]), values

        return _planners().submit(asked())

    def stop(self) -> None:
        """Ends the process and waits for its end."""

        async def stopped() -> None:
            line = self._line
            self.drop_process()
            if line is not None:
                await line.wait_until_reaped()

        _planners().submit(stopped()).result()

    @property
    def idle(self) -> bool:
        """Whether it has a process without a question."""
        return self._line is not None and not self._turn.locked()

    async def _ask_once(self, what: bytes) -> Answer:
        key = key_of(self.name, what)
        async with self._turn:
            found = None if self._memory is None else self._memory.find(key)
            if found is None:
                found = await self._answer_or_fault(what)
                if self._memory is not None:
                    self._memory.note(key, found)
        if isinstance(found, str):
            raise FaultError(found)
        return found

    async def _answer_or_fault(self, what: bytes) -> Answer | str:
        try:
            return parse_answer(await self._exchange(what, MOST_BYTES))
        except FaultError as fault:
            if fault.detail:
                _LOG.info("the planner %s %s: %s", self.name, fault, ascii(fault.detail))
            return str(fault)

    async def _exchange(self, what: bytes, most: int) -> bytes:
        """Sends a question and reads its answer. Raises `FaultError` and `NoAnswerError`."""
        if self._rests_until > time.monotonic():
            raise NoAnswerError(f"has failed {MOST_FAILURES} times in a row and is left alone for now")
        try:
            line = self._line or await self._start_process()
            _planners().mark_used(self)
            async with _planners().deciding:
                told = await line.exchange(what, most, self._budget_s, "did not answer")
        except (NoAnswerError, FaultError):
            self.drop_process()
            self._failures += 1
            if self._failures >= MOST_FAILURES:
                self._rests_until = time.monotonic() + REST_S
            raise
        self._failures = 0
        if _planners().waiting:
            self.drop_process()  # other planners wait for a process
        return told

    async def _start_process(self) -> _Line:
        async with _planners().starting(self):
            self._line = _Line(self.name, _planners().spawner)
            await self._line.start(self._target)
            await self._line.ready(self._start_s)
            return self._line

    def drop_process(self) -> None:
        """Kills its process, if any. Call on the planners' thread."""
        line, self._line = self._line, None
        if line is not None:
            line.kill()
        _planners().release(self)


class _Spawner:
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


class _Line:
    """A planner's process and the socket to it."""

    def __init__(self, name: str, spawner: _Spawner) -> None:
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


class _Planners:
    """The thread that manages all planners' processes, and the limits on their number."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self.spawner = _Spawner()
        self.deciding = asyncio.Semaphore(MOST_AT_ONCE)
        self._start = asyncio.Semaphore(MOST_STARTING)
        self._room = asyncio.Condition()
        self._with_process: dict[Worker, None] = {}
        """least recently asked first"""
        self.waiting = 0
        """number of workers that wait for a process"""
        self._ended = False
        self._announcing: asyncio.Task[None] | None = None
        self._thread = threading.Thread(target=self._run, name="planners", daemon=True)
        self._thread.start()

    def submit(self, work: Coroutine[Any, Any, Result]) -> Future[Result]:
        """Runs a coroutine on the thread."""
        return asyncio.run_coroutine_threadsafe(work, self._loop)

    @asynccontextmanager
    async def starting(self, worker: Worker) -> AsyncIterator[None]:
        """Waits for room for one more process, and for a turn to start it."""
        if self._ended:
            raise NoAnswerError("is asked no more, since the program ends")
        async with self._room:
            if len(self._with_process) >= MOST_PROCESSES:
                idle = next((each for each in self._with_process if each.idle), None)
                if idle is not None:
                    idle.drop_process()
                self.waiting += 1
                try:
                    await self._room.wait_for(lambda: len(self._with_process) < MOST_PROCESSES)
                finally:
                    self.waiting -= 1
            self._with_process[worker] = None
        try:
            async with self._start:
                yield
        except BaseException:
            self.release(worker)
            raise

    def mark_used(self, worker: Worker) -> None:
        """Marks a worker as the most recently asked."""
        self._with_process.pop(worker, None)
        self._with_process[worker] = None

    def release(self, worker: Worker) -> None:
        """Frees the room of a worker whose process has ended."""
        if worker in self._with_process:
            del self._with_process[worker]
            self._announcing = self._loop.create_task(self._announce_room())

    def end(self) -> None:
        """Kills every process and starts no more."""

        async def ended() -> None:
            for worker in list(self._with_process):
                worker.drop_process()
            self.spawner.end()

        if not self._ended:
            self._ended = True
            with suppress(TimeoutError):
                self.submit(ended()).result(5.0)

    async def _announce_room(self) -> None:
        async with self._room:
            self._room.notify_all()

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._loop.run_forever()


@cache
def _planners() -> _Planners:
    planners = _Planners()
    atexit.register(planners.end)
    return planners


@cache
def worker_of(name: str) -> Worker | None:
    """The worker of the installed planner of that name; None if there is none."""
    point = installed().get(name)
    return None if point is None else Worker(name, point.value)


def _paths() -> list[str]:
    return [os.path.abspath(path) for path in sys.path]


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
