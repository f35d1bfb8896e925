"""Playback speed: how fast the clock plays a session, from a quarter of real time to as fast as possible.

It belongs to the clock, not to the world: it is not part of the digest. It can be undone, and is set by an
action, so it is in the log and is restored after a restart, in a fork and from a recording. `step_seconds` is
another thing: the length of a tick in the world.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, Literal, TypeAlias

from sim.actions import Adjust, Set

PlaybackSpeed: TypeAlias = float | Literal["max"]
"""Simulated seconds per second, or as many as there is time for."""

SLOWEST: Final = 0.25
FASTEST: Final = 64.0
NORMAL: Final = 1.0
MAX: Final = "max"

SHORTEST_TURN_S: Final = 0.004
"""Shortest turn of the clock: at higher speeds a turn has several ticks."""
MAX_TURN_TICKS: Final = 8
"""Largest number of ticks of a turn at `max` speed, half of a subscriber's queue."""
MAX_TURN_S: Final = 0.001
"""Time limit of a turn at `max` speed; a tick that began is finished."""
MAX_PERIOD_S: Final = 0.002
"""Time between turns at `max` speed, at least half of which is for other sessions."""


class PlaybackSpeedError(Exception):
    """An impossible speed: a code with a sentence in `refusals.yaml`; `field` is that of the action."""

    def __init__(self, code: str, field: str, **facts: object) -> None:
        super().__init__(code)
        self.code = code
        self.field = field
        self.facts = facts


@dataclass(frozen=True, slots=True)
class PlaybackSpeedSet:
    """Fact: the playback speed was set (perhaps to what it was), at a tick."""

    before: PlaybackSpeed
    after: PlaybackSpeed
    tick: int


def change_playback_speed(speed: PlaybackSpeed, action: Set | Adjust) -> PlaybackSpeed:
    """The speed after an action. Raises `PlaybackSpeedError`."""
    if isinstance(action, Set):
        if action.value == MAX:
            return MAX
        if isinstance(action.value, str):
            raise PlaybackSpeedError("not_a_speed", "value", low=SLOWEST, high=FASTEST, value=action.value)
        return _within(float(action.value), "value")
    if action.direction == "up":
        return _doubled(speed)
    if action.direction == "down":
        return FASTEST if speed == MAX else _halved(float(speed))
    now = FASTEST if speed == MAX else float(speed)
    if action.factor is not None:
        wanted, field = now * action.factor, "factor"
    else:
        wanted, field = now + (action.by or 0.0), "by"
    if speed == MAX and wanted > now:
        raise PlaybackSpeedError("fastest", field)
    return _within(round(wanted, 9), field)


@lru_cache(maxsize=256)  # asked at every tick
def period_s(speed: PlaybackSpeed, step_seconds: float) -> float:
    """Seconds from one turn of the clock to the next."""
    return MAX_PERIOD_S if speed == MAX else step_seconds / float(speed) * _ticks_a_turn(speed, step_seconds)


def ticks_of_turn(speed: PlaybackSpeed, step_seconds: float) -> Iterable[object]:
    """An iterable with one item for each tick of a turn; at `max` speed it ends after a time limit."""
    return _max_speed_turn() if speed == MAX else range(_ticks_a_turn(speed, step_seconds))


def _max_speed_turn() -> Iterator[None]:
    began = time.monotonic()
    for _ in range(MAX_TURN_TICKS):
        yield
        if time.monotonic() - began > MAX_TURN_S:
            return


def is_accelerated(speed: PlaybackSpeed) -> bool:
    """Whether ticks come faster than in real time."""
    return speed == MAX or float(speed) > NORMAL


@lru_cache(maxsize=256)
def _ticks_a_turn(speed: PlaybackSpeed, step_seconds: float) -> int:
    return max(1, math.ceil(SHORTEST_TURN_S * float(speed) / step_seconds - 1e-9))


def _doubled(speed: PlaybackSpeed) -> PlaybackSpeed:
    if speed == MAX:
        raise PlaybackSpeedError("fastest", "direction")
    if speed == FASTEST:
        return MAX
    return min(FASTEST, float(speed) * 2)


def _halved(speed: float) -> PlaybackSpeed:
    if speed == SLOWEST:
        raise PlaybackSpeedError("slowest", "direction", low=SLOWEST)
    return max(SLOWEST, speed / 2)


def _within(value: float, field: str) -> float:
    if not SLOWEST <= value <= FASTEST:  # false for what is no number, too
        raise PlaybackSpeedError("out_of_range", field, low=SLOWEST, high=FASTEST, value=value)
    return value
