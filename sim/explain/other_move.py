"""What another move than the one that was made at a past tick would have led to.

The two futures are those of `sim.explain.alternatives`: the move is made whatever it meets, and the planner
goes on by itself after it, as it does after the move that was made.
"""

from __future__ import annotations

from dataclasses import dataclass

from sim.explain.alternatives import Alternatives, stakes
from sim.explain.facts import Explanation, Verified, check_ego
from sim.explain.query import decision_meant
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Mode, Move


@dataclass(frozen=True, slots=True)
class OtherMove:
    """A move that was not made, and where it would have led."""

    explanation: Explanation
    """the moment, its decision and the stakes; what brought the decision about is not looked for"""
    said_since: int
    """how many actions said after the moment are left out"""

    @property
    def stakes(self) -> Alternatives:
        """Both futures."""
        assert self.explanation.stakes is not None
        return self.explanation.stakes


def had_moved(
    timeline: Timeline, move: Move, tick: int | None = None, *, ego: str | None = None
) -> OtherMove:
    """What a move at a tick, or at the latest decision, would have led to for an ego, the first by default.

    Raises `QuestionError`: as for `why`, `was_made` for the move that was made, `off_road`.
    """
    check_ego(timeline.state, ego)
    state, decision = decision_meant(timeline, tick, ego)
    if decision.move is move:
        raise QuestionError("was_made", move=move, tick=decision.tick)
    found = stakes(state.with_ego(ego, mode=Mode.AUTO, queue=()), decision, move)
    if found is None:
        raise QuestionError("no_cell", move=move, tick=decision.tick)
    told = Explanation(
        about="why_not",
        moment=state,
        decision=decision,
        foil=move,
        causes=(),
        verified=Verified(necessary=False, sufficient=False, minimal=False),
        counterfactuals=(),
        stakes=found,
        reruns=2,
    )
    since = sum(entry.tick > decision.tick for entry in timeline.entries)
    return OtherMove(told, since)
