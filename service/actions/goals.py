"""Actions that stand for others: a goal, which is looked for, and a driving style, which is a named set.

What they come to is settled when they are done, and stored in their place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from annotated_types import MaxLen, MinLen

from service.actions.steering import STRICT
from sim.actions import Degree, GoalName
from sim.planner_names import PlannerName

StyleName = Annotated[str, MinLen(1), MaxLen(40)]
"""The name of a style in `prompts/styles.yaml`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """A road, or a change of the present one, that is looked for and measured (`sim.goals`)."""

    do: Literal["goal"] = "goal"
    goal: GoalName
    planners: tuple[PlannerName, PlannerName] | None = None
    """for `separates`: the one that arrives, and the one that does not"""
    degree: Degree | None = None
    """for `harder` and `easier`"""

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        if (self.planners is not None) is not (self.goal == "separates"):
            raise ValueError("'planners' belong to the goal that separates them, which needs both")
        if self.degree is not None and self.goal not in ("harder", "easier"):
            raise ValueError("'degree' belongs to the goals harder and easier")


@dataclass(frozen=True, slots=True, kw_only=True)
class Style:
    """A named set of preferences and settings (`prompts/styles.yaml`)."""

    do: Literal["style"] = "style"
    style: StyleName

    __pydantic_config__ = STRICT
