"""Where a vehicle can be at every tick, as sets of cells stepped by the rules.

Structure: the set reached after k ticks is stepped through tick k of the forecast, six moves at once
(`Forecast.spread`), until it meets row 0, is empty, or the limit is spent. A backward pass over
the layers keeps the cells that lie on a way of least ticks. Guarantee: exact for the forecast that is
handed in. Source: breadth-first search in time-expanded space (Silver, "Cooperative pathfinding",
2005), done on bitboards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from sim.config import Config
from sim.forecast import Forecast
from sim.rules.ego_step import beside
from sim.rules.grid_dynamics import GridDynamics
from sim.rules.limits import steps_left as steps_left_of
from sim.search.no_way_left import known_to_last, look_ahead_if_asked_again, shut_in
from sim.search.passages import locked_in, ways_past
from sim.types import MOVES, Move
from sim.world.grid import Board

DOUBT_AFTER: Final = 8
"""A way is looked for so many ticks longer than the rows there are before what never moves is looked at."""


@dataclass(frozen=True, slots=True)
class Reachability:
    """`layers[k]` holds the cells reached k ticks after the beginning."""

    layers: tuple[Board, ...]
    ticks: int | None
    """ticks until row 0 is first met; None if it is not"""

    @property
    def lasted(self) -> int:
        """Ticks after which at least one cell is still reached, within the limit."""
        return len(self.layers) - 1 - (self.layers[-1] == 0)


def steps_left(config: Config, episode_tick: int) -> int:
    """How many steps an episode may still take: arriving is judged before being stuck."""
    return steps_left_of(config.rows, episode_tick)


def reachability(
    forecast: Forecast, start: Board, limit: int, *, after: int = 0, whole: bool = True
) -> Reachability:
    """The sets reached from `start`, `after` ticks from now, by at most `limit` further steps.

    Not `whole`: the layers end where it is proved that none of them meets row 0.
    """
    goal = forecast.road.row(0)
    layers = [start]
    if start & goal:
        return Reachability((start,), 0)
    doubtful = 0 if whole else start.bit_length() // forecast.road.columns + DOUBT_AFTER
    for there in forecast.spreads(start, after, after + limit):
        layers.append(there)
        if there & goal:
            return Reachability(tuple(layers), len(layers) - 1)
        if not there or (len(layers) == doubtful and not there & leading_on(forecast)):
            break
    return Reachability(tuple(layers), None)


def leading_on(forecast: Forecast) -> Board:
    """The cells from which a way leads past all that never moves; all where that is not known."""
    road, percept = forecast.road, forecast.percept
    if not isinstance(forecast.dynamics, GridDynamics):
        return road.all
    locked = locked_in(percept.right | percept.left, forecast.fixed, road.left_edge, road.right_edge)
    return ways_past(road.columns, road.rows, forecast.fixed | locked).open


def left_alone(forecast: Forecast) -> Board:
    """The cells in which a vehicle may stand for ever: nothing that moves is in their part of the row."""
    road, fixed = forecast.road, forecast.fixed
    if forecast.egos or not isinstance(forecast.dynamics, GridDynamics):
        return 0
    moving = (forecast.percept.right | forecast.percept.left) & ~fixed
    while True:  # movers never leave the stretch between two hazards
        wider = beside(moving, road.left_edge, road.right_edge) & ~fixed
        if wider == moving:
            return road.all & ~(fixed | moving)
        moving = wider


def flood_fill(forecast: Forecast, start: Board) -> Board:
    """Every cell that can be reached from `start` past the fixed hazards, were there no movers."""
    dynamics, fixed = forecast.dynamics, forecast.fixed
    while True:
        wider = dynamics.spread(start, fixed, 0, 0)
        if wider | start == start:
            return start
        start |= wider


def on_shortest(forecast: Forecast, found: Reachability, *, after: int = 0) -> list[Board]:
    """Of every layer, the cells that lie on a way of least ticks.

    Raises `ValueError` where the reach has not met row 0.
    """
    if found.ticks is None:
        raise ValueError("there is no way to keep")
    road = forecast.road
    needed = [found.layers[found.ticks] & road.row(0)]
    for ahead in range(found.ticks - 1, -1, -1):
        needed.append(forecast.spread_back(needed[-1], ahead + after) & found.layers[ahead])
    return needed[::-1]


def shortest_plan(forecast: Forecast, limit: int) -> tuple[Move, ...] | None:
    """The moves of a way of least ticks for the forecast's vehicle, earlier moves preferred; None: no way."""
    found = reachability(forecast, 1 << forecast.ego, limit)
    if found.ticks is None:
        return None
    needed = on_shortest(forecast, found)
    here, plan = 1 << forecast.ego, []
    for ahead in range(found.ticks):
        there = forecast.dynamics.unhindered(here) & needed[ahead + 1]
        if there:  # what is needed is free
            plan.append(Move.FORWARD)
            here = there
            continue
        for move, there in zip(MOVES, forecast.steps(here, ahead), strict=True):
            if there & needed[ahead + 1]:
                plan.append(move)
                here = there
                break
    return tuple(plan)


def least_ticks_by_move(forecast: Forecast, limit: int) -> tuple[int | None, ...]:
    """Least ticks to the goal beginning with each move, in the order of `Move`; None: no way."""
    found: list[int | None] = []
    steps = _first_steps(forecast, limit)
    staying = forecast.after(Move.STAY)
    foreseen = steps if staying is forecast else steps[:-1]
    hopeless: set[Board] = set()
    if shut_in(forecast, _union(foreseen), limit):
        hopeless.update(foreseen)
    for move, there in zip(MOVES, steps, strict=True):
        expected = staying if move is Move.STAY else forecast
        if not there or (expected is forecast and there in hopeless):
            found.append(None)
            continue
        ticks = reachability(expected, there, limit - 1, after=1, whole=False).ticks
        found.append(None if ticks is None else ticks + 1)
        if ticks is None and not hopeless:  # then mostly no other move leads on either
            hopeless.add(there)
            if none_leads_on(forecast, foreseen, limit):
                hopeless.update(foreseen)
    return tuple(found)


def none_leads_on(forecast: Forecast, starts: Sequence[Board], limit: int) -> bool:
    """Whether none of these first steps has a way on to the goal."""
    together = _union(starts)
    if shut_in(forecast, together, limit):
        return True
    return reachability(forecast, together, limit - 1, after=1, whole=False).ticks is None


def _union(boards: Sequence[Board]) -> Board:
    found = 0
    for board in boards:
        found |= board
    return found


def longest_lasting(forecast: Forecast, limit: int) -> Move:
    """The first of the moves after which one can keep clear longest; `stay` if none lasts at all.

    Precondition: no move leads to the goal.
    """
    best, move = 0, Move.STAY
    safe = left_alone(forecast)
    look_ahead_if_asked_again(forecast, limit)
    known = known_to_last(forecast, limit)
    for each, there in zip(MOVES, _first_steps(forecast, limit), strict=True):
        expected = forecast.after(each)
        lasts = 0
        if there:
            to_the_end = expected is forecast and there & known
            lasts = limit if to_the_end else _lasting(expected, there, limit - 1, safe) + 1
        if lasts > best:
            best, move = lasts, each
        if best == limit:
            break
    return move


def _lasting(forecast: Forecast, start: Board, limit: int, safe: Board) -> int:
    """For how many ticks from the next on one can keep clear; in a cell of `safe` it is to the end."""
    if start & safe:
        return limit
    for lasted, there in enumerate(forecast.spreads(start, 1, 1 + limit)):
        if there & safe:
            return limit
        if not there:
            return lasted
    return limit


def survival_by_move(forecast: Forecast, limit: int) -> tuple[int, ...]:
    """For how many ticks one can keep clear of collisions beginning with each move (0: not even for one)."""
    return tuple(
        reachability(forecast.after(move), there, limit - 1, after=1).lasted + 1 if there else 0
        for move, there in zip(MOVES, _first_steps(forecast, limit), strict=True)
    )


def _first_steps(forecast: Forecast, limit: int) -> Sequence[Board]:
    """Where each move leads now, in the order of `Move`; nowhere once no step is left."""
    return forecast.own_steps() if limit else (0,) * len(MOVES)
