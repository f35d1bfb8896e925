"""The least time to collision of a drive, with what was ahead in the ego's lane.

The time to collision is the usual one: how long until contact if both kept the motion that they have (J. C.
Hayward, *Near-miss determination through use of a scale of danger*, 1972). It is taken at each tick of the
drive with each thing ahead in the lane that the ego is in then: the distance from body to body, over the
speed at which it shrinks. Where it does not shrink, or the motions do not meet, there is none.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from sim.explain.closest_call import ticks_to_contact
from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.rules.collision_geometry import Path
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, Outcome


@dataclass(frozen=True, slots=True)
class LeastTtc:
    """The least time to collision, in facts."""

    before: SimState | None
    """the state at the tick in which it was least; None where there was none"""
    id: str | None
    ttc_s: float | None
    """seconds"""
    rows: int
    """rows between the two then"""
    ticks: int
    """ticks in which there was any"""
    driven: int
    """ticks that were driven"""
    crashed: bool
    """whether the drive ended in a crash, whose tick is not counted: there it is 0"""


def least_ttc(timeline: Timeline) -> LeastTtc:
    """The least of the present drive. Raises `QuestionError`: `nothing_yet`, `too_long`."""
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if first >= last:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    crashed = world.outcome is Outcome.CRASH
    states = timeline.between(first, last if crashed else last + 1)
    least: tuple[float, SimState, str, int] | None = None
    ticks = 0
    for before, after in pairwise(states):
        found = sorted(_closing(before, after))
        ticks += bool(found)
        if found and (least is None or found[0][0] < least[0]):
            seconds, id, rows = found[0]
            least = seconds, before, id, rows
    driven = last - first
    if least is None:
        return LeastTtc(None, None, None, 0, ticks, driven, crashed)
    return LeastTtc(least[1], least[2], least[0], least[3], ticks, driven, crashed)


def _closing(before: SimState, after: SimState) -> Iterator[tuple[float, str, int]]:
    """Seconds to contact with each thing ahead in the ego's lane that it closes on, with its id and rows."""
    road = before.world.road
    if after.world.road != road:
        return
    start, end = road.cell(before.world.av), road.cell(after.world.av)
    if max(abs(end[0] - start[0]), abs(end[1] - start[1])) > 1:
        return  # it was put elsewhere
    own = Path(Kind.AV, start, end)
    for thing in before.world.things():
        if thing.kind is Kind.AV or thing.cell[0] != start[0] or thing.cell[1] >= start[1]:
            continue
        then = after.world.find(thing.id)
        to = thing.cell if then is None or abs(then.cell[0] - thing.cell[0]) > 1 else then.cell
        ticks = ticks_to_contact(own, Path(thing.kind, thing.cell, to))
        if ticks is not None and ticks > 0:
            seconds = round(ticks * before.config.step_seconds, 6)
            yield seconds, thing.id, start[1] - thing.cell[1]
