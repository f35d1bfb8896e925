"""Deciding: Forecast → Decision with its trace. Planners are found by name."""

from sim.plan.decision import Decision, Option
from sim.plan.registry import Planner, planner_named, register

__all__ = ["Decision", "Option", "Planner", "planner_named", "register"]
