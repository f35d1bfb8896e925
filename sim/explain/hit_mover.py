"""What the road user that the ego crashed with did in the tick of the crash, and whether it had to.

It is judged by cells: had it stayed where it was, it would not have been met unless the ego came there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.explain.crash import Crash, why_crashed
from sim.explain.question_error import QuestionError
from sim.rules.mover_boards import PERIODS
from sim.session.timeline import Timeline
from sim.types import Kind, Move

KMH: Final = 3.6


@dataclass(frozen=True, slots=True)
class HitMover:
    """What was hit, and how it moved."""

    id: str
    kind: Kind
    moves: bool
    """whether its kind moves at all"""
    move: Move
    """its step in the tick of the crash"""
    across: int
    """columns from the ego to it before that; negative to the left"""
    speed_kmh: float
    """of a step in the rhythm of its kind; 0 where it took none"""
    clear_if_stayed: bool | None
    """whether the two would not have met had it stayed where it was; None where it did"""


@dataclass(frozen=True, slots=True)
class HitMovers:
    """The crash, and each of what was hit."""

    crash: Crash
    found: tuple[HitMover, ...]


def hit_movers(timeline: Timeline, tick: int | None = None) -> HitMovers:
    """What the latest crash was with, or that of a tick. Raises `QuestionError` as `why_crashed` does."""
    crash = why_crashed(timeline, tick)
    before, decision = crash.explanation.moment, crash.explanation.decision
    after = timeline.led_to(before).state.world
    number = before.number(decision.av)
    own, own_then = before.world.road.cell(before.world.avs[number]), after.road.cell(after.avs[number])
    found = []
    for id in crash.cause.ids:
        was, then = before.world.find(id), after.find(id)
        if id == decision.av or was is None:
            continue
        end = was.cell if then is None else then.cell
        across = end[0] - was.cell[0]
        stays = end == was.cell
        config, period = before.config, PERIODS.get(was.kind, 1)
        speed = 0.0 if stays else config.cell_m / (period * config.step_seconds) * KMH
        found.append(
            HitMover(
                id=id,
                kind=was.kind,
                moves=was.heading is not None,
                move=Move.STAY if not across else Move.RIGHT if across > 0 else Move.LEFT,
                across=was.cell[0] - own[0],
                speed_kmh=round(speed, 1),
                clear_if_stayed=None if stays else own_then != was.cell,
            )
        )
    if not found:
        raise QuestionError("no_crash_then", tick=crash.end)
    return HitMovers(crash, tuple(found))
