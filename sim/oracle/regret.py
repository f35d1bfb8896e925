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


def regret(state: SimState, move: Move, patience: int | None = None) -> Regret:
    """The regret of a move. Raises `ValueError` if it leads off the road or the episode has ended.

    `patience`: as for `least_ticks`.
    """
    best_ticks = least_ticks(state, patience)
    after = _after(state, move)
    if best_ticks is None:
        return Regret(None, None, lost=False)
    ticks = least_ticks(after, patience)
    if ticks is None:
        return Regret(None, None, lost=True)
    forecast, limit = foreseen(state)
    terrain = TimeExpandedGraph(forecast.after(move), weights(state.config), limit)
    paid = next(cost for taken, _, cost in terrain.steps(terrain.start) if MOVES[taken] is move)
    best, rest = least_cost(state), least_cost(after)
    lost = None if best is None or rest is None else max(0, paid + rest - best)
    return Regret(1 + ticks - best_ticks, lost, lost=False)


def regrets(timeline: Timeline, first: int, stop: int) -> Iterator[tuple[int, Regret]]:
    """(tick, regret) of the decisions taken in ticks `first` to before `stop`. Raises `IndexError`."""
    for state in timeline.between(first, stop):
        decision = timeline.decided(state)
        if decision is not None:
            yield state.world.tick, regret(state, decision.move)


def _after(state: SimState, move: Move) -> SimState:
    if state.world.outcome is not Outcome.RUNNING:
        raise ValueError("the episode has ended")
    after = next_world(state.world, moves_with(state.world, move), state.config, state.parked)
    return replace(state.with_ego(queue=state.queue[1:], watch=NOTHING_KEPT), world=after)
