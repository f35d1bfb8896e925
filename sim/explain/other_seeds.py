"""How it ends on roads that are drawn alike from other seeds: each driven once, to its end."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from sim.explain.seed_drives import seed_drives
from sim.session.timeline import Timeline
from sim.types import Outcome


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

    Raises `QuestionError` as `seed_drives` does.
    """
    drives = seed_drives(timeline)
    return OtherSeeds(
        str(timeline.state.config.planner), drives[0].seed, tuple(each.outcome for each in drives)
    )
