"""Measures how hard a road is: the fewest ticks to the goal, the room to manoeuvre, how planners drive it.

The fewest ticks are proved as by a certificate (`sim.oracle.certificate`), and the plan is driven. The room
is the mean number of cells in which the vehicle can be at a tick without a collision and still arrive by a
fixed horizon; two roads are compared by the same one. It is taken from the forecast in which no mover reacts.
Drives are run to the end of the episode, as they would go.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from sim.explain.episode_rollout import rollout
from sim.goals.budget import Budget
from sim.oracle.lower_bounds import PATIENCE, foreseen, quickest_plan
from sim.oracle.other_egos import arrives
from sim.plan import traits_of
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.types import Mode, Outcome

SPARE_TICKS: Final = 5
"""The horizon of the room is so many ticks beyond the fewest ticks of the first of two roads."""

MEASURE_WORK: Final = 12
"""Units that a measurement takes, in ticks of the simplest planner."""


@dataclass(frozen=True, slots=True)
class Difficulty:
    """How hard a road is from a moment on, whoever drives."""

    ticks: int
    """the fewest ticks to the goal"""
    room: float
    """cells to choose from, on average over the ticks of the horizon"""
    horizon: int
    """ticks that the room is counted over"""


@dataclass(frozen=True, slots=True)
class Drive:
    """How a planner's drive from a moment on ends."""

    planner: str
    outcome: Outcome
    """`RUNNING` where it was not followed to its end"""
    tick: int
    """the tick at which it ends"""
    ticks: int
    """how many ticks it takes"""

    @property
    def arrives(self) -> bool:
        """Whether it reaches the goal."""
        return self.outcome is Outcome.SUCCESS


def fewest_ticks(state: SimState, budget: Budget) -> int | None:
    """The fewest ticks to the goal, by a plan that arrives when it is driven.

    None where there is no way in time, and where none was found within a bounded search.
    """
    budget.spend(state.config, MEASURE_WORK)
    budget.tried += 1
    if state.world.outcome is not Outcome.RUNNING:
        return None
    try:
        plan = quickest_plan(state, PATIENCE)
    except ImpatientError:
        return None
    if plan is None or not arrives(state, plan, None):
        return None
    return len(plan)


def measure(state: SimState, budget: Budget, horizon: int | None = None) -> Difficulty | None:
    """How hard a road is; None as for `fewest_ticks`. `horizon`: that of the road it is compared with."""
    ticks = fewest_ticks(state, budget)
    if ticks is None:
        return None
    over = ticks + SPARE_TICKS if horizon is None else horizon
    return Difficulty(ticks, room(state, over), over)


def room(state: SimState, horizon: int) -> float:
    """The mean number of cells, over the ticks of the horizon, that lie on a way that arrives by its end."""
    forecast, limit = foreseen(state)
    goal, horizon = forecast.road.row(0), min(horizon, limit)
    reached = [1 << forecast.ego]
    for ahead in range(horizon):
        reached.append(forecast.spread(reached[-1] & ~goal, ahead))
    open_end, cells = reached[horizon] & goal, 0
    for ahead in range(horizon - 1, -1, -1):
        on_a_way = forecast.spread_back(open_end, ahead) & reached[ahead] & ~goal
        cells += on_a_way.bit_count()
        open_end = on_a_way | reached[ahead] & goal
    return cells / max(1, horizon)


def driven_by(state: SimState, planner: str) -> SimState:
    """The same moment with a planner at the wheel, for measuring."""
    config = replace(state.config, planner=planner)
    return replace(state, config=config).with_ego(mode=Mode.AUTO, queue=(), planner=None)


def drive(state: SimState, planner: str, budget: Budget) -> Drive:
    """Drive to the end of the episode with a planner. Raises `BudgetSpentError`."""
    begun = driven_by(state, planner)
    work, last = traits_of(planner).work, begun
    for _, tick in rollout(begun):
        budget.spend(begun.config, 1, work)
        budget.driven += 1
        last = tick.state
    end = last.world.tick
    return Drive(planner, last.world.outcome, end, end - state.world.tick)
