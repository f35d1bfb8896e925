"""Asking a planner of another package, waiting no longer than there is time for.

A thread that serves others (`not_in_this_thread`) never waits: there only what was answered before is told.
A piece of work that asks many times (`within`) has one time for all of it, after which every further question
goes unanswered. Leaves out how the planner is run (`worker`), and what is believed of an answer (`answer`).
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
from sim.plan.sandbox.worker import NoAnswerError

NO_WAITING: Final = "is not waited for here"

_nonblocking_threads: set[int] = set()


class _TimeBudget:
    """How long may still be waited."""

    def __init__(self, seconds: float) -> None:
        self.seconds = self.left_s = seconds


_time_budget: ContextVar[_TimeBudget | None] = ContextVar("_time_budget", default=None)


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """All that is asked in here is waited for this long in all."""
    token = _time_budget.set(_TimeBudget(seconds))
    try:
        yield
    finally:
        _time_budget.reset(token)


@contextmanager
def without_waiting() -> Iterator[None]:
    """In this thread nothing is waited for: others would wait with it."""
    thread = threading.get_ident()
    _nonblocking_threads.add(thread)
    try:
        yield
    finally:
        _nonblocking_threads.discard(thread)


def cached_answer(percept: Percept, config: Config) -> Answer | str | None:
    """What the planner answered to this before, or the fault that was met; None if that is not known."""
    return answers.find(key_of(config.planner, question(percept, config)))


def ask(percept: Percept, config: Config) -> Future[Answer]:
    """What the planner that the configuration names answers, once it does.

    The future raises `FaultError` and `SilentError`.
    """
    asked = worker.worker_of(config.planner)
    if asked is not None:
        return asked.ask(percept, config)
    missing: Future[Answer] = Future()
    missing.set_exception(FaultError("is not installed"))
    return missing


def wait_for_answer(percept: Percept, config: Config) -> Answer:
    """The same, waited for. Raises `FaultError` and `SilentError`."""
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
