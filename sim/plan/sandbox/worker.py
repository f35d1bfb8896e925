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
import logging
import os
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
from sim.plan.sandbox.planner_process import CHECK_BYTES, NoAnswerError, PlannerProcess
from sim.plan.sandbox.spawner import START_S, Spawner
from sim.planner_names import installed

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

_LOG = logging.getLogger(__name__)

BUDGET_S: Final = 0.25
"""Time limit of one decision."""
MOST_PROCESSES: Final = 32
"""Most processes; more planners take turns."""
MOST_AT_ONCE: Final = max(4, os.cpu_count() or 1)
"""Most decisions at the same time, so that each has a processor; others wait."""
MOST_STARTING: Final = 2
"""Most processes that start at the same time; others wait."""
MOST_FAILURES: Final = 5
"""After this many failures in a row a planner pauses for `REST_S`."""
REST_S: Final = 30.0

Result = TypeVar("Result")


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
        self._line: PlannerProcess | None = None
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

    async def _start_process(self) -> PlannerProcess:
        async with _planners().starting(self):
            self._line = PlannerProcess(self.name, _planners().spawner)
            await self._line.start(self._target)
            await self._line.ready(self._start_s)
            return self._line

    def drop_process(self) -> None:
        """Kills its process, if any. Call on the planners' thread."""
        line, self._line = self._line, None
        if line is not None:
            line.kill()
        _planners().release(self)


class _Planners:
    """The thread that manages all planners' processes, and the limits on their number."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self.spawner = Spawner()
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
