"""The cells from which the goal may still be reached, whoever reacts: a proof for those that are left out.

Structure: one sweep backwards from row 0. Movers react to the vehicle only in its own row, so the rows before
it go on as foretold until it enters them, and its own row is taken to be free of movers. Guarantee: from a
cell that is left out no way leads to the goal; from the others there may be none either.
"""

from __future__ import annotations

from sim.config import Config
from sim.forecast import foretell
from sim.perceive import perceive
from sim.road import Board
from sim.rules import beside
from sim.search.reach import steps_left
from sim.world import World


def leading_on(world: World, config: Config) -> list[Board]:
    """The cells from which the goal may still be reached, by ticks from now, up to the limit of ticks."""
    percept = perceive(world, config)
    road, limit = percept.road, steps_left(config, percept.episode_tick)
    forecast = foretell(percept, max(1, limit))
    free, goal = road.all & ~forecast.fixed, road.row(0)
    boards = [goal & free]
    for ahead in reversed(range(limit)):
        there = boards[-1]
        entered = there & ~forecast.slices[ahead].occupied
        within = beside(there, road.left_edge, road.right_edge)
        before = beside(entered, road.left_edge, road.right_edge) << road.columns
        boards.append((goal | within | before) & free)
    return boards[::-1]
