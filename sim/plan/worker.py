"""A planner from another package in a process of its own, where it can hang, crash or leak alone.

The child is sent what is seen (`Percept`) and the configuration, foretells as far as its planner asks
to read, and sends back the decision. Whatever the planner raises is named; a child that does not
answer in time is killed and a new one started for the next question.
"""

from __future__ import annotations

import atexit
import threading
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from importlib.metadata import EntryPoint
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any, Final

from sim.config import Config
from sim.forecast import foretell
from sim.perceive import Percept
from sim.planner_names import installed

BUDGET_S: Final = 0.25
"""Time for one decision."""
START_S: Final = 20.0
"""Time for a process to start and load its planner."""
MAX_HORIZON: Final = 10_000


class SilentError(Exception):
    """No answer within the time budget."""


class FailedError(Exception):
    """The planner could not be loaded, raised, or took its process down; the message says which."""


class Worker:
    """One planner's process, started when first asked. Safe to use from several threads, one at a time."""

    def __init__(self, point: EntryPoint, budget_s: float = BUDGET_S) -> None:
        """The planner that an entry point names."""
        self._point = point
        self._budget_s = budget_s
        self._lock = threading.Lock()
        self._process: BaseProcess | None = None
        self._pipe: Connection | None = None

    def decide(self, percept: Percept, config: Config) -> Any:
        """What the planner answers, whatever it is. Raises `SilentError`, `FailedError`."""
        with self._lock:
            pipe = self._ready()
            pipe.send((percept, config))
            return self._answer(pipe, self._budget_s)

    def stop(self) -> None:
        """End the process."""
        with self._lock:
            self._kill()

    def _ready(self) -> Connection:
        if self._pipe is not None and self._process is not None and self._process.is_alive():
            return self._pipe
        self._kill()
        context = get_context("spawn")
        pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(self._point, theirs), daemon=True)
        self._process.start()
        theirs.close()
        self._pipe = pipe
        atexit.register(self.stop)
        self._answer(pipe, START_S)
        return pipe

    def _answer(self, pipe: Connection, budget_s: float) -> Any:
        try:
            if not pipe.poll(budget_s):
                self._kill()
                raise SilentError
            done, answer = pipe.recv()
        except (EOFError, OSError):
            code = self._exit_code()
            self._kill()
            raise FailedError(f"its process ended (exit status {code})") from None
        if not done:
            raise FailedError(answer)
        return answer

    def _exit_code(self) -> int | None:
        if self._process is None:
            return None
        self._process.join(1.0)
        return self._process.exitcode

    def _kill(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.join()
        if self._pipe is not None:
            self._pipe.close()
        self._process = self._pipe = None


@cache
def worker_of(name: str) -> Worker | None:
    """The process of the installed planner of that name; None if there is none."""
    point = installed().get(name)
    return None if point is None else Worker(point)


def _serve(point: EntryPoint, pipe: Connection) -> None:
    """The child: load, then answer until the other end is gone."""
    with ThreadPoolExecutor(1) as once:  # a future carries whatever a planner raises
        loaded = once.submit(lambda: point.load()())
        error = loaded.exception()
        pipe.send((error is None, None if error is None else _named("could not be loaded", error)))
        if error is not None:
            return
        planner = loaded.result()

        def decide(percept: Percept, config: Config) -> Any:
            horizon = planner.horizon(config)
            if not isinstance(horizon, int) or not 1 <= horizon <= MAX_HORIZON:
                raise ValueError(f"a horizon of {horizon!r} ticks")
            return planner.decide(foretell(percept, horizon), config)

        while True:
            try:
                percept, config = pipe.recv()
            except EOFError:
                return
            answered = once.submit(decide, percept, config)
            error = answered.exception()
            pipe.send((error is None, answered.result() if error is None else _named("raised", error)))


def _named(what: str, error: BaseException) -> str:
    return f"{what} {type(error).__name__}: {error}"[:300]
