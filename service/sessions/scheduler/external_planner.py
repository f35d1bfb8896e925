"""External planners: asks a planner of another package for a live session's next move.

The event loop never waits for the answer: until it is there the session does not tick, and everything else
goes on. An answer for a state that is no longer the present one is dropped.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress

from sim.decide import sense
from sim.perceive import Percept
from sim.plan import Decision
from sim.plan.safe_planning import is_foreign, plan_answered
from sim.plan.sandbox.answer import Answer
from sim.plan.sandbox.client import ask
from sim.state import SimState
from sim.types import Mode, Outcome


class ExternalPlanner:
    """At most one question under way."""

    def __init__(self, take: Callable[[SimState, Decision], None]) -> None:
        """`take`: called with the state that was asked about and the decision, on the event loop's thread."""
        self._on_decision = take
        self._asked: Future[Answer] | None = None

    @property
    def busy(self) -> bool:
        """Whether an answer is awaited."""
        return self._asked is not None

    def ask(self, run: SimState) -> bool:
        """Ask for the decision in a state if an external planner takes it; needs a running loop."""
        if not is_external_turn(run):
            return False
        percept, loop = sense(run)[0], asyncio.get_running_loop()
        asked = ask(percept, run.config)
        self._asked = asked

        def wake(_: Future[Answer]) -> None:
            with suppress(RuntimeError):  # the loop is gone, and nobody waits any more
                loop.call_soon_threadsafe(self._on_answer, asked, run, percept)

        asked.add_done_callback(wake)
        return True

    def cancel(self) -> None:
        """Drop the answer that is awaited."""
        self._asked = None

    def _on_answer(self, asked: Future[Answer], run: SimState, percept: Percept) -> None:
        if self._asked is asked:
            self._asked = None
            self._on_decision(run, plan_answered(asked.result, percept, run.config))


def is_external_turn(run: SimState) -> bool:
    """Whether a planner of another package takes the next decision."""
    by_hand = bool(run.queue) or run.mode is Mode.MANUAL
    alone = len(run.world.avs) == 1  # of several egos one decides after the other
    return alone and not by_hand and run.world.outcome is Outcome.RUNNING and is_foreign(run.config.planner)
