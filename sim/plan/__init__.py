"""Deciding: Forecast → Decision with its trace. Planners are found by name."""

from sim.plan.decision import Decision, Measure, Option
from sim.plan.registry import Planner, planner_named, register

__all__ = ["Decision", "Measure", "Option", "Planner", "planner_named", "register"]
