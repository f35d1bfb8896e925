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

from sim.config import Config
from sim.forecast import Forecast
from sim.rules.limits import steps_left as steps_left_of
from sim.types import MOVES, Move
from sim.world.grid import Board


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


def reachability(forecast: Forecast, start: Board, limit: int, *, after: int = 0) -> Reachability:
    """The sets reached from `start`, `after` ticks from now, by at most `limit` further steps."""
    goal = forecast.road.row(0)
    layers = [start]
    if start & goal:
        return Reachability((start,), 0)
    for there in forecast.spreads(start, after, after + limit):
        layers.append(there)
        if there & goal:
            return Reachability(tuple(layers), len(layers) - 1)
        if not there:
            break
    return Reachability(tuple(layers), None)


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
    found = []
    for move, there in zip(MOVES, _first_steps(forecast, limit), strict=True):
        ticks = reachability(forecast.after(move), there, limit - 1, after=1).ticks if there else None
        found.append(None if ticks is None else ticks + 1)
    return tuple(found)


def survival_by_move(forecast: Forecast, limit: int) -> tuple[int, ...]:
    """For how many ticks one can keep clear of collisions beginning with each move (0: not even for one)."""
    return tuple(
        reachability(forecast.after(move), there, limit - 1, after=1).lasted + 1 if there else 0
        for move, there in zip(MOVES, _first_steps(forecast, limit), strict=True)
    )


def _first_steps(forecast: Forecast, limit: int) -> Sequence[Board]:
    """Where each move leads now, in the order of `Move`; nowhere once no step is left."""
    return forecast.own_steps() if limit else (0,) * len(MOVES)


def first_longest(ticks: Sequence[int]) -> Move:
    """The move after which one lasts longest; `stay` if none lasts at all."""
    return MOVES[ticks.index(max(ticks))] if any(ticks) else Move.STAY
