"""What the planner would have done where a person drove, and what either move leads to. Both are run.

Where nobody but the planner has driven, its own latest move is judged beside the best that could be done.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Final

from sim.decide import decide
from sim.explain.alternatives import after_move
from sim.explain.facts import check_ego
from sim.explain.foresight import Foresight, driving, foresee
from sim.explain.moments import state_at
from sim.explain.question_error import QuestionError
from sim.oracle.lower_bounds import PATIENCE
from sim.oracle.regret import Regret, regret
from sim.plan import Decision
from sim.search.reactive import ImpatientError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome

LOOK_BACK: Final = 200
"""Ticks in which a move of a person is looked for."""


@dataclass(frozen=True, slots=True)
class OwnMove:
    """A move that was made beside the one of the planner, in facts."""

    state: SimState
    made: Decision
    would: Move
    """what the planner decides there"""
    by_person: bool
    after_made: Foresight
    """how it goes on after the move that was made, if the planner drives from then on"""
    after_would: Foresight
    regret: Regret | None
    """what the move that was made costs against the best; None where that was not found out"""

    @property
    def same(self) -> bool:
        """Whether the planner makes the same move."""
        return self.would is self.made.move

    @property
    def good(self) -> bool:
        """Whether no less comes of the move that was made than of the planner's, and no way is given away."""
        if self.regret is not None and self.regret.lost:
            return False
        return _worth(self.after_made) >= _worth(self.after_would)


def own_move(timeline: Timeline, tick: int | None = None, *, ego: str | None = None) -> OwnMove:
    """The latest move of a person (else the latest), or that of a tick, beside the planner's.

    Raises `QuestionError`.
    """
    check_ego(timeline.state, ego)
    state, made = _made(timeline, tick, ego)
    alone = driving(state, ego)
    decision = decide(alone, ego)
    assert decision is not None
    if decision.fault is not None:
        raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
    lost = None
    with suppress(ImpatientError):
        lost = regret(state, made.move, PATIENCE, ego=ego)
    ends = [foresee(after_move(alone, move, ego), ego) for move in (made.move, decision.move)]
    return OwnMove(state, made, decision.move, made.asked is not None, ends[0], ends[1], lost)


def _made(timeline: Timeline, tick: int | None, ego: str | None) -> tuple[SimState, Decision]:
    """The decision that is meant: of a tick, the latest of a person, or the latest."""
    if tick is not None:
        if tick == timeline.tick:
            raise QuestionError("not_yet", tick=tick)
        state = state_at(timeline, tick)
        decision = timeline.decided(state, ego)
        if decision is None:
            raise QuestionError("result_stood", tick=tick, outcome=state.world.outcome)
        return state, decision
    latest = None
    for state in reversed(list(timeline.between(max(0, timeline.tick - LOOK_BACK), timeline.tick))):
        if state.world.outcome is not Outcome.RUNNING:
            continue
        decision = timeline.decided(state, ego)
        if decision is None:
            continue
        latest = latest or (state, decision)
        if decision.asked is not None:
            return state, decision
        if not _driven_by_hand(timeline):
            break
    if latest is None:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    return latest


def _driven_by_hand(timeline: Timeline) -> bool:
    """Whether a person may have driven at all: something was said."""
    return bool(timeline.entries)


def _worth(seen: Foresight) -> tuple[float, float, int]:
    return seen.arrives, -seen.crashes, -seen.state.world.tick - seen.story.driven
