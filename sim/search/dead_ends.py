"""The cells from which the goal may still be reached, whoever reacts: a proof for those that are left out.

Structure: one sweep backwards from row 0. Movers react to the ego only in its own row, so the rows before
it go on as foretold until it enters them, and its own row is taken to be free of movers. Guarantee: from a
cell that is left out no way leads to the goal; from the others there may be none either.
"""

from __future__ import annotations

from sim.forecast import Forecast
from sim.world.grid import Board


def cells_that_may_arrive(forecast: Forecast, limit: int) -> list[Board]:
    """The cells from which the goal may be reached by `limit` ticks from now, by ticks from now."""
    road, dynamics = forecast.road, forecast.dynamics
    free, goal = road.all & ~forecast.fixed, road.row(0)
    boards = [goal & free]
    slices, may_come_from, there = forecast.slices, dynamics.may_come_from, boards[0]
    for ahead in reversed(range(limit)):
        right, left, _, _ = slices[ahead]
        there = (goal | may_come_from(there, there ^ there & (right | left))) & free
        boards.append(there)
    return boards[::-1]
