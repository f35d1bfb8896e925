"""How exactly things are placed: reports in a drive, and what is believed now, beside the truth."""

from __future__ import annotations

from dataclasses import dataclass

from sim.decide import sense
from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.perceive import sensor_named
from sim.perceive.parameters import SUITES, SensorSpec
from sim.session.timeline import Timeline
from sim.types import Cell, Kind


@dataclass(frozen=True, slots=True)
class Placing:
    """Cells in which things were reported and are believed, beside those that they were and are in."""

    faithful: bool
    devices: tuple[SensorSpec, ...]
    """of the sensor; none of one that is faithful or not of the tables"""
    reports: int
    """reports of things that exist, in this drive"""
    exact: int
    """of those: in the very cell"""
    farthest: int
    """cells that a report was off at most, across or along"""
    believed: int
    """things that are seen now and exist"""
    misplaced: tuple[tuple[str, int], ...]
    """of those: the ids of what is seen in another cell than its own, with the cells that it is off"""
    never: int
    """things that are seen now and never existed"""


def placing(timeline: Timeline) -> Placing:
    """How exactly the first ego's sensor places things. Raises `QuestionError`: `too_long`."""
    state = timeline.state
    world, config = state.world, state.config
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    suite = SUITES.get(config.sensor, ())
    there = {each.id: each.cell for each in world.things()}
    seen = [each for each in sense(state)[0].things() if each.kind is not Kind.AV]
    known = [(each.id, _off(each.cell, there[each.id])) for each in seen if each.id in there]
    reports = exact = farthest = 0
    if suite:
        # Needs numpy, which sessions with the perfect sensor do without.
        from sim.perceive.grid_sensor import looks

        for each in timeline.between(first, last + 1):
            road, cells = each.world.road, {thing.id: thing.cell for thing in each.world.things()}
            for found in looks(each.world, each.config, 0, suite):
                for report in found.reports:
                    if report.id is None or report.id not in cells:
                        continue
                    off = _off(road.cell(report.cell), cells[report.id])
                    reports, exact, farthest = reports + 1, exact + (off == 0), max(farthest, off)
    return Placing(
        sensor_named(config.sensor).faithful,
        suite,
        reports,
        exact,
        farthest,
        len(known),
        tuple((id, off) for id, off in known if off),
        len(seen) - len(known),
    )


def _off(one: Cell, other: Cell) -> int:
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]))
