"""What a decision cost against the best that could have been done from the same moment.

Source: regret as in decision theory (Savage, 1951), here exact, since the world is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from sim.commit import moves_with
from sim.oracle.lower_bounds import foreseen, least_cost, least_ticks
from sim.repetition import NOTHING_KEPT
from sim.search.costs import weights
from sim.search.time_expanded import TimeExpandedGraph
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world
from sim.types import MOVES, Move, Outcome


@dataclass(frozen=True, slots=True)
class Regret:
    """How much worse a move was than the best. None where there is none: the road could not be driven."""

    ticks: int | None
    """ticks lost; None also if the move lost the road altogether"""
    cost: int | None
    """cost lost, by the charges; None as for ticks, and where every way relies on a reaction of movers"""
    lost: bool
    """whether the goal could be reached before the move and cannot after it"""


def regret(state: SimState, move: Move, patience: int | None = None, *, ego: str | None = None) -> Regret:
    """The regret of a move of an ego, the first by default.

    Raises `ValueError` if it leads off the road or the episode has ended. `patience`: as for `least_ticks`,
    which raises `UndeterminedError` where another ego drives.
    """
    best_ticks = least_ticks(state, patience, ego)
    after = _after(state, move, ego)
    if best_ticks is None:
        return Regret(None, None, lost=False)
    ticks = least_ticks(after, patience, ego)
    if ticks is None:
        return Regret(None, None, lost=True)
    forecast, limit = foreseen(state, ego=ego)
    terrain = TimeExpandedGraph(forecast.after(move), weights(state.config), limit)
    paid = next(cost for taken, _, cost in terrain.steps(terrain.start) if MOVES[taken] is move)
    best, rest = least_cost(state, ego=ego), least_cost(after, ego=ego)
    lost = None if best is None or rest is None else max(0, paid + rest - best)
    return Regret(1 + ticks - best_ticks, lost, lost=False)


def regrets(
    timeline: Timeline, first: int, stop: int, *, ego: str | None = None
) -> Iterator[tuple[int, Regret]]:
    """(tick, regret) of the decisions an ego has taken in ticks `first` to before `stop`.

    Raises `IndexError`, and `UndeterminedError` as `regret` does.
    """
    for state in timeline.between(first, stop):
        decision = timeline.decided(state, ego)
        if decision is not None:
            yield state.world.tick, regret(state, decision.move, ego=ego)


def _after(state: SimState, move: Move, ego: str | None) -> SimState:
    if state.world.outcome is not Outcome.RUNNING:
        raise ValueError("the episode has ended")
    moves = moves_with(state.world, move, state.number(ego))
    after = next_world(state.world, moves, state.config, state.parked)
    queue = state.ego(ego).queue[1:]
    return replace(state.with_ego(ego, queue=queue, watch=NOTHING_KEPT), world=after)
