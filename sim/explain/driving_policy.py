"""What comes of driving by a simple rule: straight on, in one lane, to a lane, without stops, standing.

Every tick is run. A move that the rule demands is made whatever it meets; where the rule only forbids moves
the planner decides, and the next best of its options is taken instead of one that is forbidden. Where it is
left to chance how others react, the run is one future of many, and the chances come from the futures of
`sim.explain.futures`, driven by the same rule.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Final

from sim.config import Config
from sim.decide import moves_where
from sim.explain.chances import Chances, shares
from sim.explain.episode_rollout import MAX_FAULTS, MAX_WORK, EpisodeRollout, decided, story, work_of_tick
from sim.explain.facts import check_ego
from sim.explain.foresight import Foresight, driving, foresee
from sim.explain.futures import End, Ends, Futures, Node
from sim.explain.moments import state_at
from sim.explain.question_error import QuestionError
from sim.perceive import Belief
from sim.plan import Decision, traits_of
from sim.repetition import NOTHING_KEPT
from sim.session.timeline import Timeline
from sim.state import FIRST, SimState, StepResult
from sim.transition import step, transition
from sim.types import MOVES, Mode, Move, Outcome
from sim.world import Cause


class Policy(StrEnum):
    """A rule by which every move is made."""

    STRAIGHT = "straight"
    """forward in every tick"""
    STAND = "stand"
    """staying in every tick"""
    IN_LANE = "in_lane"
    """the planner's moves, without those that leave the lane"""
    TO_LANE = "to_lane"
    """towards a lane wherever a move that way is free, and then without leaving it"""
    NONSTOP = "nonstop"
    """the planner's moves, without staying"""


DEMANDED: Final[Mapping[Policy, Move]] = {Policy.STRAIGHT: Move.FORWARD, Policy.STAND: Move.STAY}
"""The one move of a rule."""
FORBIDDEN: Final[Mapping[Policy, frozenset[Move]]] = {
    Policy.IN_LANE: frozenset(move for move in MOVES if move.offset[0]),
    Policy.NONSTOP: frozenset((Move.STAY,)),
}
LAST_RESORT: Final[Mapping[Policy, Move]] = {Policy.IN_LANE: Move.STAY, Policy.NONSTOP: Move.FORWARD}
"""What is made where a rule leaves no free move."""
MOST_TICKS: Final = 6_000
"""How many ticks are run for the chances of a rule that needs no planner."""


@dataclass(frozen=True, slots=True)
class PolicyRun:
    """What comes of driving by a rule, in facts."""

    state: SimState
    """the moment from which it is driven so"""
    policy: Policy
    path: tuple[Move, ...]
    """every move, in order"""
    outcome: Outcome
    """`RUNNING` where it is not told: no answer from the planner, or too much to look through"""
    cause: Cause | None
    """of a crash"""
    cells: int
    """rows that are left behind"""
    chances: Chances | None
    """None where nothing is left to chance: the run is what comes"""
    real: Foresight
    """how it ends if the planner drives as it would"""
    by_hand: EpisodeRollout | None
    """how it ends where a person asks for the move in every tick, so that steps into something are held back;
    only where the run crashes and nothing is left to chance"""
    said_since: int
    """how many actions said after the moment are left out"""
    lane: int | None = None
    """the lane of `TO_LANE`, from 1 at the left"""
    lane_after: int | None = None
    """after how many ticks it is first in that lane; None where it never is"""
    ticks_in_lane: int = 0
    """decisions that were taken in that lane"""

    @property
    def by_chance(self) -> bool:
        """Whether it hangs on chance how it ends."""
        return self.chances is not None and not self.chances.settled

    @property
    def crashes(self) -> float:
        """The share of futures in which it crashes."""
        return float(self.outcome is Outcome.CRASH) if self.chances is None else self.chances.crashes

    @property
    def arrives(self) -> float:
        """The share of futures in which it arrives."""
        return float(self.outcome is Outcome.SUCCESS) if self.chances is None else self.chances.arrives

    @property
    def as_it_is(self) -> bool:
        """Whether the planner drives so anyway."""
        return not self.by_chance and not self.real.by_chance and self.path == self.real.story.path


def policy_run(
    timeline: Timeline,
    policy: Policy,
    tick: int | None = None,
    *,
    lane: int | None = None,
    ego: str | None = None,
) -> PolicyRun:
    """What comes of a rule from now or from a tick on, for an ego, the first by default.

    `lane`: that of `TO_LANE`, from 1 at the left. A drive that has ended is driven again from its start.
    Raises `QuestionError`: `no_such_tick`, `no_such_lane`, and `nothing_ahead` where no drive goes on.
    """
    check_ego(timeline.state, ego)
    if tick is None and timeline.state.world.ended is not None:
        tick = timeline.state.world.episode_start
    start = state_at(timeline, tick)
    if start.world.outcome is not Outcome.RUNNING:
        raise QuestionError("nothing_ahead", outcome=start.world.outcome, tick=start.world.tick)
    columns = start.world.road.columns
    if policy is Policy.TO_LANE and not 1 <= (lane or 0) <= columns:
        raise QuestionError("no_such_lane", lane=lane, columns=columns)
    state = driving(start, ego)
    path, last, columns_driven = _driven(state, policy, ego, lane)
    world, number = last.world, state.number(ego)
    cells = state.world.avs[number] // world.road.columns - world.avs[number] // world.road.columns
    demanded = DEMANDED.get(policy)
    by_hand = None
    if demanded is not None and world.outcome is Outcome.CRASH and state.config.certain:
        left = state.config.max_ticks + 1 - state.world.episode_tick
        by_hand = story(state.with_ego(ego, mode=Mode.MANUAL, queue=(demanded,) * left), ego=ego)
    since = 0 if tick is None else sum(entry.tick > tick for entry in timeline.entries)
    return PolicyRun(
        start,
        policy,
        path,
        world.outcome,
        world.cause,
        cells,
        _chances(state, policy, ego, lane),
        foresee(state, ego),
        by_hand,
        since,
        lane,
        next((at for at, column in enumerate(columns_driven) if column + 1 == lane), None),
        sum(column + 1 == lane for column in columns_driven[: len(path)]),
    )


def move_of(policy: Policy, decision: Decision, across: int = 0) -> Move:
    """The move that a rule makes of a planner's decision; `across`: how far right its lane is."""
    if policy is Policy.TO_LANE:
        return _towards(decision, across) if across else move_of(Policy.IN_LANE, decision)
    if policy in DEMANDED:
        return DEMANDED[policy]
    forbidden = FORBIDDEN[policy]
    if decision.move not in forbidden:
        return decision.move
    free = [
        each
        for each in decision.options
        if each.move not in forbidden and each.cell is not None and not each.reason.blocks
    ]
    leading_on = [each for each in free if each.cost is not None]
    return (leading_on or free)[0].move if free else LAST_RESORT[policy]


def _towards(decision: Decision, across: int) -> Move:
    """A free move to that side, ahead if it can be; else the planner's, unless that leads away."""
    side = 1 if across > 0 else -1
    ways = [
        each
        for each in decision.options
        if each.move.offset[0] == side and each.cell is not None and not each.reason.blocks
    ]
    leading_on = [each for each in ways if each.cost is not None]
    if ways:
        return min(leading_on or ways, key=lambda each: not each.move.offset[1]).move
    away = decision.move.offset[0] == -side
    return move_of(Policy.IN_LANE, decision) if away else decision.move


def _across(state: SimState, lane: int | None, ego: str | None) -> int:
    """How many lanes to the right of an ego a lane is."""
    column = state.world.avs[state.number(ego)] % state.world.road.columns
    return 0 if lane is None else lane - 1 - column


def _driven(
    state: SimState, policy: Policy, ego: str | None, lane: int | None
) -> tuple[tuple[Move, ...], SimState, list[int]]:
    """The moves of one run to the end of the episode, the state that it ends in, and its columns."""
    path: list[Move] = []
    columns: list[int] = []
    work = faults = 0
    searches = traits_of(state.config_of(ego).planner).plans_to_goal and policy not in DEMANDED
    while state.world.outcome is Outcome.RUNNING:
        columns.append(state.world.avs[state.number(ego)] % state.world.road.columns)
        tick, move, fault = _tick(state, policy, ego, lane)
        faults = 0 if fault is None else faults + 1
        work += work_of_tick(state.world.road) if searches else 0
        if faults == MAX_FAULTS or work > MAX_WORK:
            break
        path.append(move)
        state = tick.state
    columns.append(state.world.avs[state.number(ego)] % state.world.road.columns)
    return tuple(path), state, columns


def _tick(
    state: SimState, policy: Policy, ego: str | None, lane: int | None
) -> tuple[StepResult, Move, str | None]:
    """One tick by a rule, its move, and what the planner did instead of answering."""
    if state.world.avs[state.number(ego)] < state.world.road.columns:  # it has arrived, and waits for others
        return step(state), Move.STAY, None
    if policy in DEMANDED:
        return _made(state, DEMANDED[policy], ego), DEMANDED[policy], None
    tick = step(state)
    decision = decided(tick, ego)
    if decision is None:
        return tick, Move.STAY, None
    move = move_of(policy, decision, _across(state, lane, ego))
    if move is not decision.move:
        tick = replace(_made(state, move, ego), steps=tick.steps)
    return tick, move, decision.fault


def _made(state: SimState, move: Move, ego: str | None) -> StepResult:
    """A tick in which an ego makes a move whatever it meets; those that decide after it know the move."""
    tick = transition(state, moves_where(state, move, ego))
    return replace(tick, state=tick.state.with_ego(ego, queue=(), watch=NOTHING_KEPT))


def _chances(state: SimState, policy: Policy, ego: str | None, lane: int | None) -> Chances | None:
    """How likely each end is; None where nothing is left to chance, or a planner does not answer."""
    if state.config.certain:
        return None
    most = MOST_TICKS if policy in DEMANDED else traits_of(state.config_of(ego).planner).decisions_per_answer
    futures = _PolicyFutures(state, ego or FIRST, most=most)
    futures.policy, futures.lane = policy, lane
    try:
        ends: Ends | None = futures.walked()
        drawn = None
        if ends is None:
            ends = futures.drawn()
            drawn = round(sum(ends.values()))
    except QuestionError:
        return None
    return shares(ends, drawn)


class _PolicyFutures(Futures):
    """The futures of a moment from which on it is driven by a rule."""

    policy: Policy
    lane: int | None

    def _end(self, node: Node, within: int | None = None) -> End | None:
        # That no way leads to the goal ends nothing here: the rule may still lead into something.
        running = node.state.world.outcome is Outcome.RUNNING
        return None if running and not self._several else super()._end(node, within)

    def _taken(self, state: SimState, config: Config) -> tuple[StepResult, Belief]:
        if self.policy in DEMANDED:
            tick = _made(replace(state, config=config), DEMANDED[self.policy], self.ego)
            return tick, tick.state.belief
        tick, belief = super()._taken(state, config)
        decision = decided(tick, self.ego)
        if decision is None:
            return tick, belief
        move = move_of(self.policy, decision, _across(state, self.lane, self.ego))
        if move is decision.move:
            return tick, belief
        made = _made(replace(state, config=config), move, self.ego)
        return replace(made, steps=tick.steps), belief
