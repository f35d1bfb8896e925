"""What lies ahead of the present moment: the arrival, a crash, being stuck. All of it is run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sim.explain.avoidance import UNKNOWN, Avoidable, find_avoidance
from sim.explain.confidence import Confidence, confidence
from sim.explain.episode_rollout import decided, rollout
from sim.explain.foresight import Foresight, driving, foresee, running_state
from sim.explain.planners import PlannerDrive, drive_each, others_than
from sim.oracle.lower_bounds import PATIENCE, quickest_plan
from sim.oracle.outlook import Outlook, outlook
from sim.plan import Decision
from sim.search.reactive import ImpatientError
from sim.session.timeline import Timeline
from sim.state import SimState, StepResult
from sim.types import Move, Outcome

Ticks = Sequence[tuple[SimState, StepResult]]


@dataclass(frozen=True, slots=True)
class Arrival:
    """When the ego arrives, in facts."""

    state: SimState
    confidence: Confidence
    foresight: Foresight
    """one run to the end of the episode, with its chance"""
    instead: PlannerDrive | None
    """where it never arrives: the quickest of the other planners that does"""
    plan: tuple[Move, ...] | None
    """where it never arrives: a way that does; None where there is none, or none was found"""
    outlook: Outlook | None
    """where it never arrives: whether any way leads to the goal; None where that was not found out"""


@dataclass(frozen=True, slots=True)
class CrashAhead:
    """Whether the ego crashes in this episode, in facts."""

    state: SimState
    foresight: Foresight
    last: SimState | None
    """the state before the crash of the one run; None where that run ends otherwise"""
    decision: Decision | None
    """what is decided in it"""
    avoidable: Avoidable
    """of that run: the last move from now on instead of which another keeps clear of any crash"""


@dataclass(frozen=True, slots=True)
class StuckAhead:
    """Whether the ego is stuck, in facts."""

    state: SimState
    foresight: Foresight
    outlook: Outlook | None
    """whether any way leads to the goal; None where that was not found out"""
    plan: tuple[Move, ...] | None
    """a way to the goal, where the planner finds none"""
    waits: int
    """ticks that it stays from now on before it goes on"""

    @property
    def stuck(self) -> bool:
        """Whether it does not come to the goal any more, and does not crash either."""
        if self.outlook is not None and not self.outlook.open:
            return True
        return self.foresight.arrives == 0.0 and self.foresight.crashes == 0.0 and self.foresight.told


def arrival(timeline: Timeline, *, ego: str | None = None) -> Arrival:
    """When the ego (the first by default) arrives. Raises `QuestionError`."""
    state = driving(running_state(timeline, ego), ego)
    sure = confidence(timeline, ego=ego)
    foresight = foresee(state, ego)
    if sure.arrives > 0.0:
        return Arrival(state, sure, foresight, None, None, None)
    found = [each for each in drive_each(state, others_than(state, ego), ego) if each.foresight.arrives > 0.0]
    best = max(found, key=lambda each: (each.foresight.arrives, -each.foresight.story.driven), default=None)
    return Arrival(state, sure, foresight, best, way(state, ego), outlook(state, ego=ego))


def crash_ahead(timeline: Timeline, *, ego: str | None = None) -> CrashAhead:
    """Whether the ego crashes, and what still avoids it. Raises `QuestionError`."""
    state = driving(running_state(timeline, ego), ego)
    foresight = foresee(state, ego)
    ticks = list(rollout(state, ego=ego))
    if foresight.story.outcome is not Outcome.CRASH:
        return CrashAhead(state, foresight, None, None, UNKNOWN)
    decisions = [(before, decided(tick, ego)) for before, tick in ticks]
    driven = [(before, decision) for before, decision in decisions if decision is not None]
    avoidable = find_avoidance(reversed(driven), whole=True) if state.config.certain else UNKNOWN
    return CrashAhead(state, foresight, *driven[-1], avoidable)


def stuck_ahead(timeline: Timeline, *, ego: str | None = None) -> StuckAhead:
    """Whether the ego is stuck. Raises `QuestionError`."""
    state = driving(running_state(timeline, ego), ego)
    foresight = foresee(state, ego)
    found = outlook(state, ego=ego)
    path = foresight.story.path
    waits = next((at for at, move in enumerate(path) if move is not Move.STAY), len(path))
    plan = way(state, ego) if foresight.arrives == 0.0 and found is not None and found.open else None
    return StuckAhead(state, foresight, found, plan, waits)


def way(state: SimState, ego: str | None = None) -> tuple[Move, ...] | None:
    """The moves of a quickest way to the goal; None where there is none, or none was found."""
    try:
        return quickest_plan(state, PATIENCE, ego=ego)
    except ImpatientError:
        return None
