"""The least cost from every state to row 0, by one sweep backwards through the layers of time.

Every step leads exactly one tick on, so that going backwards tick by tick settles states in an order
that Dijkstra's algorithm would accept, and no queue is needed (dynamic programming; Bellman, 1957). How
far ahead a cheapest way can lie is bounded first: for each first move a way of least ticks is found with
sets of cells and charged, and no way of more ticks than that pays for can be cheaper. Guarantee: exact,
for all six moves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from sim.forecast import Forecast
from sim.rules.grid_dynamics import GridDynamics, GridMasks
from sim.search.astar import cheapest, no_heuristic
from sim.search.continued import Known, continued, keep
from sim.search.costs import Weights
from sim.search.reachability import none_leads_on, on_shortest, reachability
from sim.search.time_expanded import TimeExpandedGraph
from sim.search.waiting_cost import cost_of_staying
from sim.types import MOVES, Move
from sim.world.grid import Board

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

SWEPT: Final = "swept"
"""The kind of search under which sweeps are kept."""
FAR = 1 << 40
"""More than any way costs."""


def totals_by_move(forecast: Forecast, weights: Weights, limit: int) -> tuple[int | None, ...]:
    """What every move now costs with the cheapest way on, in the order of `Move`; None: no way."""
    terrain = TimeExpandedGraph(forecast, weights, limit)
    if not isinstance(forecast.dynamics, GridDynamics):
        return _searched_totals(forecast, terrain, limit)
    staying = cost_of_staying(forecast, weights, limit)
    totals = _known_totals(forecast, terrain, limit)
    if totals is None:
        horizon = _horizon(forecast, terrain, limit)
        if horizon == 0:
            return tuple(staying if move is Move.STAY else None for move in MOVES)
        entering = _sweep(forecast, terrain, horizon)
        totals = _looked_up(forecast, terrain, entering[0])
        if not forecast.egos:
            keep(SWEPT, Known(forecast, weights, limit, entering))
    if staying is not None:
        totals[MOVES.index(Move.STAY)] = staying
    return tuple(totals)


def _known_totals(forecast: Forecast, terrain: TimeExpandedGraph, limit: int) -> list[int | None] | None:
    """The totals from an earlier sweep; None where there is none, or it did not look far enough ahead.

    No way of more ticks than were swept costs less than a tick for each of them.
    """
    found = continued(SWEPT, forecast, terrain.weights, limit)
    if found is None:
        return None
    known, ahead = found
    entering = known.found
    left = len(entering) - ahead
    if left <= 0 or forecast.ego // forecast.road.columns >= entering.shape[1]:
        return None
    totals = _looked_up(forecast, terrain, entering[ahead])
    steps = forecast.steps(1 << forecast.ego)
    swept = all(
        total is not None and total <= (left + 1) * terrain.weights.tick
        for there, total in zip(steps, totals, strict=True)
        if there
    )
    return totals if swept else None


def _looked_up(
    forecast: Forecast, terrain: TimeExpandedGraph, entering: NDArray[np.int64]
) -> list[int | None]:
    """What every step costs in all. `entering`: what entering each cell now costs with the way on."""
    columns = forecast.road.columns
    totals: list[int | None] = []
    for there, step in zip(forecast.steps(1 << forecast.ego), terrain.moves, strict=True):
        total = FAR
        if there:
            row, column = divmod(there.bit_length() - 1, columns)
            total = int(entering[row, column + 1]) + step.cost
        totals.append(total if total < FAR else None)
    return totals


def _searched_totals(forecast: Forecast, terrain: TimeExpandedGraph, limit: int) -> tuple[int | None, ...]:
    """The same for any motion: searched state by state, without a heuristic."""
    totals: list[int | None] = [None] * len(MOVES)
    for place, there, cost in terrain.steps(terrain.start):
        way = cheapest(terrain, there, heuristic=no_heuristic)
        totals[place] = None if way is None else cost + way.cost
    if totals[-1] is None:
        totals[-1] = cost_of_staying(forecast, terrain.weights, limit)
    return tuple(totals)


def _horizon(forecast: Forecast, terrain: TimeExpandedGraph, limit: int) -> int:
    """Ticks within which the cheapest way of every first move that has one ends."""
    furthest = 0
    steps = forecast.steps(1 << forecast.ego) if limit else ()
    if limit and none_leads_on(forecast, steps, limit):
        return 0
    for move, there in zip(MOVES, steps, strict=False):
        if not there:
            continue
        found = reachability(forecast, there, limit - 1, after=1, whole=False)
        if found.ticks is None:
            continue
        needed = on_shortest(forecast, found, after=1)
        cost = _charged(forecast, terrain, there, needed) + terrain.weights.of(move)
        cost += terrain.charge(0, there.bit_length() - 1)
        furthest = max(furthest, cost // terrain.weights.tick)
    return min(furthest, limit)


def _charged(forecast: Forecast, terrain: TimeExpandedGraph, here: Board, needed: list[Board]) -> int:
    """What one of the ways through these layers costs, the first of which is one tick from now."""
    total = 0
    for ahead, wanted in enumerate(needed[1:], 1):
        for move, there in zip(MOVES, forecast.steps(here, ahead), strict=True):
            if there & wanted:
                total += terrain.weights.of(move) + terrain.charge(ahead, there.bit_length() - 1)
                here = there
                break
    return total


def _sweep(forecast: Forecast, terrain: TimeExpandedGraph, horizon: int) -> NDArray[np.int64]:
    """What entering each cell in each tick costs with the cheapest way on.

    Shape: ticks, rows, columns + 2; the edges are far.
    """
    import numpy as np

    road, weights = forecast.road, terrain.weights
    rows = forecast.ego // road.columns + 1
    layers = [terrain.layer(ahead) for ahead in range(horizon)]
    inside = np.s_[:, :, 1:-1]

    def fields(boards: list[Board]) -> NDArray[np.bool_]:
        """Boards as cells (shape: boards, rows, columns); rows behind the ego are left out."""
        size = (road.columns * road.rows + 7) // 8
        raw = np.frombuffer(b"".join(board.to_bytes(size, "little") for board in boards), np.uint8)
        flat = np.unpackbits(raw.reshape(len(boards), size), axis=1, bitorder="little")
        return flat[:, : rows * road.columns].reshape(len(boards), rows, road.columns).astype(np.bool_)

    entering = np.full((horizon, rows, road.columns + 2), FAR, np.int64)
    masks: list[GridMasks] = [layer.obstacles for layer in layers]
    charges = np.zeros((horizon, rows, road.columns), np.int64)
    charges += weights.fixed * fields([terrain.near_fixed])
    for distance in range(len(layers[0].near)):
        charges += weights.mover * fields([layer.near[distance] for layer in layers])
    for doubtful in terrain.doubtful:
        charges += weights.doubt * fields([doubtful])
    charges[fields([each.blocked for each in masks])] = FAR
    entering[inside] = charges
    no_left, no_right, no_forward_left, no_forward_right = (
        FAR * fields([each.closed[side] & road.all for each in masks]).astype(np.int64) for side in range(4)
    )

    cost = {move: weights.of(move) for move in MOVES}
    value = np.full((rows, road.columns + 2), FAR, np.int64)
    value[0, 1:-1] = 0
    for ahead in range(horizon - 1, -1, -1):
        enter = entering[ahead]
        np.add(enter, value, out=enter)
        if ahead == 0:
            break
        here, on = enter[1:], enter[:-1]
        best = on[:, 1:-1] + cost[Move.FORWARD]
        np.minimum(best, here[:, :-2] + no_left[ahead, 1:] + cost[Move.LEFT], out=best)
        np.minimum(best, here[:, 2:] + no_right[ahead, 1:] + cost[Move.RIGHT], out=best)
        np.minimum(best, on[:, :-2] + no_forward_left[ahead, 1:] + cost[Move.FORWARD_LEFT], out=best)
        np.minimum(best, on[:, 2:] + no_forward_right[ahead, 1:] + cost[Move.FORWARD_RIGHT], out=best)
        np.minimum(best, here[:, 1:-1] + cost[Move.STAY], out=best)
        np.minimum(best, FAR, out=value[1:, 1:-1])
    return entering
