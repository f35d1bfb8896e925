"""Figures of the present drive: its way, its speed, the least time that its road takes."""

from __future__ import annotations

from dataclasses import dataclass

from sim.actions import Drive, SetMode
from sim.explain.past import past
from sim.explain.question_error import QuestionError
from sim.metrics import Metrics
from sim.oracle.lower_bounds import PATIENCE, least_ticks
from sim.search.reactive import ImpatientError
from sim.session.timeline import Timeline
from sim.types import Outcome


@dataclass(frozen=True, slots=True)
class DriveSoFar:
    """The present drive up to now, or to its end, in figures."""

    first: int
    last: int
    """its first and its latest tick"""
    rows: int
    """rows from where it began to the goal"""
    left: int
    """rows that are left"""
    half: int | None
    """the first tick at which half of the rows, or more, were done; None while they are not"""
    lanes: tuple[int, int]
    """the column in which it began, and the latest"""
    counted: Metrics
    """what was counted in it"""
    outcome: Outcome

    @property
    def ticks(self) -> int:
        """Ticks that it has lasted."""
        return self.last - self.first

    @property
    def done(self) -> int:
        """Rows that it came ahead."""
        return self.rows - self.left


@dataclass(frozen=True, slots=True)
class BestTime:
    """The least ticks in which the road of a drive leads to the goal, from where the drive began."""

    drive: DriveSoFar
    ticks: int | None
    """None: no way leads there in time, or it was not found out"""
    known: bool
    """whether it was searched to the end"""
    changed: bool
    """whether the road or a setting was changed during the drive"""
    from_here: int | None
    """the least ticks from now, where the drive goes on and that is known"""


def drive_so_far(timeline: Timeline, *, begun: bool = True) -> DriveSoFar:
    """The figures of the present drive.

    Raises `QuestionError`: `nothing_yet` where nothing was driven, unless it need not have `begun`.
    """
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if first >= last and begun:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    cells = [state.world.road.cell(state.world.av) for state in timeline.between(first, last + 1)]
    lanes, rows = (cells[0][0], cells[-1][0]), [row for _, row in cells]
    half = next((tick for tick, row in enumerate(rows, first) if 2 * row <= rows[0]), None)
    counted = past(timeline, first, last).counted
    return DriveSoFar(first, last, rows[0], rows[-1], half, lanes, counted, world.outcome)


def best_time(timeline: Timeline) -> BestTime:
    """The least time of this road as it was when the drive began."""
    drive = drive_so_far(timeline, begun=False)
    start = timeline.at(drive.first)
    said = [
        entry
        for entry in timeline.entries
        if drive.first < entry.tick <= drive.last and not isinstance(entry.action, (SetMode, Drive))
    ]
    ticks, known = None, True
    try:
        ticks = least_ticks(start, PATIENCE)
    except ImpatientError:
        known = False
    here = None
    if drive.outcome is Outcome.RUNNING:
        try:
            here = least_ticks(timeline.state, PATIENCE)
        except ImpatientError:
            here = None
    return BestTime(drive, ticks, known, bool(said), here)
