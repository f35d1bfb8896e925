"""A forecast as a terrain: a state is a cell at a tick, charges are those of `sim.search.costs`.

A state is `ticks from now · cells of the road + cell index`. Layers of what is blocked, met and charged
for are made once per tick, when the search first gets there.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from sim.forecast import Forecast
from sim.rules.ego_step import beside
from sim.search.costs import Weights
from sim.search.graph import State
from sim.search.step_costs import ego_moves
from sim.types import MOVES
from sim.world.grid import Board, Road

_ON: Final = tuple(place for place, move in enumerate(MOVES) if move.offset[1])
"""The places in `MOVES` of those that lead to another row."""


def around(board: Board, road: Road) -> Board:
    """A set of cells with the eight neighbours of each."""
    tall = board | board >> road.columns | board << road.columns
    return beside(tall, road.left_edge, road.right_edge) & road.all


class Layer(NamedTuple):
    """What the steps of one tick meet."""

    obstacles: Any
    """as the motion wants it (`Dynamics.obstacles`)"""
    near: tuple[Board, ...]
    """cells within 1, 2, … cells of a mover after the tick"""


class TimeExpandedGraph:
    """The terrain of one vehicle's way to row 0 within `limit` ticks."""

    def __init__(self, forecast: Forecast, weights: Weights, limit: int) -> None:
        """The way from the forecast's vehicle; the forecast must reach `limit` ticks ahead."""
        self.moves = ego_moves(weights)
        self.limit = limit
        self.start: State = forecast.ego
        self.weights = weights
        self._forecast = forecast
        self._columns = forecast.road.columns
        self._fixed = forecast.fixed
        self._cells = forecast.road.columns * forecast.road.rows
        self.near_fixed = around(self._fixed, forecast.road) if weights.fixed else 0
        self.doubtful = forecast.percept.doubtful if weights.doubt else ()
        self._layers: list[Layer] = []
        self._costs = [step.cost for step in self.moves]
        ahead = min([self._costs[place] for place in _ON])
        gained = forecast.dynamics.rows_a_tick
        self._by_row = [-(-row // gained) * ahead for row in range(forecast.road.rows)]
        self._window = (gained + 1) * self._columns
        self._free_ends = forecast.dynamics.free_ends

    def layer(self, ahead: int) -> Layer:
        """What a step taken `ahead` ticks from now meets."""
        while len(self._layers) <= ahead:
            self._layers.append(self._made(len(self._layers)))
        return self._layers[ahead]

    def charge(self, ahead: int, cell: int) -> int:
        """What being in a cell costs after the step of that tick, beside the move."""
        total = self.weights.fixed if self.near_fixed >> cell & 1 else 0
        for near in self.layer(ahead).near:
            if near >> cell & 1:
                total += self.weights.mover
        for doubtful in self.doubtful:
            if doubtful >> cell & 1:
                total += self.weights.doubt
        return total

    def steps(self, state: State) -> list[tuple[int, State, int]]:
        """The steps that meet nothing, in the order of moves."""
        ahead, cell = divmod(state, self._cells)
        if ahead >= self.limit:
            return []
        layers, costs = self._layers, self._costs
        obstacles, around_movers = layers[ahead] if ahead < len(layers) else self.layer(ahead)
        # The rows that matter, brought to the lowest bits: short numbers are quick.
        low = cell - self._window if cell > self._window else 0
        later, fixed = state - cell + self._cells + low, self.near_fixed >> low
        near = [board >> low for board in around_movers]
        doubtful = [board >> low for board in self.doubtful]
        charge_fixed, charge_mover, charge_doubt = self.weights.fixed, self.weights.mover, self.weights.doubt
        found = []
        for move, end in self._free_ends(obstacles, cell, low):
            cost = costs[move]
            if fixed >> end & 1:
                cost += charge_fixed
            for board in near:
                if board >> end & 1:
                    cost += charge_mover
            for board in doubtful:
                if board >> end & 1:
                    cost += charge_doubt
            found.append((move, later + end, cost))
        return found

    def at_goal(self, state: State) -> bool:
        """Whether the cell is in row 0."""
        return state % self._cells < self._columns

    def heuristic(self, state: State) -> int:
        """A tick gains no more rows than the motion can, and no step on costs less than the cheapest."""
        return self._by_row[state % self._cells // self._columns]

    def _made(self, ahead: int) -> Layer:
        forecast, road = self._forecast, self._forecast.road
        right, left, came_right, came_left = forecast.slices[ahead]
        near, spread = [], right | left
        for _ in range(self.weights.buffer if self.weights.mover else 0):
            spread = around(spread, road)
            near.append(spread)
        blocked = self._fixed | right | left
        if forecast.egos:
            blocked |= forecast.taken(ahead)
        return Layer(forecast.dynamics.obstacles(blocked, came_right, came_left), tuple(near))
