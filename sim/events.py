"""Events of a tick, as data without sentences: for log, stream, metrics and store."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from sim.types import Cell, Move


class EventType(StrEnum):
    """The type of an event."""

    EPISODE_STARTED = "episode_started"
    ROAD_KEPT = "road_kept"
    """no drivable next road was found, so the present one begins again"""
    ARRIVED = "arrived"
    CRASHED = "crashed"
    STUCK = "stuck"
    HELD_BACK = "held_back"
    """a person's move was not made because its cell would not be free"""
    SLIPPED = "slipped"
    """the step to the side of a move was lost on snow; `move` is what was tried"""
    PLANNER_FAILED = "planner_failed"
    """the planner gave no valid answer, and the ego stays"""
    NO_WAY = "no_way"
    """proof that no way leads to the goal in time; without the things in `ids` there is one"""
    WAY_OPEN = "way_open"
    """an edit has opened a way on a road that had none"""
    DISABLED = "disabled"
    """a pothole was placed under a mover, which cannot leave it"""
    TRIGGERED = "triggered"
    """a rule was done"""
    TRIGGER_FAILED = "trigger_failed"
    """a rule could not be done, and nothing of it was"""
    TRIGGER_ENDED = "trigger_ended"
    """a rule ended by itself"""


@dataclass(frozen=True, slots=True)
class Event:
    """An event; `tick` is that of the first world in which it is visible."""

    tick: int
    type: EventType
    episode: int
    ids: tuple[str, ...] = ()
    cell: Cell | None = None
    move: Move | None = None
    how: str | None = None
    """CRASHED: `hit`, `swap` or `cross`; HELD_BACK: what blocks the move (`StepVerdict`); PLANNER_FAILED: the
    fault; STUCK: `limit` or `repetition`; NO_WAY: `late` if too few ticks are left; TRIGGER_ENDED: `done`,
    `limit` (fired too often) or `failed` (could not be done too often)"""
    ego: str = "av-1"
    """the ego it happened to; the first ego if it concerns all of them"""
    rule: int | None = None
    """the number of the rule, for those of rules"""
    done: tuple[Any, ...] = ()
    """TRIGGERED: what the rule did, as `sim.session.applied.Applied` and `Pause`"""
    error: Exception | None = None
    """TRIGGER_FAILED: the `EditError`"""
