"""A counterfactual to be watched: a run in which something is otherwise, tick by tick, and the real one.

The same two futures as are told in words: those of a move that was not made (`stakes`, where after that
move the planner goes on), and those of a change (`whatif`). Leaves out the words.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from sim.actions import Set, WorldAction
from sim.decide import announced_before, sense
from sim.explain.alternatives import after_move
from sim.explain.episode_rollout import EpisodeRollout, rollout, summarize
from sim.explain.facts import QuestionError, check_ego
from sim.explain.moments import state_at
from sim.forecast import predict
from sim.plan import Decision
from sim.session.edits import apply
from sim.session.timeline import Timeline
from sim.state import EgoStep, SimState, StepResult
from sim.types import Mode, Move, Outcome

Ticks = tuple[tuple[SimState, StepResult], ...]
"""Each tick, with the run before it."""


@dataclass(frozen=True, slots=True)
class Side:
    """One of the two: how it begins, its ticks to the end of the episode, and how that is told."""

    start: SimState
    ticks: Ticks
    story: EpisodeRollout


@dataclass(frozen=True, slots=True)
class SideBySide:
    """Both sides of a moment."""

    tick: int
    real: Side
    changed: Side
    instead_of: Move | None
    """the move that was made, where another one is asked about"""
    said_since: int
    """how many actions said after the moment are left out of both"""


def compare_move(timeline: Timeline, tick: int, move: Move, *, ego: str | None = None) -> SideBySide:
    """What comes of another move than the one an ego (the first by default) decided at a tick.

    It is made whatever it meets.

    After the move the planner goes on, in both. Raises `QuestionError`: `no_such_tick`, `no_decision`
    while a result stood, `off_road`, and `same_move` for the one that was made.
    """
    check_ego(timeline.state, ego)
    state = state_at(timeline, tick)
    decision = timeline.decided(state, ego)
    if decision is None:
        raise QuestionError("no_decision", tick=tick)
    if decision.option(move).cell is None:
        raise QuestionError("off_road", move=move)
    if decision.move is move:
        raise QuestionError("same_move", move=move)
    real, changed = (
        _side(state, tuple(_driven(state, decision, each)), decision.av) for each in (decision.move, move)
    )
    return SideBySide(tick, real, changed, decision.move, _said_since(timeline, tick))


def compare_change(
    timeline: Timeline, tick: int, change: Sequence[WorldAction], *, ego: str | None = None
) -> SideBySide:
    """What comes of a change made at a tick, told of an ego, the first by default.

    Raises `QuestionError` and `EditError`.
    """
    check_ego(timeline.state, ego)
    state = changed = state_at(timeline, tick)
    for action in change:
        changed = apply(changed, action).state
    sides = [
        Side(each, ticks, summarize(each, list(ticks), ego=ego))
        for each in (state, changed)
        for ticks in [tuple(rollout(each, ego=ego))]
    ]
    return SideBySide(tick, sides[0], sides[1], None, _said_since(timeline, tick))


def compare_planners(
    timeline: Timeline, tick: int, planners: tuple[str, str], *, ego: str | None = None
) -> SideBySide:
    """What two planners make of the road of a tick: the first is the `real` side, the second the other.

    Both drive by themselves, whoever drives the session. Raises `QuestionError` and `EditError`.
    """
    check_ego(timeline.state, ego)
    state = state_at(timeline, tick)
    sides = []
    for name in planners:
        start = apply(state, Set(parameter="planner", value=name)).state
        driven = start.with_ego(ego, mode=Mode.AUTO)
        ticks = tuple(rollout(driven, ego=ego))
        sides.append(Side(driven, ticks, summarize(driven, list(ticks), ego=ego)))
    return SideBySide(tick, sides[0], sides[1], None, _said_since(timeline, tick))


def parting(found: SideBySide) -> tuple[SimState, Decision, SimState, Decision] | None:
    """The first tick at which the two decide differently: each side's state there and its decision."""
    for (one, first), (other, second) in zip(found.real.ticks, found.changed.ticks, strict=False):
        if first.decision is None or second.decision is None:
            continue
        if first.decision.move is not second.decision.move:
            return one, first.decision, other, second.decision
    return None


def _side(state: SimState, ticks: Ticks, ego: str) -> Side:
    driven = state.with_ego(ego, mode=Mode.AUTO)
    return Side(state, ticks, summarize(driven, list(ticks), ego=ego))


def _driven(state: SimState, decision: Decision, move: Move) -> Iterator[tuple[SimState, StepResult]]:
    """A move made, and what comes of it."""
    ego = decision.av
    after = after_move(state, move, ego).with_ego(ego, mode=Mode.AUTO)
    percept, belief = sense(state, announced_before(state, ego), ego)
    made = EgoStep(percept, predict(percept, 1), replace(decision, move=move), belief)
    yield state, StepResult(after, {ego: made}, ())
    if after.world.outcome is Outcome.RUNNING:
        yield from rollout(after, ego=ego)


def _said_since(timeline: Timeline, tick: int) -> int:
    return sum(entry.tick > tick for entry in timeline.entries)
