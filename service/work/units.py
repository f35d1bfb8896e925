"""Units of work: what a request will cost, estimated before it starts.

One unit is one cell of road that a search to the goal reads in one tick: cells × ticks × planner. A planner
that searches reads all cells, `Traits.work` times over; one that looks around itself reads as many as
`LEAST_CELLS`, and the road as a whole hardly at all. On a machine of 2024 a unit takes 0.1 to 0.5 µs.

The estimate decides where work runs and whether it runs; results never depend on it.
"""

from __future__ import annotations

from typing import Final

from sim.config import Config
from sim.plan import traits_of
from sim.plan.protocol import SEARCH
from sim.state import SimState

UNIT_S: Final = 3e-7
"""About how long a unit takes, in seconds."""

LEAST_CELLS: Final = 200
"""Units of a tick without a search, on a small road."""

CELLS_A_UNIT: Final = 16
"""Cells of road that add one unit to a tick without a search."""

INLINE: Final = 5_000
"""Work of a request up to this is done on the event loop: one or two milliseconds."""

LIVE_INLINE: Final = 20_000
"""A tick of a live session up to this is decided on the event loop."""

TOLD: Final = 1_000
"""Units of putting one decision, or one state, into words and JSON."""

THREAD: Final = 400_000
"""Work up to this is done in a thread, where it delays the event loop by the switch interval; more in a
worker process."""


def tick_units(cells: int, planner: str, egos: int = 1) -> int:
    """Units of one tick on a road of so many cells, all egos having the same planner."""
    traits = traits_of(planner)
    base = LEAST_CELLS + cells // CELLS_A_UNIT
    return max(base, traits.work * cells if traits.plans_to_goal else traits.work * base) * egos


def move_units(state: SimState) -> int:
    """Units of one tick whose moves are known already, so that nothing is decided."""
    road = state.world.road
    return LEAST_CELLS + road.columns * road.rows // CELLS_A_UNIT


def state_tick_units(state: SimState) -> int:
    """Units of the next tick of a state."""
    road, config = state.world.road, state.config
    cells = road.columns * road.rows
    if len(state.egos) == 1:
        return tick_units(cells, state.ego().planner or config.planner)
    return sum(tick_units(cells, ego.planner or config.planner) for ego in state.egos.values())


def config_tick_units(config: Config) -> int:
    """Units of a tick of a road of this configuration."""
    return tick_units(config.columns * config.rows, config.planner)


def replay_units(state: SimState, work: int) -> int:
    """Units of `work` ticks of the simplest planner (`Timeline.work_since`) on the road of a state."""
    road = state.world.road
    cells = road.columns * road.rows
    planner = state.ego().planner or state.config.planner
    return work * max(tick_units(cells, planner) // traits_of(planner).work, LEAST_CELLS)


def search_units(state: SimState) -> int:
    """Units of one search to the goal on the road of a state, whatever its planner."""
    road = state.world.road
    return max(LEAST_CELLS, road.columns * road.rows) * SEARCH
