"""Live decisions of dear ticks: taken in the live lane, so that the event loop never waits for them.

A session whose decision is not there when its next tick is due is slowed: it ticks when the answer comes, and
the log says so once. All else goes on, other dear sessions in their turn.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Hashable, Mapping

from service.problems import Stopped
from service.sessions.worker_calls import decide
from service.work.live_lane import LiveLane, NoDecisionError
from service.work.units import LIVE_INLINE, state_tick_units
from sim.plan import Decision
from sim.plan.safe_planning import is_foreign
from sim.state import SimState
from sim.types import Mode, Outcome


class LiveDecision:
    """At most one decision under way, of one session."""

    def __init__(
        self,
        lane: LiveLane,
        take: Callable[[SimState, Mapping[str, Decision]], None],
        fail: Callable[[SimState, str], None],
    ) -> None:
        """`take`: called with the state and its decisions; `fail`: with why there are none."""
        self._lane = lane
        self._take = take
        self._fail = fail
        self._task: asyncio.Task[None] | None = None
        self.slowed = False
        """whether the latest decision was late"""

    @property
    def busy(self) -> bool:
        """Whether a decision is awaited."""
        return self._task is not None

    def ask(self, run: SimState) -> bool:
        """Begin to decide a state, if its tick is dear; needs a running loop."""
        if not is_dear_turn(run):
            self.slowed = False
            return False
        self._task = asyncio.ensure_future(self._decide(run))
        return True

    def cancel(self) -> None:
        """Drop the decision that is awaited."""
        if self._task is not None:
            self._task.cancel()
            self._task = None

    async def _decide(self, run: SimState) -> None:
        try:
            decided = await self._lane.run(decide, run)
        except NoDecisionError as error:
            self._task = None
            self._fail(run, str(error))
        except Stopped:
            self._task = None
        else:
            self._task = None
            self._take(run, decided)


def is_dear_turn(run: SimState) -> bool:
    """Whether the next tick costs more than is done on the event loop, and a planner decides it."""
    if run.world.outcome is not Outcome.RUNNING or not is_dear_to_decide(run):
        return False
    return any(not ego.queue and ego.mode is not Mode.MANUAL for ego in run.egos.values())


def is_dear_to_decide(run: SimState) -> bool:
    """Whether deciding such a state costs more than is done on the event loop.

    Planners of other packages are asked in processes of their own.
    """
    if state_tick_units(run) <= LIVE_INLINE:
        return False
    return not any(is_foreign(run.config_of(id).planner) for id in run.egos)


def deciding_parts(run: SimState) -> Hashable:
    """All that it hangs on where the decisions of the only ego are taken; None where there are several."""
    return (run.config, run.ego().planner, run.world.road) if len(run.egos) == 1 else None
