"""The moves of a decision in the order in which its planner would have taken them, and by how much."""

from __future__ import annotations

from dataclasses import dataclass

from sim.explain.query import decision_meant
from sim.explain.question_error import QuestionError
from sim.plan import Decision, Measure, Option
from sim.session.timeline import Timeline
from sim.state import SimState


@dataclass(frozen=True, slots=True)
class Ranking:
    """A decision, and the moves that could have come after the one taken."""

    state: SimState
    decision: Decision
    others: tuple[Option, ...]
    """moves that were possible besides the one taken, the best first: by cost, among equals in their order"""

    @property
    def runner_up(self) -> Option | None:
        """The second best move; None where no other was possible."""
        return self.others[0] if self.others else None

    @property
    def gap(self) -> float | None:
        """What the second best costs more, in the decision's measure; None where it has no costs."""
        best, second = self.decision.chosen.cost, self.runner_up
        if best is None or second is None or second.cost is None:
            return None
        return second.cost - best if self.decision.measure in (Measure.COST, Measure.TICKS) else None


def ranking(timeline: Timeline, tick: int | None = None, *, ego: str | None = None) -> Ranking:
    """The latest decision, or that of a tick, with its other moves in their order.

    Raises `QuestionError`, also `person_drove` where a person asked for the move.
    """
    state, decision = decision_meant(timeline, tick, ego)
    if decision.asked is not None:
        raise QuestionError("person_drove", tick=decision.tick)
    possible = [
        option for option in decision.options if option.move is not decision.move and option.cost is not None
    ]
    possible.sort(key=lambda option: option.cost or 0.0)
    return Ranking(state, decision, tuple(possible))
