"""How the present drive compares with the planner's drives on roads drawn alike from other seeds.

A drive that arrived is better than one that did not, and of two that arrived the quicker one. A drive that is
under way is compared at the same tick: how many rows each had come ahead by then.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import median

from sim.explain.closest_call import near_misses
from sim.explain.drive_figures import DriveSoFar, drive_so_far
from sim.explain.question_error import QuestionError
from sim.explain.seed_drives import SeedDrive, seed_drives
from sim.session.timeline import Timeline
from sim.types import Outcome


@dataclass(frozen=True, slots=True)
class Typical:
    """The present drive beside others, in facts."""

    drive: DriveSoFar
    misses: int
    """its near misses"""
    others: tuple[SeedDrive, ...]
    better: int
    """how many of the others went better, or had come further by this tick"""
    worse: int
    changed: bool
    """whether the road or a setting was changed during the drive, or a person drove"""

    @property
    def ended(self) -> bool:
        """Whether whole drives are compared."""
        return self.drive.outcome is not Outcome.RUNNING

    @property
    def standing(self) -> str:
        """`better` or `worse` than more than half of the others; else `usual`."""
        for name, count in (("better", self.worse), ("worse", self.better)):
            if 2 * count > len(self.others):
                return name
        return "usual"

    def count(self, outcome: Outcome) -> int:
        """How many of the others ended so; by this tick, where the drive is under way."""
        return sum(
            each.outcome is outcome and (self.ended or each.ticks <= self.drive.ticks) for each in self.others
        )

    def count_all(self, outcome: Outcome) -> int:
        """How many of the others ended so in the end."""
        return sum(each.outcome is outcome for each in self.others)

    @property
    def usual_ticks(self) -> float | None:
        """The median of the ticks of the others that ended as this one did; None where none did."""
        return _median([each.ticks for each in self.others if each.outcome is self.drive.outcome])

    @property
    def usual_rows(self) -> float:
        """The median of the rows that the others had come ahead by this tick."""
        return float(median(each.rows_after(self.drive.ticks) for each in self.others))

    @property
    def usual_stays(self) -> float:
        """The mean of the ticks that the others stayed; up to this tick, where the drive is under way."""
        return self._mean([each.stays for each in self.others])

    @property
    def usual_misses(self) -> float:
        """The same of near misses."""
        return self._mean([each.misses for each in self.others])

    def _mean(self, ticks: list[tuple[int, ...]]) -> float:
        """How many there are on average, of those that are compared."""
        counted = [sum(self.ended or tick < self.drive.ticks for tick in each) for each in ticks]
        return sum(counted) / len(counted)


def typical(timeline: Timeline, *, begun: bool = True) -> Typical:
    """The present drive beside the planner's drives of the next seeds.

    `begun`: whether it has to have begun. Raises `QuestionError`: `nothing_yet`; `too_long_again` as
    `seed_drives`, and where an end of those drives is too far to tell.
    """
    drive = drive_so_far(timeline, begun=begun)
    others = seed_drives(timeline)
    if any(each.outcome is Outcome.RUNNING for each in others):
        raise QuestionError("too_long_again")
    if drive.outcome is Outcome.RUNNING:
        own: tuple[int, ...] = (drive.done,)
        ranks: list[tuple[int, ...]] = [(each.rows_after(drive.ticks),) for each in others]
    else:
        own = _rank(drive.outcome, drive.ticks)
        ranks = [_rank(each.outcome, each.ticks) for each in others]
    states = list(timeline.between(drive.first, drive.last + 1))
    start = states[0]
    return Typical(
        drive,
        len(near_misses(states)),
        others,
        sum(each > own for each in ranks),
        sum(each < own for each in ranks),
        drive_by_hand(timeline, drive)
        or any((each.edits, each.config) != (start.edits, start.config) for each in states),
    )


def drive_by_hand(timeline: Timeline, drive: DriveSoFar) -> bool:
    """Whether a person asked for a move of the drive."""
    made = (timeline.decision(tick) for tick in range(drive.first, drive.last))
    return any(each is not None and each.asked is not None for each in made)


def _rank(outcome: Outcome, ticks: int) -> tuple[int, ...]:
    """How well a drive went, the higher the better."""
    return (1, -ticks) if outcome is Outcome.SUCCESS else (0, 0)


def _median(values: list[int]) -> float | None:
    return float(median(values)) if values else None
