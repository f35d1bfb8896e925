"""In how many ticks of a drive what was seen was what was there: false alarms, and what was missed."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from sim.explain.misperception import misperception
from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.explain.sensing import reach
from sim.perceive import sensor_named
from sim.session.timeline import Timeline
from sim.types import Kind


@dataclass(frozen=True, slots=True)
class SensingErrors:
    """The ticks of the present drive, counted by what the first ego's sensor got wrong in them."""

    faithful: bool
    """whether the sensor shows what is there, so that nothing can be wrong"""
    ticks: int
    right: int
    """ticks in which all that is in the ego's row or ahead within reach was seen as it was, and no more"""
    imagined: int
    """ticks in which something was seen where it was not"""
    missed: int
    """ticks in which something in reach was not seen where it was"""
    things: int
    """things in reach, counted anew in every tick"""
    seen: int
    """of those, the ones that were seen where they were"""
    alarms: int
    """different things that were seen and never existed"""
    kinds: tuple[tuple[Kind, int], ...]
    """kinds of those, with how many of each"""


def sensing_errors(timeline: Timeline) -> SensingErrors:
    """What the sensor got wrong in the present drive. Raises `QuestionError`: `too_long`."""
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    if sensor_named(timeline.state.config.sensor).faithful:
        ticks = last + 1 - first
        return SensingErrors(True, ticks, ticks, 0, 0, 0, 0, 0, ())
    ticks = right = imagined = missed = things = seen = 0
    alarms: dict[str, Kind] = {}
    for state in timeline.between(first, last + 1):
        wrong, found = misperception(state), reach(state.config)
        there = {thing.id for thing in state.world.things()}
        row = state.world.road.cell(state.world.av)[1]
        cells = row if found is None else found.cells
        in_reach = [thing for thing in wrong.missed if 0 <= row - thing.cell[1] <= cells]
        near = sum(
            thing.kind is not Kind.AV and 0 <= row - thing.cell[1] <= cells for thing in state.world.things()
        )
        things, seen = things + near, seen + near - len(in_reach)
        alarms |= {thing.id: thing.kind for thing in wrong.phantoms if thing.id not in there}
        ticks += 1
        imagined += bool(wrong.phantoms)
        missed += bool(in_reach)
        right += not wrong.phantoms and not in_reach
    kinds = Counter(alarms.values())
    return SensingErrors(
        False, ticks, right, imagined, missed, things, seen, len(alarms), tuple(kinds.most_common())
    )
