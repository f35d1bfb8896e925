"""For how many ticks the cells of a move stay free if the ego stands, by the rules that the others keep to.

The cells are those that the move leads through or into: the one right ahead, or those beside the ego and
diagonally ahead. The others are run on by their rules while the ego stays where it is. Where it is left to
chance how they react, that is drawn anew from the second tick on; what is drawn for the first is known.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from sim.decide import moves_where
from sim.explain.foresight import driving, running_state
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import transition
from sim.types import Cell, Move, Outcome

HORIZON: Final = 6
"""Ticks that are looked ahead where none are said."""
MOST_AHEAD: Final = 50
"""Ticks that are looked ahead at most."""
DRAWN: Final = 50
"""Futures that are drawn where how others react is left to chance."""


@dataclass(frozen=True, slots=True)
class StaysFree:
    """How long some cells stay free, in facts."""

    state: SimState
    move: Move
    """`forward`, `left` or `right`"""
    ticks: int
    """ticks that were looked ahead"""
    taken_now: str | None
    """what is there now"""
    free_for: int
    """ticks until something is there in the run as it is seen now; `ticks` where nothing comes"""
    comes: str | None
    """what that is"""
    hit: str | None
    """what runs into the standing ego before, which ends the look ahead"""
    frees_after: int | None
    """where something is there now: ticks until nothing is"""
    share: float
    """the share of futures in which the cells stay free all the time"""
    futures: int | None
    """how many were drawn; None where nothing is left to chance"""

    @property
    def stays(self) -> bool:
        """Whether nothing is there now or comes in these ticks."""
        return self.taken_now is None and self.comes is None and self.hit is None


def stays_free(timeline: Timeline, move: Move, ticks: int | None = None) -> StaysFree:
    """Whether the cells of a move stay free for some ticks.

    Raises `QuestionError`: `nothing_ahead`, `no_lane_there` where there is no such cell, `too_far_ahead`.
    """
    state = driving(running_state(timeline, None))
    most = HORIZON if ticks is None else ticks
    if most > MOST_AHEAD:
        raise QuestionError("too_far_ahead", ticks=most, most=MOST_AHEAD)
    cells = _cells(state, move)
    now = _there(state, cells)
    seen = _run(state, cells, most, None)
    frees = next((at for at, who in enumerate(seen, 1) if who is None), None) if now else None
    at = next((at for at, who in enumerate(seen, 1) if who is not None), None)
    who = None if at is None else seen[at - 1]
    hit = who[1:] if who is not None and who.startswith("!") else None
    share, futures = float(now is None and at is None), None
    config = state.config
    if now is None and (config.mover_behaviour.draws(config)) and most > 1:
        futures = DRAWN
        runs = [_run(state, cells, most, seed) for seed in range(1, DRAWN + 1)]
        share = sum(not any(run) for run in runs) / DRAWN
    return StaysFree(
        state,
        move,
        most,
        now,
        0 if now is not None else most if at is None else at - 1,
        None if hit is not None else who,
        hit,
        frees,
        share,
        futures,
    )


def _cells(state: SimState, move: Move) -> tuple[Cell, ...]:
    """The cells of a move that are on the road. Raises `QuestionError`: `no_lane_there`."""
    road = state.world.road
    column, row = road.cell(state.world.av)
    across = move.offset[0]
    beside = column + across
    if not 0 <= beside < road.columns or (not across and row == 0):
        raise QuestionError("no_lane_there", move=move)
    if not across:
        return ((column, row - 1),)
    return tuple((beside, each) for each in (row, row - 1) if each >= 0)


def _there(state: SimState, cells: Sequence[Cell]) -> str | None:
    """What is in the first of the cells that something is in."""
    found = {each.cell: each.id for each in state.world.things()}
    return next((found[cell] for cell in cells if cell in found), None)


def _run(state: SimState, cells: Sequence[Cell], ticks: int, seed: int | None) -> list[str | None]:
    """What is there after each tick; the last is "!" and an id where that hits the standing ego."""
    found: list[str | None] = []
    own = state.ego().id
    for tick in range(ticks):
        if seed is not None and tick == 1:
            config = state.config.with_parts(seed=state.config.seed + seed)
            state = replace(state, config=config)
        state = transition(state, moves_where(state, Move.STAY, None)).state
        if state.world.outcome is Outcome.CRASH:
            cause = state.world.cause
            who = next((each for each in cause.ids if each != own), "") if cause is not None else ""
            return [*found, f"!{who}"]
        found.append(_there(state, cells))
        if state.world.outcome is not Outcome.RUNNING:
            break
    return found
