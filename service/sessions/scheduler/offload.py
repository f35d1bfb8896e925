"""Runs work in threads, with a time limit for planners of other packages.

Work that may ask such a planner many times, such as an explanation, has threads of its own, so that slow
planners delay each other and nobody else. One piece of work has one time limit for all their answers.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from typing import Final, TypeVar

from anyio import to_thread

from service.actions import Action
from service.store import EntryRecord
from sim.config import Config
from sim.plan.safe_planning import is_foreign
from sim.plan.sandbox.client import time_limit
from sim.planner_names import installed
from sim.session.timeline import Timeline

QUESTION_S: Final = 10.0
"""Time limit for planners of other packages in all, for a question."""
STEPS_S: Final = 60.0
"""The same for steps, undo and redo."""
REPLAY_S: Final = 120.0
"""The same for the replay of a session."""
THREADS: Final = 4

Result = TypeVar("Result")

_THREADS = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="foreign")


async def run_in_thread(foreign: bool, seconds: float, work: Callable[[], Result]) -> Result:
    """The result of work in a thread; `foreign`: a planner of another package will be asked."""
    patient = with_time_limit(seconds, work)
    if not foreign:
        return await to_thread.run_sync(patient)
    return await asyncio.get_running_loop().run_in_executor(_THREADS, copy_context().run, patient)


def with_time_limit(seconds: float, work: Callable[[], Result]) -> Callable[[], Result]:
    """The work, with so many seconds in all for planners of other packages."""

    def done() -> Result:
        with time_limit(seconds):
            return work()

    return done


def uses_external_planner(timeline: Timeline) -> bool:
    """Whether a question about a timeline asks a planner of another package."""
    return is_foreign(timeline.state.config.planner) or is_foreign(timeline.config.planner)


def names_external_planner(actions: Iterable[Action]) -> bool:
    """Whether one of the actions selects a planner of another package."""
    chosen = (getattr(action, key, None) for action in actions for key in ("planner", "value"))
    return any(isinstance(each, str) and each in installed() for each in chosen)


def uses_installed_planner(config: Config, entries: Iterable[EntryRecord]) -> bool:
    """Whether a replay may ask a planner of another package, as the configuration or some entry says."""
    if is_foreign(config.planner):
        return True
    names = installed()
    return bool(names) and any(
        value in names
        for entry in entries
        for action in entry.actions
        for value in action.values()
        if isinstance(value, str)
    )
