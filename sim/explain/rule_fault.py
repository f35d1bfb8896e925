"""What a planner's own method had to do with a crash, and whether other planners kept clear from then on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.explain.blame import Blame, blame
from sim.explain.planners import PlannerDrive, drive_each, others_than
from sim.session.timeline import Timeline

BEFORE: Final = 6
"""Ticks before a crash from which other planners are driven where no way out of it was found."""


@dataclass(frozen=True, slots=True)
class RuleFault:
    """A crash, and what other planners make of the same situation."""

    blame: Blame
    since: int
    """the tick from which they were driven: that of the last way out, or a few before the crash"""
    others: tuple[PlannerDrive, ...]

    @property
    def kept_clear(self) -> tuple[str, ...]:
        """The planners that do not crash from then on."""
        return tuple(
            each.planner for each in self.others if each.foresight.told and not each.foresight.crashes
        )

    @property
    def crashed(self) -> tuple[str, ...]:
        """Those that crash as well, for certain or by chance."""
        return tuple(each.planner for each in self.others if each.foresight.crashes)


def rule_fault(timeline: Timeline, tick: int | None = None) -> RuleFault:
    """The latest crash, or that of a tick. Raises `QuestionError` as `why_crashed` does."""
    found = blame(timeline, tick)
    last, world = found.avoidable.last, found.state.world
    since = max(world.episode_start, world.tick - BEFORE) if last is None else last.tick
    state = timeline.at(since)
    return RuleFault(found, since, tuple(drive_each(state, others_than(state))))
