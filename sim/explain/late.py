"""Which things were near before they were first detected, and which came near and never were.

Near is ahead within a few rows and a lane to either side. What was detected as soon as it was there, and what
was farther off when it was first detected, was not detected late.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.decide import sense
from sim.explain.crash import is_detected
from sim.explain.past import MOST_TICKS
from sim.explain.question_error import QuestionError
from sim.explain.sensing import Reach, reach
from sim.perceive import sensor_named
from sim.session.timeline import Timeline
from sim.types import Kind, Outcome

NEAR_ROWS: Final = 3
"""Rows ahead up to which a thing is near: a few ticks away."""
NEAR_LANES: Final = 1
"""Lanes to either side up to which it is."""


@dataclass(frozen=True, slots=True)
class FirstLook:
    """When a thing that was ahead was first detected, or when it was nearest if it never was."""

    id: str
    kind: Kind
    tick: int
    rows: int
    """rows that it was ahead then, 1 or more"""
    lanes: int
    """lanes that it was to the side"""


@dataclass(frozen=True, slots=True)
class LateThings:
    """The things of the present drive that were detected late, in facts."""

    first: int
    last: int
    """the ticks that were looked at, both included"""
    faithful: bool
    """whether the sensor shows all there is"""
    reach: Reach | None
    """how far it detects now; None where it is faithful, or from another package"""
    late: tuple[FirstLook, ...]
    """those that were near, and had been ahead the tick before, when they were first detected"""
    never: tuple[FirstLook, ...]
    """those that came near and were not detected"""
    in_time: tuple[FirstLook, ...]
    """the others that came near: those that were detected before that, or as soon as they were there"""


@dataclass(slots=True)
class _Watched:
    kind: Kind
    ahead_before: bool = False
    looked: FirstLook | None = None
    late: bool = False
    near: FirstLook | None = None
    """where it was nearest"""


def late_things(timeline: Timeline, kind: Kind | None = None) -> LateThings:
    """What was detected late in the present drive of the first ego, of a kind or all.

    Raises `QuestionError`: `too_long`; `nothing_yet` where nothing was driven.
    """
    world, config = timeline.state.world, timeline.state.config
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    if last == first:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    watched: dict[str, _Watched] = {}
    for state in timeline.between(first, last + 1):
        if state.world.outcome is not Outcome.RUNNING:
            break
        percept, road = sense(state)[0], state.world.road
        column, row = road.cell(state.world.av)
        for thing in state.world.things():
            if thing.kind is Kind.AV or kind not in (None, thing.kind):
                continue
            found = watched.setdefault(thing.id, _Watched(thing.kind))
            rows, lanes = row - thing.cell[1], abs(thing.cell[0] - column)
            look = FirstLook(thing.id, thing.kind, state.world.tick, rows, lanes)
            near = 1 <= rows <= NEAR_ROWS and lanes <= NEAR_LANES
            if near and (found.near is None or (rows, lanes) < (found.near.rows, found.near.lanes)):
                found.near = look
            if found.looked is None and is_detected(percept, state.world, thing.id):
                found.looked, found.late = look, near and found.ahead_before
            found.ahead_before = rows >= 1
    close = [each for each in watched.values() if each.near is not None]
    seen = [each for each in close if each.looked is not None]
    return LateThings(
        first,
        last,
        sensor_named(config.sensor).faithful,
        None if sensor_named(config.sensor).faithful else reach(config),
        _in_order([each.looked for each in seen if each.late]),
        _in_order([each.near for each in close if each.looked is None]),
        _in_order([each.looked for each in seen if not each.late]),
    )


def _in_order(found: list[FirstLook | None]) -> tuple[FirstLook, ...]:
    """The nearest first, of equals the earliest."""
    looks = [each for each in found if each is not None]
    return tuple(sorted(looks, key=lambda each: (each.rows, each.lanes, each.tick, each.id)))
