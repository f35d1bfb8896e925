"""What a planner is, and what may be known of it beforehand: its traits, which stand on its class."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from sim.config import Config
from sim.forecast import Forecast
from sim.plan.decision import Decision

SIMPLEST = 1
"""Work of the simplest planner's decision."""
SEARCH = 16
"""Work of a decision that searches to the goal, in the same unit."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Traits:
    """What is true of every decision of a planner, on every road.

    The defaults are safe for an unknown planner: they cost time, but make no statement about it false.
    Planners of other packages always have the defaults, whatever their class says.
    """

    local: bool = False
    """Decides from what never moves and the movers of its row and the next one. While its vehicle stays in a
    row, a situation that comes again then proves a livelock (`sim.repetition`)."""
    near: bool = False
    """Of what never moves, too, reads nothing beyond its row and the next one."""
    forward_only: bool = False
    """Reads no mover behind the ego's row beyond the range of its costs (`weighs_costs`), and for the coming
    tick only the forecast's slices. Futures that differ elsewhere are merged (`sim.explain.confidence`)."""
    weighs_costs: bool = False
    """Charges by `sim.search.costs`, and so heeds preferences and the safety buffer."""
    plans_to_goal: bool = True
    """Searches as far as the goal, so that a decision takes the longer the larger the road is. Rollouts of
    such a planner are limited (`sim.explain.episode_rollout`)."""
    by_passages: bool = False
    """Ranks the moves by where `sim.plan.rule_based.standing` says that they lead, so that its decisions are
    explained by that."""
    deterministic: bool = True
    """Decides the same whenever it is asked the same. One that does not cannot be registered: a past decision
    is found by asking again. In a package of its own its decisions are recorded."""
    work: int = SEARCH
    """Work of one decision, in decisions of the simplest planner. It sets the spacing of snapshots and tells
    whether a question may take long."""
    decisions_per_answer: int = 120
    """Decisions that one answer about chances may take (`sim.explain.confidence`)."""

    @property
    def quick(self) -> bool:
        """Whether hundreds of decisions are taken in no time."""
        return self.work == SIMPLEST


UNKNOWN = Traits()
"""The traits of a planner of which nothing is known."""


class Planner(Protocol):
    """Anything that decides from a forecast. It must be a pure function of what it is given."""

    name: str
    traits: Traits = UNKNOWN

    def horizon(self, config: Config) -> int:
        """How many ticks of forecast it wants to read."""

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        """The move, with a verdict on every move."""
