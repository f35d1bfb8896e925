"""The near future: how safe it is now, and what happens in the next ticks, with its chance.

The chances are those of confidence: from the same futures (`sim.explain.futures`), followed to the end of the
episode, or for the ticks that are asked about.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice
from typing import TypeVar

from sim.explain.assurance import Assurance, assurance
from sim.explain.confidence import Confidence, confidence
from sim.explain.episode_rollout import EpisodeRollout, rollout, summarize
from sim.explain.foresight import Foresight, driving, foresee, running_state
from sim.explain.futures import Futures
from sim.explain.question_error import QuestionError
from sim.explain.safe_move import SafeMove, leads_to_goal, safe_move
from sim.session.timeline import Timeline
from sim.state import FIRST, SimState
from sim.types import Move, Outcome


@dataclass(frozen=True, slots=True)
class RiskNow:
    """How safe the first ego is, in facts."""

    state: SimState
    confidence: Confidence
    foresight: Foresight
    """one run to the end of the episode"""
    stay: SafeMove | None
    """whether staying is safe; only where driving on may end in a crash"""
    assurance: Assurance
    """how sure it is that it keeps clear"""


@dataclass(frozen=True, slots=True)
class ComingTicks:
    """What happens in the next ticks if the planner drives."""

    state: SimState
    ticks: int
    """ticks that were asked about"""
    story: EpisodeRollout
    """one run of as many ticks, or fewer where it ends before"""
    crashes: float
    arrives: float
    """shares of the futures that end so within these ticks"""
    futures: int | None
    """how many were drawn; None where the shares are exact"""
    branched: bool
    """whether anything in these ticks is left to chance"""


T = TypeVar("T")


def _answering(ask: Callable[[], T]) -> T:
    """What comes of it. Raises `QuestionError`: `no_answer` where the planner does not answer."""
    try:
        return ask()
    except QuestionError as error:
        if error.code != "confidence_fault":
            raise
        raise QuestionError("no_answer", **error.facts) from None


def risk_now(timeline: Timeline) -> RiskNow:
    """How safe the first ego is now. Raises `QuestionError`."""
    state = running_state(timeline, None)
    sure = _answering(lambda: confidence(timeline))
    foresight = foresee(driving(state))
    stay = safe_move(timeline, Move.STAY) if sure.crashes > 0.0 else None
    return RiskNow(state, sure, foresight, stay, assurance(state, sure.crashes, lambda: leads_to_goal(state)))


def coming_ticks(timeline: Timeline, ticks: int) -> ComingTicks:
    """What happens in the next ticks. Raises `QuestionError`."""
    state = driving(running_state(timeline, None))
    taken = list(islice(rollout(state), ticks))
    story = summarize(state, taken)
    if state.config.certain:
        ended = {outcome: float(story.outcome is outcome) for outcome in Outcome}
        crashes, arrives = ended[Outcome.CRASH], ended[Outcome.SUCCESS]
        return ComingTicks(state, ticks, story, crashes, arrives, None, branched=False)
    futures = Futures(state, FIRST)
    ends = _answering(lambda: futures.walked(ticks))
    drawn = None
    if ends is None:
        ends = _answering(lambda: futures.drawn(ticks))
        drawn = round(sum(ends.values()))
    total = sum(ends.values())
    shares = {
        outcome: sum(chance for (end, _), chance in ends.items() if end is outcome) / total
        for outcome in (Outcome.CRASH, Outcome.SUCCESS)
    }
    return ComingTicks(
        state,
        ticks,
        story,
        shares[Outcome.CRASH],
        shares[Outcome.SUCCESS],
        drawn,
        branched=futures.branched > 0,
    )
