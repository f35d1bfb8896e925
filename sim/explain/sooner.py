"""A stop or a lane change of this drive, and the tick at which it could have been sooner, or longer."""

from __future__ import annotations

from collections.abc import Collection

from sim.explain.coming_turn import LANE_CHANGES, STOPS
from sim.explain.query import LOOK_BACK_TICKS
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.types import Move


def sooner_stop(timeline: Timeline) -> tuple[Move, int]:
    """To stay, a tick before the latest stop of this drive began. Raises `QuestionError`."""
    return _before_the_latest(timeline, STOPS, "no_stop")


def sooner_change(timeline: Timeline) -> tuple[Move, int]:
    """The move of the latest lane change of this drive, a tick before it. Raises `QuestionError`."""
    return _before_the_latest(timeline, LANE_CHANGES, "no_change")


def longer_wait(timeline: Timeline) -> tuple[Move, int | None]:
    """To stay once more after the latest stop of this drive; None for the tick where that is now.

    Raises `QuestionError`: `no_stop`.
    """
    made = _of_this_drive(timeline)
    at = _latest(made, STOPS, "no_stop")
    return Move.STAY, made[at + 1][0] if at + 1 < len(made) else None


def unstopped(timeline: Timeline) -> tuple[Move, int]:
    """Forward in place of the latest stop of this drive, where that began.

    Raises `QuestionError`: `no_stop`.
    """
    made = _of_this_drive(timeline)
    at = _latest(made, STOPS, "no_stop")
    while at and made[at - 1][1] in STOPS:
        at -= 1
    return Move.FORWARD, made[at][0]


def _before_the_latest(timeline: Timeline, moves: Collection[Move], code: str) -> tuple[Move, int]:
    """The latest of these moves, and the tick before the first of those that are made like it in a row."""
    made = _of_this_drive(timeline)
    at = _latest(made, moves, code)
    move = made[at][1]
    while at and made[at - 1][1] is move:
        at -= 1
    if not at:
        raise QuestionError("no_sooner", tick=made[0][0])
    return move, made[at - 1][0]


def _latest(made: list[tuple[int, Move]], moves: Collection[Move], code: str) -> int:
    found = [at for at, (_, move) in enumerate(made) if move in moves]
    if not found:
        raise QuestionError(code, ticks=len(made))
    return found[-1]


def _of_this_drive(timeline: Timeline) -> list[tuple[int, Move]]:
    """The decisions of this drive with their ticks, of the latest that are looked at."""
    world = timeline.state.world
    oldest = max(world.episode_start, timeline.tick - LOOK_BACK_TICKS)
    decisions = [timeline.decided(state, None) for state in timeline.between(oldest, timeline.tick)]
    return [(each.tick, each.move) for each in decisions if each is not None]
