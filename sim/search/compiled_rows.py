"""What kernels find that work row by row, once they are loaded; a leaf, as `sim.search.compiled_costs`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from sim.config import Config
from sim.perceive import Percept
from sim.rules.compiled import compiled_rules
from sim.search.compiled_costs import Unlike, are_loaded
from sim.types import Kind, Move, Outcome
from sim.world import World

BY_RANK: Final = ("priority", "rules")
"""The planners that the kernels know which decide from the vehicle's row and the next one."""
BY_COST: Final = ("astar", "dijkstra", "bfs")
"""Those that the kernels know which look to the goal."""
MOST_COLUMNS: Final = 62
"""Columns of the widest road that the kernels know."""


def rows_are_compiled_for(world: World, config: Config) -> bool:
    """Whether the kernels know this road with one vehicle under way, its movers and rules, and are loaded."""
    boards = world.boards
    return (
        are_loaded()
        and len(world.avs) == 1
        and world.outcome is Outcome.RUNNING
        and world.road.columns <= MOST_COLUMNS
        and compiled_rules(config)
        and boards.others == boards[Kind.PEDESTRIAN]
        and not world.moving & boards.fixed & ~boards.holding
    )


def compiled_least_ticks(world: World, config: Config, limit: int, patience: int) -> int | None:
    """`sim.search.reactive.ReactiveSearch.least_ticks`. Precondition: `rows_are_compiled_for`.

    Raises `ImpatientError`.
    """
    from sim.batch.row_words import least_ticks_of

    return least_ticks_of(world, config, limit, patience)


def compiled_moves_by_rank(percept: Percept, planner: str, unlike: Sequence[Unlike]) -> list[Move]:
    """The moves that `priority` or `rules` makes where each of these things is seen otherwise.

    Precondition: the kernels know what is seen, and are loaded.
    """
    from sim.batch.row_words import moves_by_rank

    return moves_by_rank(percept, planner, unlike)
