"""Looks for what a goal asks for, within a budget: the same moment of a session always finds the same."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sim.actions import Degree, GoalName
from sim.goals.budget import Budget, BudgetSpentError
from sim.goals.finding import Finding
from sim.goals.more_or_less import find_easier, find_harder
from sim.goals.new_road import find_hard_road, find_separating_road, find_surprise
from sim.goals.one_lane import find_one_lane
from sim.oracle.other_egos import UndeterminedError
from sim.session.errors import EditError
from sim.state import SimState


def find_goal(
    state: SimState,
    goal: GoalName,
    *,
    planners: Sequence[str] = (),
    degree: Degree | None = None,
    budget: Budget | None = None,
) -> Finding:
    """The actions that reach a goal from a state, each figure of them measured and each claim run.

    `planners`: for `separates`, one that arrives and one that does not. Raises `EditError` where nothing is
    found, `CancelledError` where nobody waits any more.
    """
    spent = Budget() if budget is None else budget
    if len(state.egos) > 1:
        raise EditError("goal_among_egos", "goal")
    try:
        found = _find(state, goal, planners, degree, spent)
    except (BudgetSpentError, UndeterminedError):
        found = None
    if found is None:
        raise EditError("goal_not_found", "goal", tried=spent.tried, driven=spent.driven)
    return replace(found, tried=spent.tried, driven=spent.driven)


def _find(
    state: SimState, goal: GoalName, planners: Sequence[str], degree: Degree | None, budget: Budget
) -> Finding | None:
    match goal:
        case "harder":
            return find_harder(state, degree, budget)
        case "easier":
            return find_easier(state, degree, budget)
        case "one_lane_free":
            return find_one_lane(state, budget)
        case "surprise":
            return find_surprise(state, budget)
        case "hard_but_solvable":
            return find_hard_road(state, budget)
        case "separates":
            can, cannot = planners
            return find_separating_road(state, can, cannot, budget)
