"""How sure it is that the ego arrives in this episode, over all that is drawn only later.

On a road that is seen whole, one thing is not known yet: who will give way or brake (`sim.rules.yielding`).
So the futures form a tree that branches only where a mover beside the ego has a reason to react. Where
the branches meet again, which is soon, they are one: rows that lie behind take no part any more. Mostly the
tree is then small enough to be walked whole, and the share of futures that arrive is exact. Where it is
not, futures are drawn from it, with seeds of their own, and the share has Wilson's interval
(`sim.statistics`).

A future in which the ego is proved to be shut off from the goal, by hazards or by movers in the rows
before it, is followed no further: it does not arrive, however it ends.

Every step is the session's own (`sim.transition.step`) with the draws of its tick set. Work is limited by
decisions taken and never by the clock, so the same moment has the same answer everywhere. What the sensor
will show is not left to chance: it draws as it does in this session. Not foreseen: what a person will do.
In manual mode it is told how it goes if the ego drives from here on by itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from sim.explain.facts import QuestionError, check_ego
from sim.explain.futures import find_ends
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.state import FIRST
from sim.statistics import wilson
from sim.types import Mode, Move, Outcome


class Method(StrEnum):
    """How a confidence was come by."""

    ONE_RUN = "one_run"
    """nothing is left to chance: the one future was run"""
    ALL_FUTURES = "all_futures"
    """every future that can be was run; the share is exact"""
    SAMPLED = "sampled"
    """futures were drawn; the share has an interval"""


@dataclass(frozen=True, slots=True)
class Clarity:
    """How clear a decision was: the move taken against the next best."""

    decision: Decision
    free: int
    """moves that would have met nothing"""
    next_best: Move | None
    """the best of the others that led on; None if there was none"""
    gap: float | None
    """what that would have cost more, in the decision's measure"""


@dataclass(frozen=True, slots=True)
class Confidence:
    """How sure it is that the ego arrives in this episode."""

    tick: int
    method: Method
    arrives: float
    """share of futures in which it arrives"""
    low: float
    high: float
    """the 95 % interval of the share; equal to it where the share is exact"""
    crashes: float
    stuck: float
    shut_off: float
    """shares of the other ends; `shut_off`: proved to have no way left, and no end was waited for"""
    arrival_ticks: tuple[int, int] | None
    """ticks from now of the earliest and the latest arrival that was found"""
    end_ticks: tuple[int, int] | None
    """the same of all ends that were waited for"""
    futures: int | None
    """how many were drawn; None where the share is exact"""
    decisions: int
    """decisions taken for this answer"""
    chance: bool
    """whether who gives way or brakes is drawn at all"""
    by_hand: bool
    """whether a person drives at present, and it is told how it goes if the ego took over"""
    clarity: Clarity | None
    """of the latest decision of this episode, if a planner took it"""

    @property
    def stated(self) -> float:
        """The one figure to state: of a sample, half a case more on either side, never all or none."""
        if self.futures is None:
            return self.arrives
        return (self.arrives * self.futures + 0.5) / (self.futures + 1)


def confidence(timeline: Timeline, *, ego: str | None = None) -> Confidence:
    """How sure it is that the present episode ends with an arrival of an ego, the first by default.

    Others go on as they do: a future ends with the arrival of that ego, or with the episode. Raises
    `QuestionError`.
    """
    state = timeline.state
    check_ego(state, ego)
    if state.world.outcome is not Outcome.RUNNING:
        raise QuestionError("confidence_ended", outcome=state.world.outcome, tick=state.world.tick)
    ends, drawn, work, branched = find_ends(state, ego or FIRST)
    mass = dict.fromkeys((*Outcome, None), 0.0)
    for (outcome, _), chance in ends.items():
        mass[outcome] += chance
    shares = {outcome: each / sum(mass.values()) for outcome, each in mass.items()}
    arrivals = [ticks for outcome, ticks in ends if outcome is Outcome.SUCCESS]
    waited = [ticks for outcome, ticks in ends if outcome is not None]
    arrives = shares[Outcome.SUCCESS]
    low, high = (arrives, arrives) if drawn is None else wilson(round(mass[Outcome.SUCCESS]), drawn)
    method = Method.ALL_FUTURES if branched else Method.ONE_RUN
    return Confidence(
        tick=state.world.tick,
        method=method if drawn is None else Method.SAMPLED,
        arrives=arrives,
        low=low,
        high=high,
        crashes=shares[Outcome.CRASH],
        stuck=shares[Outcome.STUCK],
        shut_off=shares[None],
        arrival_ticks=(min(arrivals), max(arrivals)) if arrivals else None,
        end_ticks=(min(waited), max(waited)) if waited else None,
        futures=drawn,
        decisions=work,
        chance=state.config.mover_behaviour.draws(state.config) or state.config.slips > 0.0,
        by_hand=state.ego(ego).mode is Mode.MANUAL,
        clarity=_clarity(timeline, ego),
    )


def _clarity(timeline: Timeline, ego: str | None) -> Clarity | None:
    if timeline.state.world.episode_tick == 0:
        return None
    decision = timeline.decision(timeline.tick - 1, ego)
    if decision is None or decision.asked is not None or decision.fault is not None:
        return None
    cost = decision.chosen.cost
    free = sum(not option.reason.blocks for option in decision.options)
    others = [
        option for option in decision.options if option.move is not decision.move and option.cost is not None
    ]
    if cost is None or not others:
        return Clarity(decision, free, None, None)
    next_best = min(others, key=lambda option: option.cost or 0.0)
    return Clarity(decision, free, next_best.move, (next_best.cost or 0.0) - cost)
