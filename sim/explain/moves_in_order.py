"""Several moves in order, each made whatever it meets, and what comes of driving on after them: all run.

They begin now, or at a tick of the past; after the last of them the planner drives by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sim.explain.alternatives import after_move
from sim.explain.facts import check_ego
from sim.explain.foresight import Foresight, driving, foresee
from sim.explain.moments import state_at
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome
from sim.world import Cause


@dataclass(frozen=True, slots=True)
class MovesInOrder:
    """Moves that could be made one after the other, in facts."""

    state: SimState
    """the moment at which they begin"""
    moves: tuple[Move, ...]
    made: int
    """how many of them were made, the one that hits something included"""
    last: SimState
    """before the last that was made, or before the one that leads off the road"""
    off_road: bool
    """whether the next one leads off the road"""
    hit: Cause | None
    """what the last that was made meets"""
    then: Foresight | None
    """how it goes on after all of them; None where one of them fails"""
    said_since: int
    """how many actions said after the moment are left out"""

    @property
    def arrived(self) -> bool:
        """Whether the moves themselves lead to the goal."""
        return self.then is not None and self.then.state.world.outcome is Outcome.SUCCESS

    @property
    def fails(self) -> bool:
        """Whether they, or driving on after them, may end in anything but an arrival."""
        return self.then is None or self.then.arrives < 1.0


def moves_in_order(
    timeline: Timeline, moves: Sequence[Move], tick: int | None = None, *, ego: str | None = None
) -> MovesInOrder:
    """What comes of these moves from now or from a tick on, for an ego, the first by default.

    Raises `QuestionError`: `no_such_tick`, and `nothing_ahead` where no drive goes on.
    """
    check_ego(timeline.state, ego)
    start = state_at(timeline, tick)
    if start.world.outcome is not Outcome.RUNNING:
        raise QuestionError("nothing_ahead", outcome=start.world.outcome, tick=start.world.tick)
    since = 0 if tick is None else sum(entry.tick > tick for entry in timeline.entries)
    last = state = driving(start, ego)
    for made, move in enumerate(moves):
        if state.world.outcome is not Outcome.RUNNING:  # it has arrived on the way
            return MovesInOrder(start, tuple(moves), made, last, False, None, foresee(state, ego), since)
        last = state
        dynamics = state.config.ego_dynamics(state.world.road)
        if dynamics.target(state.world.avs[state.number(ego)], move) is None:
            return MovesInOrder(start, tuple(moves), made, last, True, None, None, since)
        state = after_move(last, move, ego)
        if state.world.outcome is Outcome.CRASH:
            return MovesInOrder(start, tuple(moves), made + 1, last, False, state.world.cause, None, since)
    then = foresee(state, ego, seen=False)
    return MovesInOrder(start, tuple(moves), len(moves), last, False, None, then, since)
