"""Asks a planner of another package, with a time limit.

A thread that must not block (`without_waiting`) gets cached answers only. Work that asks many times has one
time limit for all its questions (`time_limit`); later questions get no answer. `worker` runs the planner and
`answer` validates what it returns.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from contextvars import ContextVar
from time import monotonic
from typing import Final

from sim.config import Config
from sim.perceive import Percept
from sim.plan.sandbox import worker
from sim.plan.sandbox.answer import Answer, FaultError
from sim.plan.sandbox.answer_cache import answers, key_of
from sim.plan.sandbox.codec import question
from sim.plan.sandbox.planner_process import NoAnswerError

NO_WAITING: Final = "is not waited for here"

_nonblocking_threads: set[int] = set()


class _TimeBudget:
    """The time that is left for waiting, in seconds."""

    def __init__(self, seconds: float) -> None:
        self.seconds = self.left_s = seconds


_time_budget: ContextVar[_TimeBudget | None] = ContextVar("_time_budget", default=None)


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Limits the total time of waiting for answers in this context."""
    token = _time_budget.set(_TimeBudget(seconds))
    try:
        yield
    finally:
        _time_budget.reset(token)


@contextmanager
def without_waiting() -> Iterator[None]:
    """In this thread only cached answers are used in this context, since waiting would block others."""
    thread = threading.get_ident()
    _nonblocking_threads.add(thread)
    try:
        yield
    finally:
        _nonblocking_threads.discard(thread)


def cached_answer(percept: Percept, config: Config) -> Answer | str | None:
    """Returns the cached answer or fault of the configured planner; None if there is none."""
    return answers.find(key_of(config.planner, question(percept, config)))


def ask(percept: Percept, config: Config) -> Future[Answer]:
    """Asks the configured planner. The future raises `FaultError` and `NoAnswerError`."""
    asked = worker.worker_of(config.planner)
    if asked is not None:
        return asked.ask(percept, config)
    missing: Future[Answer] = Future()
    missing.set_exception(FaultError("is not installed"))
    return missing


def wait_for_answer(percept: Percept, config: Config) -> Answer:
    """Asks the configured planner and waits. Raises `FaultError` and `NoAnswerError`."""
    if threading.get_ident() in _nonblocking_threads:
        found = cached_answer(percept, config)
        if found is None:
            raise NoAnswerError(NO_WAITING)
        if isinstance(found, str):
            raise FaultError(found)
        return found
    patience = _time_budget.get()
    if patience is None:
        return ask(percept, config).result()
    began = monotonic()
    try:
        return ask(percept, config).result(max(0.0, patience.left_s))
    except TimeoutError:
        raise NoAnswerError(f"did not answer within {patience.seconds:g} s in all") from None
    finally:
        patience.left_s -= monotonic() - began
