"""The quickest way that meets nothing, from where the present drive began or from now, as a course."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import Final

from sim.explain.drive_figures import DriveSoFar, drive_so_far
from sim.explain.foresight import running_state
from sim.oracle.lower_bounds import quickest_plan
from sim.search.reactive import ImpatientError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move

STATES: Final = 15_000
"""States that are searched where movers react: about a second, as for a drive that got stuck."""


@dataclass(frozen=True, slots=True)
class BestWay:
    """A quickest way to the goal, in facts."""

    drive: DriveSoFar
    start: SimState
    """where it begins"""
    here: bool
    """whether that is now, rather than the start of the drive"""
    plan: tuple[Move, ...] | None
    """its moves; None: no way leads to the goal in time, or it was not found out"""
    known: bool
    """whether it was searched to the end"""
    columns: tuple[int, ...]
    """the columns that it goes through in their order, each as often as it is come to"""
    changed: bool
    """whether the road or a setting was changed since where it begins"""


def best_way(timeline: Timeline, *, here: bool = False) -> BestWay:
    """The quickest way from the start of the drive, or from now. Raises `QuestionError`: `nothing_ahead`."""
    drive = drive_so_far(timeline, begun=False)
    start = running_state(timeline) if here else timeline.at(drive.first)
    plan, known = None, True
    try:
        plan = quickest_plan(start, STATES)
    except ImpatientError:
        known = False
    column = start.world.road.cell(start.world.av)[0]
    passed = [column]
    for move in plan or ():
        column += move.offset[0]
        passed.append(column)
    states = () if here else timeline.between(drive.first, drive.last + 1)
    changed = any((each.edits, each.config) != (start.edits, start.config) for each in states)
    return BestWay(drive, start, here, plan, known, tuple(each for each, _ in groupby(passed)), changed)
