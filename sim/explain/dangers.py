"""What is most dangerous now: what the ego would meet soonest, by each of its moves; and the worst to come.

Each of the six moves is made and followed straight on, staying by staying, for a few ticks of the road as
it is, in which the others keep to their rules. Most dangerous is what the planner's own drive ends at within
these ticks; then what meets an ego that goes straight on or stays, the soonest first; then what meets one
that turns; of equals what is met by more of the moves. The worst case is that of `sim.explain.assurance`:
others may do as they like.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.decide import moves_where
from sim.explain.episode_rollout import decided, drive
from sim.explain.foresight import driving, running_state
from sim.explain.question_error import QuestionError
from sim.explain.soon import ComingTicks, coming_ticks
from sim.forecast import Forecast
from sim.search.robust_reachability import Guarantee, guarantee, movers_that_may_hit
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step, transition
from sim.types import MOVES, Kind, Mode, Move, Outcome

HORIZON: Final = 6
"""Ticks that each move is followed."""
_CHANGES_NOTHING: Final = (Move.FORWARD, Move.STAY)
"""Moves by which an ego keeps its lane."""


@dataclass(frozen=True, slots=True)
class Danger:
    """A thing that some moves would meet."""

    id: str
    kind: Kind
    ticks: int
    """after how many ticks it is met; by turning only where keeping the lane does not meet it"""
    moves: tuple[Move, ...]
    """the moves that meet it so soon"""
    all_moves: tuple[Move, ...]
    """all moves that meet it within `HORIZON`"""
    hit_after: int | None
    """after how many ticks the planner's own drive hits it; None where it does not within `HORIZON`"""


@dataclass(frozen=True, slots=True)
class Dangers:
    """What the ego may meet, the most dangerous first."""

    state: SimState
    found: tuple[Danger, ...]
    next_move: Move | None
    """what the planner does next; None where a person drives, or it does not answer"""


@dataclass(frozen=True, slots=True)
class WorstCase:
    """What may come within some ticks if the others do as they like, and what comes by their rules."""

    state: SimState
    ticks: int
    sure: Guarantee
    """for how long some way keeps clear, whatever the others do"""
    next_move: Move | None
    """what the planner does next"""
    sure_after: Guarantee | None
    """the same after that move"""
    may_hit: tuple[str, ...]
    """who may hit the ego in that move if they do as they like"""
    by_rules: ComingTicks

    @property
    def may_crash(self) -> bool:
        """Whether no way is sure to keep clear for these ticks."""
        return not self.sure.to_the_end and self.sure.ticks < self.ticks


def dangers(timeline: Timeline, kind: Kind | None = None) -> Dangers:
    """What is most dangerous for the first ego now, of a kind or of all. Raises `QuestionError`."""
    state = running_state(timeline, None)
    story = None if state.ego().mode is Mode.MANUAL else drive(driving(state)).story
    hits = story is not None and story.outcome is Outcome.CRASH and story.driven <= HORIZON
    hit = dict.fromkeys(story.cause.ids, story.driven) if hits and story and story.cause else {}
    kinds = {each.id: each.kind for each in state.world.things()}
    met: dict[str, dict[Move, int]] = {}
    for move in MOVES:
        ticks, ids = _met(driving(state), move)
        for id in ids:
            met.setdefault(id, {})[move] = ticks
    for id in hit:
        met.setdefault(id, {})
    found = [
        _danger(id, kinds[id], by_move, hit.get(id))
        for id, by_move in met.items()
        if id in kinds and kind in (None, kinds[id])
    ]
    cells = {each.id: each.cell for each in state.world.things()}
    column, row = state.world.road.cell(state.world.av)

    def rank(each: Danger) -> tuple[bool, bool, int, int, int, str]:
        far = max(abs(cells[each.id][0] - column), abs(cells[each.id][1] - row))
        turns = not any(move in _CHANGES_NOTHING for move in each.all_moves)
        return each.hit_after is None, turns, each.ticks, -len(each.moves), far, each.id

    return Dangers(state, tuple(sorted(found, key=rank)), _next_move(state))


def worst_case(timeline: Timeline, ticks: int) -> WorstCase:
    """The worst that may come within some ticks. Raises `QuestionError`."""
    state = running_state(timeline, None)
    forecast = Forecast.of_truth(state.world, state.config, 1)
    slips = state.config.slips > 0.0
    move = _next_move(state)
    after = None if move is None else guarantee(forecast, ticks, first=move, slips=slips)
    may_hit = () if move is None else movers_that_may_hit(forecast, move)
    by_rules = coming_ticks(timeline, ticks)
    return WorstCase(state, ticks, guarantee(forecast, ticks, slips=slips), move, after, may_hit, by_rules)


def _met(state: SimState, move: Move) -> tuple[int, tuple[str, ...]]:
    """After how many ticks a move hits something that is followed straight on, or by staying; and what."""
    own = state.ego().id
    for ticks in range(1, HORIZON + 1):
        now = move if ticks == 1 else Move.STAY if move is Move.STAY else Move.FORWARD
        if state.config.ego_dynamics(state.world.road).target(state.world.av, now) is None:
            break
        state = transition(state, moves_where(state, now, None)).state
        if state.world.outcome is Outcome.CRASH and state.world.cause is not None:
            return ticks, tuple(id for id in state.world.cause.ids if id != own)
        if state.world.outcome is not Outcome.RUNNING:
            break
    return 0, ()


def _danger(id: str, kind: Kind, by_move: dict[Move, int], hit_after: int | None) -> Danger:
    kept = [by_move[move] for move in _CHANGES_NOTHING if move in by_move]
    soonest = min(kept or by_move.values(), default=hit_after or 0)
    moves = tuple(move for move in MOVES if by_move.get(move) == soonest)
    return Danger(id, kind, soonest, moves, tuple(move for move in MOVES if move in by_move), hit_after)


def _next_move(state: SimState) -> Move | None:
    """The planner's next move; None where a person drives, or it does not answer."""
    if state.ego().mode is Mode.MANUAL:
        return None
    try:
        decision = decided(step(driving(state)), None)
    except QuestionError:
        return None
    return None if decision is None or decision.fault is not None else decision.move
