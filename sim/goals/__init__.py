"""Roads, and changes of roads, that are looked for: harder, easier, separating planners, one lane free."""

from sim.goals.budget import Budget, CancelledError
from sim.goals.find import find_goal
from sim.goals.finding import Finding
from sim.goals.measure import Difficulty, Drive

__all__ = [
    "Budget",
    "CancelledError",
    "Difficulty",
    "Drive",
    "Finding",
    "find_goal",
]
