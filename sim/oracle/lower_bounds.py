"""The least ticks and the least cost from a moment to the goal, as the rules and the charges say.

The least ticks are exact: movers that give way or brake are searched with the reactions they are drawn to
have. The least cost assumes that nobody reacts to the ego after the first tick.

All of it is about one ego, the first by default, in a road where the others stay. Where another ego drives,
nothing is claimed: `UndeterminedError`, which is an `ImpatientError` (`sim.oracle.other_egos`).
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Final

from sim.forecast import Forecast
from sim.oracle.other_egos import UndeterminedError, alone, arrives, check_others_stay, truth_for
from sim.search.astar import cheapest
from sim.search.compiled_costs import compiled_costs
from sim.search.compiled_rows import compiled_least_ticks, rows_are_compiled_for
from sim.search.costs import TICKS_ALONE, weights
from sim.search.reachability import flood_fill, reachability, shortest_plan, steps_left
from sim.search.reactive import ReactiveSearch
from sim.search.time_expanded import TimeExpandedGraph
from sim.search.way_ahead import finds_way_ahead
from sim.state import SimState
from sim.types import Move, Outcome

PATIENCE: Final = 1_000
"""States searched for an answer to a question, where movers react: some 30 ms."""


def foreseen(state: SimState, *, ego: str | None = None, gone: Collection[str] = ()) -> tuple[Forecast, int]:
    """The forecast to the episode's end, and the steps left; `gone`: other egos that are left out.

    Raises `ValueError` after the end, and `UndeterminedError`.
    """
    if state.world.outcome is not Outcome.RUNNING:
        raise ValueError("the episode has ended")
    check_others_stay(state, ego, gone)
    if state.config.slips:
        raise UndeterminedError("slips")
    limit = steps_left(state.config, state.world.episode_tick)
    return truth_for(state, max(1, limit), ego, gone), limit


def least_ticks(
    state: SimState, patience: int | None = None, ego: str | None = None, gone: Collection[str] = ()
) -> int | None:
    """Ticks of the quickest way from here to row 0 that meets nothing; None: there is no way in time.

    Where movers react, `patience` is how many states are searched; then it raises `ImpatientError`. `gone`:
    other egos that are taken not to be there.
    """
    if len(state.world.avs) > 1:
        return _least_ticks_among_others(state, patience, ego, gone)
    if state.world.outcome is Outcome.SUCCESS:
        return 0
    if state.world.outcome is not Outcome.RUNNING:
        return None
    forecast, limit = foreseen(state)
    ticks = _ticks_without_reactions(forecast, limit)
    if _settled(state, ticks, forecast):
        return ticks
    bound = _bound(state, ticks, limit)
    quicker = None
    if ticks is not None or _passable(forecast):
        quicker = _searched(state, forecast, patience, bound)
    return ticks if quicker is None and state.config.free_ways_hold else quicker


def _ticks_without_reactions(forecast: Forecast, limit: int) -> int | None:
    """The ticks of a quickest way where nobody brakes, by compiled words where these are loaded."""
    percept = forecast.percept
    unheeded = replace(percept, attentive=0) if percept.attentive else percept
    found = compiled_costs(unheeded, TICKS_ALONE, limit)
    if found is None:
        return reachability(forecast, 1 << forecast.ego, limit).ticks
    return min((total for total in found.totals if total is not None), default=None)


def _searched(state: SimState, forecast: Forecast, patience: int | None, bound: int) -> int | None:
    """The ticks of a quickest way with the reactions of movers, by compiled words where these are loaded."""
    world, config = state.world, state.config
    if patience is not None and rows_are_compiled_for(world, config):
        return compiled_least_ticks(world, config, bound, patience)
    return ReactiveSearch(world, config, forecast, patience).least_ticks(bound)


def _least_ticks_among_others(
    state: SimState, patience: int | None, ego: str | None, gone: Collection[str]
) -> int | None:
    """`least_ticks` of one of several egos: a way that is found is played before it counts."""
    world = state.world
    if world.avs[state.number(ego)] < world.road.columns and world.outcome is not Outcome.CRASH:
        return 0
    if world.outcome is not Outcome.RUNNING:
        return None
    plan = quickest_plan(state, patience, ego=ego, gone=gone)
    if plan is not None and not arrives(state, plan, ego, gone):
        # A mover that does not brake for an ego that stays ends the episode; the search has it brake.
        raise UndeterminedError("hit")
    return None if plan is None else len(plan)


def quickest_plan(
    state: SimState, patience: int | None = None, *, ego: str | None = None, gone: Collection[str] = ()
) -> tuple[Move, ...] | None:
    """The moves of a way of `least_ticks` from here; None: there is no way in time.

    Raises `ValueError` after the end, and `ImpatientError` as `least_ticks` does.
    """
    forecast, limit = foreseen(state, ego=ego, gone=gone)
    plan = shortest_plan(forecast, limit)
    ticks = None if plan is None else len(plan)
    if _settled(state, ticks, forecast):
        return plan
    bound = _bound(state, ticks, limit)
    quicker = None
    if ticks is not None or _passable(forecast):
        quicker = ReactiveSearch(alone(state, ego), state.config, forecast, patience).plan(bound)
    return plan if quicker is None and state.config.free_ways_hold else quicker


def can_arrive(
    state: SimState,
    patience: int | None = None,
    ego: str | None = None,
    gone: Collection[str] = (),
    *,
    states_ahead: int = 0,
) -> bool:
    """Whether the goal can be reached from here in time. `patience` and `gone`: as for `least_ticks`.

    `states_ahead`: so many states are looked at first by going straight ahead, which is quick on most roads.
    """
    if len(state.world.avs) > 1:
        return least_ticks(state, patience, ego, gone) is not None
    if state.world.outcome is not Outcome.RUNNING:
        return state.world.outcome is Outcome.SUCCESS
    forecast, limit = foreseen(state)
    if state.config.free_ways_hold and reachability(forecast, 1 << forecast.ego, limit).ticks is not None:
        return True
    if not state.config.reacting or not _passable(forecast):
        return False
    search = ReactiveSearch(state.world, state.config, forecast, patience)
    if states_ahead and finds_way_ahead(search, limit, states_ahead):
        return True
    return search.least_ticks(limit) is not None


def least_cost(state: SimState, *, ego: str | None = None) -> int | None:
    """The cheapest way from here to row 0 by the configuration's charges; None: none is known.

    Raises `UndeterminedError`.
    """
    world = state.world
    arrived = world.avs[state.number(ego)] < world.road.columns and world.outcome is not Outcome.CRASH
    if world.outcome is Outcome.SUCCESS if len(world.avs) == 1 else arrived:
        return 0
    if world.outcome is not Outcome.RUNNING:
        return None
    forecast, limit = foreseen(state, ego=ego)
    if reachability(forecast, 1 << forecast.ego, limit).ticks is None:
        return None  # a heuristic search would try everything before it gave up
    terrain = TimeExpandedGraph(forecast, weights(state.config), limit)
    way = cheapest(terrain, terrain.start)
    return None if way is None else way.cost


def _settled(state: SimState, ticks: int | None, forecast: Forecast) -> bool:
    """Whether reactions of movers cannot lead to the goal sooner than a way found without them."""
    # A way that meets nothing in the roll-out without reactions causes none, unless movers give way. No way
    # takes less than a tick a row.
    fewest = -(-(forecast.ego // forecast.road.columns) // forecast.dynamics.rows_a_tick)
    return not state.config.reacting or (state.config.free_ways_hold and ticks == fewest)


def _bound(state: SimState, ticks: int | None, limit: int) -> int:
    """Ticks within which a quicker way would have to arrive."""
    return limit if ticks is None or not state.config.free_ways_hold else ticks - 1


def _passable(forecast: Forecast) -> bool:
    """Whether a way leads past the fixed hazards, were there no movers."""
    return bool(flood_fill(forecast, 1 << forecast.ego) & forecast.road.row(0))
