"""What happened, in data: for the log, the stream, the metrics and the store alike. No words."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from sim.types import Cell, Move


class EventType(StrEnum):
    """What kind of thing happened."""

    EPISODE_STARTED = "episode_started"
    ROAD_KEPT = "road_kept"
    """no next road that can be driven was found, so the present one begins again"""
    ARRIVED = "arrived"
    CRASHED = "crashed"
    STUCK = "stuck"
    HELD_BACK = "held_back"
    """a person's move was not taken because its cell would not be free"""
    PLANNER_FAILED = "planner_failed"
    """the planner did something else than answer, and the vehicle stays"""
    NO_WAY = "no_way"
    """it is proved that no way leads to the goal in time; `ids` are things without which there is one"""
    WAY_OPEN = "way_open"
    """a change has opened a road without a way"""
    DISABLED = "disabled"
    """a pothole was put under a mover, which stays in it"""


@dataclass(frozen=True, slots=True)
class Event:
    """Something worth a line in the log, at the tick of the world in which it is so."""

    tick: int
    type: EventType
    episode: int
    ids: tuple[str, ...] = ()
    cell: Cell | None = None
    move: Move | None = None
    how: str | None = None
    """for a crash `hit`, `swap` or `cross`, for a move held back what it would have met (`Verdict`),
    for a planner that failed what it did, for STUCK `limit` or `repetition`, for NO_WAY `late` where too few
    ticks are left"""
    ego: str = "av-1"
    """the ego that it happened to; the first where it concerns all of them"""
