"""Deciding: Forecast → Decision with its trace. Planners are found by name."""

from sim.plan.decision import Decision, Measure, Option
from sim.plan.protocol import Planner, Traits
from sim.plan.registry import planner_named, register, traits_of

__all__ = ["Decision", "Measure", "Option", "Planner", "Traits", "planner_named", "register", "traits_of"]
