"""Which one thing, replaced alone, would have led a failed drive to the goal: sensor, conditions, planner.

Each is replaced by the best there is of it: the perfect sensor, a clear day, every other planner that comes
with the project. The drive is run again from its start for each (`sim.explain.so_far`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, Literal

from sim.explain.attribution import PLAIN
from sim.explain.planners import others_than
from sim.explain.question_error import QuestionError
from sim.explain.so_far import driven_otherwise
from sim.perceive import sensor_named
from sim.sensor_names import DEFAULT_SENSOR
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Outcome

Factor = Literal["sensor", "weather", "planner"]
FACTORS: Final[tuple[Factor, ...]] = ("sensor", "weather", "planner")
"""What is replaced; `weather`: the weather and the light."""


@dataclass(frozen=True, slots=True)
class Replaced:
    """The drive with one thing replaced."""

    factor: Factor
    value: str
    """the sensor or planner in its place; `day` of the weather"""
    outcome: Outcome | None
    """how it ends; None where that was not found out"""
    ticks: int
    """ticks that were driven again"""


@dataclass(frozen=True, slots=True)
class SingleFactors:
    """A drive that failed, and each thing replaced that was not at its best."""

    outcome: Outcome
    tick: int
    """the tick of the end"""
    found: tuple[Replaced, ...]

    def of(self, factor: Factor) -> tuple[Replaced, ...]:
        """What was put in the place of one of them; empty where it was at its best."""
        return tuple(each for each in self.found if each.factor == factor)

    def helps(self, factor: Factor) -> bool | None:
        """Whether replacing it alone leads to the goal; None where that was not found out."""
        ends = [each.outcome for each in self.of(factor)]
        if Outcome.SUCCESS in ends:
            return True
        return None if None in ends else False


def single_factors(timeline: Timeline) -> SingleFactors:
    """The present drive, which has failed. Raises `QuestionError`: `not_failed` where it has not."""
    world = timeline.state.world
    if world.outcome not in (Outcome.CRASH, Outcome.STUCK) or world.ended is None:
        raise QuestionError("not_failed", tick=timeline.tick)
    if len(world.avs) > 1:
        raise QuestionError("several_drive")
    found = []
    for factor, value, varied in _replaced(timeline.at(world.ended)):
        outcome, ticks = None, 0
        try:
            for tick in driven_otherwise(timeline, varied):
                ticks, outcome = ticks + 1, tick.state.world.outcome
        except QuestionError:
            outcome = None
        found.append(Replaced(factor, value, outcome, ticks))
    return SingleFactors(world.outcome, world.ended, tuple(found))


def _replaced(state: SimState) -> Iterator[tuple[Factor, str, dict[str, str]]]:
    config = state.config
    if not sensor_named(config.sensor).faithful:
        yield "sensor", DEFAULT_SENSOR, {"sensor": DEFAULT_SENSOR}
    if any(getattr(config, name) != plain for name, plain in PLAIN.items()):
        yield "weather", PLAIN["time_of_day"], dict(PLAIN)
    for planner in others_than(state):
        yield "planner", planner, {"planner": planner}
