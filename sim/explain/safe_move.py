"""Whether a move is safe: what it meets, and what comes of driving on after it, both run.

A move is safe if it meets nothing and no future after it ends in a crash. The step itself is judged by what
is there, whatever the sensor shows of it. How sure that is, `sim.explain.assurance` says.
"""

from __future__ import annotations

from dataclasses import dataclass

from sim.explain.alternatives import after_move
from sim.explain.assurance import Assurance, assurance
from sim.explain.foresight import Foresight, driving, foresee, running_state
from sim.oracle.lower_bounds import PATIENCE, can_arrive
from sim.search.reactive import ImpatientError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move
from sim.world import Cause


@dataclass(frozen=True, slots=True)
class SafeMove:
    """A move that could be made now, in facts."""

    state: SimState
    move: Move
    off_road: bool
    hit: Cause | None
    """what the move itself meets"""
    then: Foresight | None
    """how it goes on after it; None where it cannot be made, or hits something"""
    open: bool | None
    """whether a way leads to the goal after it; None where that was not found out, or not asked"""
    assurance: Assurance | None = None
    """how sure it is that the ego keeps clear; None where the move cannot be made, or hits something"""

    @property
    def safe(self) -> bool:
        """Whether it meets nothing, and no crash was found in what comes after."""
        return self.then is not None and self.then.crashes == 0.0

    @property
    def proved(self) -> bool:
        """Whether that is all that can be, rather than futures that were drawn or not run to the end."""
        if self.then is None:
            return True
        drawn = self.then.chances is not None and self.then.chances.futures is not None
        return not drawn and self.then.told


def safe_move(timeline: Timeline, move: Move, *, ego: str | None = None) -> SafeMove:
    """Whether a move is safe now. Raises `QuestionError`."""
    state = running_state(timeline, ego)
    target = state.config.ego_dynamics(state.world.road).target(state.world.avs[state.number(ego)], move)
    if target is None:
        return SafeMove(state, move, True, None, None, None)
    after = after_move(driving(state, ego), move, ego)
    cause = after.world.cause
    if cause is not None and (ego or state.ego().id) in (cause.ego, *cause.ids):
        return SafeMove(state, move, False, cause, None, None)
    then, leads_on = foresee(after, ego, seen=False), leads_to_goal(after, ego)
    sure = assurance(state, then.crashes, lambda: leads_on, move=move, ego=ego)
    return SafeMove(state, move, False, None, then, leads_on, sure)


def leads_to_goal(state: SimState, ego: str | None = None) -> bool | None:
    """Whether a way leads to the goal; None where that takes too long to find out."""
    try:
        return can_arrive(state, PATIENCE, ego)
    except ImpatientError:
        return None
