"""The latest decision of a session: what led to its present state, kept so that it is not taken again."""

from __future__ import annotations

from dataclasses import dataclass

from service.sessions.utterance import Outcome
from sim.plan import Decision
from sim.state import SimState


@dataclass(frozen=True, slots=True)
class LatestDecision:
    """A decision, and the state that it was taken in."""

    key: tuple[int, int]
    """the session's sequence and tick when it led to the present state"""
    state: SimState
    decision: Decision | None
    """None while a result stood"""

    @staticmethod
    def of_steps(outcome: Outcome) -> LatestDecision | None:
        """The last decision of an utterance that ran ticks and did nothing else."""
        ticks = outcome.ticks
        if not ticks or not outcome.only_steps or outcome.before is None:
            return None
        last = ticks[-1]
        before = ticks[-2].state if len(ticks) > 1 else outcome.before
        return LatestDecision((outcome.sequence, last.state.world.tick), before, last.decision)
