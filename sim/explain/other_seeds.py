"""How it ends on roads that are drawn alike from other seeds: each driven once, to its end."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Final

from sim.explain.episode_rollout import story
from sim.explain.foresight import driving
from sim.explain.question_error import QuestionError
from sim.plan import traits_of
from sim.session.timeline import Timeline
from sim.types import Outcome

SEEDS: Final = 10
"""Seeds that are looked at: those that follow the session's."""


@dataclass(frozen=True, slots=True)
class OtherSeeds:
    """How it ends with each of some seeds, in facts."""

    planner: str
    first: int
    """the first of the seeds"""
    outcomes: tuple[Outcome, ...]
    """how it ends with each; `running` where its end is too far to tell"""

    @property
    def last(self) -> int:
        """The last of the seeds."""
        return self.first + len(self.outcomes) - 1

    @property
    def counts(self) -> Counter[Outcome]:
        """How often it ends in each way."""
        return Counter(self.outcomes)


def other_seeds(timeline: Timeline) -> OtherSeeds:
    """How the planner's drives end on the first roads that the next seeds draw from the present settings.

    A person who drives is left out: the planner drives. So is what was put on this road by hand.
    Raises `QuestionError`: `too_long_again` for a planner that takes long, or with several egos.
    """
    state = timeline.state
    if not traits_of(state.config.planner).quick or len(state.world.avs) > 1:
        raise QuestionError("too_long_again")
    first = state.config.seed + 1
    outcomes = []
    for seed in range(first, first + SEEDS):
        begun = Timeline(state.config.with_parts(seed=seed)).state
        outcomes.append(story(driving(begun)).outcome)
    return OtherSeeds(str(state.config.planner), first, tuple(outcomes))
