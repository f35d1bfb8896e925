"""How fast the clock plays a session: from a quarter of real time to as fast as possible.

Like pause it is about the clock and no world: no digest knows it, and it is no step to undo. It is
said by an action like any other, so it stands in the log, and comes back with it after a restart, in
a fork and in a recording. Leaves out `step_seconds`, which is how long a tick is in the world.
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
"""Simulated seconds in a second, or as many as there is time for."""

SLOWEST: Final = 0.25
FASTEST: Final = 64.0
NORMAL: Final = 1.0
MAX: Final = "max"

SHORTEST_TURN_S: Final = 0.004
"""Ticks that follow each other sooner than this are taken several in a turn of the clock."""
MAX_TURN_TICKS: Final = 8
"""As fast as possible is this many ticks a turn at most, half of what a watcher's slot holds."""
MAX_TURN_S: Final = 0.001
"""How long a turn of as fast as possible may hold the clock; the tick that was begun is finished."""
MAX_PERIOD_S: Final = 0.002
"""From one such turn to the next: half of the time at least is the others'."""


class PlaybackSpeedError(Exception):
    """A speed that cannot be: a code with a sentence in `refusals.yaml`; `field` is that of the action."""

    def __init__(self, code: str, field: str, **facts: object) -> None:
        super().__init__(code)
        self.code = code
        self.field = field
        self.facts = facts


@dataclass(frozen=True, slots=True)
class PlaybackSpeedSet:
    """The clock was set to another speed, or to the one it had, at a tick."""

    before: PlaybackSpeed
    after: PlaybackSpeed
    tick: int


def change_playback_speed(speed: PlaybackSpeed, action: Set | Adjust) -> PlaybackSpeed:
    """The speed once an action is done. Raises `PlaybackSpeedError`."""
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
    """Once for each tick of one turn; as fast as possible ends when the turn has become long."""
    return _max_speed_turn() if speed == MAX else range(_ticks_a_turn(speed, step_seconds))


def _max_speed_turn() -> Iterator[None]:
    began = time.monotonic()
    for _ in range(MAX_TURN_TICKS):
        yield
        if time.monotonic() - began > MAX_TURN_S:
            return


def is_accelerated(speed: PlaybackSpeed) -> bool:
    """Whether ticks come sooner than in real time."""
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
