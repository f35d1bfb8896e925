"""Where a thing was beside the ego in the last ticks before a crash, or before now; read off the timeline."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.explain.past import latest_crash
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, is_ego

TICKS: Final = 3
"""Ticks back where no number is said."""


@dataclass(frozen=True, slots=True)
class PlacesBefore:
    """A thing at each of some ticks."""

    id: str
    kind: Kind
    tick: int
    """the tick from which is counted back: that of the crash, or now"""
    crashed: bool
    places: tuple[tuple[SimState, int, int], ...]
    """a state, lanes to the right of the ego and rows ahead of it, the earliest first"""


def hit_thing(timeline: Timeline) -> tuple[str, int] | None:
    """The id of what was hit in the latest crash, and the tick that shows it; None for another ego."""
    tick = latest_crash(timeline)
    cause = None if tick is None else timeline.at(tick).world.cause
    if tick is None or cause is None:
        return None
    name = next((each for each in cause.ids if not is_ego(each)), None)
    return None if name is None else (name, tick)


def places_before(timeline: Timeline, ticks: int, id: str | None = None) -> PlacesBefore:
    """Where a thing was in so many ticks before now, or what was hit before the latest crash.

    A thing that was hit in the crash that ended the present drive is told before that crash. Raises
    `QuestionError`: `no_crash_at_all` where no thing is named and nothing was hit, `not_there_before` for a
    thing that was not on the road in these ticks.
    """
    hit, world = hit_thing(timeline), timeline.state.world
    if id is None and hit is None:
        raise QuestionError("no_crash_at_all")
    of_crash = hit is not None and id in (None, hit[0]) and (id is None or world.ended == hit[1])
    name, tick = hit if of_crash and hit is not None else (str(id), timeline.tick)
    start = timeline.at(tick).world.episode_start
    found, kind = [], None
    for state in timeline.between(max(start, tick - ticks), tick if of_crash else tick + 1):
        thing = state.world.find(name)
        if thing is None:
            continue
        column, row = state.world.road.cell(state.world.av)
        kind = thing.kind
        found.append((state, thing.cell[0] - column, row - thing.cell[1]))
    if kind is None:
        raise QuestionError("not_there_before", id=name)
    return PlacesBefore(name, kind, tick, of_crash, tuple(found))
