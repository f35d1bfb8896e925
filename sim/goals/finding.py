"""What a search for a goal found, with the figures that were measured on it."""

from __future__ import annotations

from dataclasses import dataclass

from sim.actions import GoalName, WorldAction
from sim.goals.measure import Difficulty, Drive
from sim.state import SimState


@dataclass(frozen=True, slots=True)
class Finding:
    """Actions that reach a goal, and the road that they lead to."""

    goal: GoalName
    actions: tuple[WorldAction, ...]
    """of the world alone, with every place and seed settled, so that a replay needs no search"""
    state: SimState
    after: Difficulty
    before: Difficulty | None = None
    """of the road as it was; None where a new road begins, and where there was no way"""
    drives: tuple[Drive, ...] = ()
    """how planners drive the road that was found"""
    drives_before: tuple[Drive, ...] = ()
    """how they drive the road as it was"""
    lane: int | None = None
    """the lane that is left free, 1 = leftmost"""
    row: int | None = None
    """the row in which the other lanes are blocked"""
    tried: int = 0
    """roads that were measured"""
    driven: int = 0
    """ticks that planners drove"""
