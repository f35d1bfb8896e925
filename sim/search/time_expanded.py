"""A forecast as a terrain: a state is a cell at a tick, charges are those of `sim.search.costs`.

A state is `ticks from now · cells of the road + cell index`. Layers of what is blocked, met and charged
for are made once per tick, when the search first gets there.
"""

from __future__ import annotations

from dataclasses import dataclass

from sim.forecast import Forecast
from sim.rules.traffic import beside
from sim.search.costs import Weights
from sim.search.graph import State
from sim.search.step_costs import vehicle
from sim.types import Move
from sim.world.grid import Board, Road

_FORWARD, _LEFT, _RIGHT, _FORWARD_LEFT, _FORWARD_RIGHT, _STAY = range(len(Move))


def around(board: Board, road: Road) -> Board:
    """A set of cells with the eight neighbours of each."""
    tall = board | board >> road.columns | board << road.columns
    return beside(tall, road.left_edge, road.right_edge) & road.all


@dataclass(frozen=True, slots=True)
class Layer:
    """What the steps of one tick meet."""

    blocked: Board
    no_left: Board
    """cells from which a step to the left leads off the road or through a mover"""
    no_right: Board
    no_forward_left: Board
    """cells from which a diagonal to the left leads off the road or is cut off by a mover"""
    no_forward_right: Board
    near: tuple[Board, ...]
    """cells within 1, 2, … cells of a mover after the tick"""


class TimeExpandedGraph:
    """The terrain of one vehicle's way to row 0 within `limit` ticks."""

    def __init__(self, forecast: Forecast, weights: Weights, limit: int) -> None:
        """The way from the forecast's vehicle; the forecast must reach `limit` ticks ahead."""
        self.moves = vehicle(weights)
        self.limit = limit
        self.start: State = forecast.ego
        self.weights = weights
        self._forecast = forecast
        self._columns = forecast.road.columns
        self._cells = forecast.road.columns * forecast.road.rows
        self.near_fixed = around(forecast.fixed, forecast.road) if weights.fixed else 0
        self._layers: list[Layer] = []
        self._costs = [step.cost for step in self.moves]
        self._ahead = min(self._costs[_FORWARD], self._costs[_FORWARD_LEFT], self._costs[_FORWARD_RIGHT])

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
        return total

    def steps(self, state: State) -> list[tuple[int, State, int]]:
        """The steps that meet nothing, in the order of moves."""
        ahead, cell = divmod(state, self._cells)
        if ahead >= self.limit:
            return []
        layer, columns = self.layer(ahead), self._columns
        # The two rows that matter, brought to the lowest bits: short numbers are quick.
        low = cell - columns - 1 if cell > columns else 0
        blocked = layer.blocked >> low
        here = cell - low
        on = here - columns
        ends = []
        if not blocked >> on & 1:
            ends.append((_FORWARD, on))
        if not (layer.no_left >> cell | blocked >> here - 1) & 1:
            ends.append((_LEFT, here - 1))
        if not (layer.no_right >> cell | blocked >> here + 1) & 1:
            ends.append((_RIGHT, here + 1))
        if not (layer.no_forward_left >> cell & 1) and not blocked >> on - 1 & 1:
            ends.append((_FORWARD_LEFT, on - 1))
        if not (layer.no_forward_right >> cell | blocked >> on + 1) & 1:
            ends.append((_FORWARD_RIGHT, on + 1))
        if not blocked >> here & 1:
            ends.append((_STAY, here))
        later = state - cell + self._cells + low
        fixed, costs = self.near_fixed >> low, self._costs
        charge_fixed, charge_mover = self.weights.fixed, self.weights.mover
        near = [board >> low for board in layer.near]
        found = []
        for move, end in ends:
            cost = costs[move]
            if fixed >> end & 1:
                cost += charge_fixed
            for board in near:
                if board >> end & 1:
                    cost += charge_mover
            found.append((move, later + end, cost))
        return found

    def at_goal(self, state: State) -> bool:
        """Whether the cell is in row 0."""
        return state % self._cells < self._columns

    def heuristic(self, state: State) -> int:
        """A row takes one tick, and no step on costs less than the cheapest of them."""
        return state % self._cells // self._columns * self._ahead

    def _made(self, ahead: int) -> Layer:
        forecast, road = self._forecast, self._forecast.road
        motion = forecast.slices[ahead]
        near, spread = [], motion.occupied
        for _ in range(self.weights.buffer if self.weights.mover else 0):
            spread = around(spread, road)
            near.append(spread)
        cut_left, cut_right = forecast.cut_off(ahead)
        return Layer(
            forecast.fixed | motion.occupied | forecast.taken(ahead),
            road.left_edge | motion.came_right,
            road.right_edge | motion.came_left,
            road.left_edge | cut_left << road.columns,
            road.right_edge | cut_right << road.columns,
            tuple(near),
        )
