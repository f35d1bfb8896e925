"""The move that comes next: what is open to the ego, and what the move hangs on, each tried by removal."""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import decide
from sim.explain.factors import is_factor
from sim.explain.facts import Explanation
from sim.explain.foresight import driving, running_state
from sim.explain.question_error import QuestionError
from sim.explain.why_causes import explain_why
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move


@dataclass(frozen=True, slots=True)
class Flip:
    """Things whose removal changes a move."""

    ids: tuple[str, ...]
    """one thing, or several that must go together"""
    move: Move
    """the move without them"""


@dataclass(frozen=True, slots=True)
class ComingMove:
    """A move that has not been made yet, and what it hangs on."""

    state: SimState
    explanation: Explanation

    @property
    def decision(self) -> Decision:
        """The decision that is to come."""
        return self.explanation.decision

    @property
    def flips(self) -> tuple[Flip, ...]:
        """What changes the move by being gone: things that do so alone, else groups of them."""
        found = [
            Flip(each.removed, each.move)
            for each in self.explanation.counterfactuals
            if each.removed and each.move is not self.decision.move and not any(map(is_factor, each.removed))
        ]
        alone = [flip for flip in found if len(flip.ids) == 1]
        return tuple(dict.fromkeys(alone or found))


def coming_decision(timeline: Timeline, *, ego: str | None = None) -> tuple[SimState, Decision]:
    """The decision that the present state leads to if the ego drives by itself. Raises `QuestionError`."""
    state = driving(running_state(timeline, ego), ego)
    decision = decide(state, ego)
    if decision is None:
        raise QuestionError("nothing_yet", tick=state.world.tick)
    if decision.fault is not None:
        raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
    return state, decision


def coming_move(timeline: Timeline, *, ego: str | None = None) -> ComingMove:
    """The coming move, and what it hangs on. Raises `QuestionError`."""
    state, decision = coming_decision(timeline, ego=ego)
    return ComingMove(state, explain_why(state, decision, timeline.announced(state, ego)))
