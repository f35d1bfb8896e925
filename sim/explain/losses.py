"""What the decisions of an episode have cost against the quickest way, each from its own moment.

The quickest ways before and after each move are searched (`sim.oracle.lower_bounds`), so a loss is exact
where nothing is left to chance. Where it is, nothing is claimed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.explain.alternatives import after_move
from sim.explain.question_error import QuestionError
from sim.oracle.lower_bounds import PATIENCE, least_ticks
from sim.search.reactive import ImpatientError
from sim.session.timeline import Timeline
from sim.types import Move

MOST_TICKS: Final = 200
"""Ticks of an episode whose decisions are judged; of a longer one the last."""


@dataclass(frozen=True, slots=True)
class Loss:
    """A decision that cost something."""

    tick: int
    move: Move
    ticks: int | None
    """ticks lost; None where it gave away the last way to the goal"""


@dataclass(frozen=True, slots=True)
class Losses:
    """What the decisions of an episode have cost."""

    first: int
    last: int
    judged: int
    """decisions whose loss is known"""
    unknown: int
    """decisions of which it is not known: no way led to the goal any more, or the search became too long"""
    found: tuple[Loss, ...]
    """those that cost something, the dearest first, else in their order"""

    @property
    def ticks(self) -> int:
        """Ticks lost in all, without what gave away the last way."""
        return sum(loss.ticks or 0 for loss in self.found)


def losses(timeline: Timeline) -> Losses:
    """What the decisions of the present episode have cost, for the first ego.

    Raises `QuestionError`: `losses_by_chance` where it is left to chance how others react, `nothing_yet`
    where nothing was decided in it.
    """
    state = timeline.state
    if not state.config.certain:
        raise QuestionError("losses_by_chance")
    world = state.world
    last = timeline.tick if world.ended is None else world.ended
    first = max(world.episode_start, last - MOST_TICKS)
    found, judged, unknown = [], 0, 0
    for before in timeline.between(first, last) if first < last else ():
        decision = timeline.decided(before)
        if decision is None:
            continue
        try:
            best = least_ticks(before, PATIENCE)
            rest = None if best is None else least_ticks(after_move(before, decision.move), PATIENCE)
        except ImpatientError:
            best = None
        if best is None:
            unknown += 1
            continue
        judged += 1
        lost = None if rest is None else 1 + rest - best
        if lost != 0:
            found.append(Loss(before.world.tick, decision.move, lost))
    if not judged and not unknown:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    found.sort(key=lambda loss: (loss.ticks is not None, -(loss.ticks or 0), loss.tick))
    return Losses(first, last, judged, unknown, tuple(found))
