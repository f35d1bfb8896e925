"""Movers by kind: which of them rest in a tick, and their boards moved along with them.

What each kind is stands in `sim.types.KINDS`, and the rules of motion in `sim.rules.traffic`.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm
from typing import Final

from sim.fast_replace import field_setter
from sim.rules.traffic import Motion, shift_board, steps_in_tick
from sim.types import KINDS, MARKED, MOVERS, Kind
from sim.world.boards import Boards
from sim.world.grid import Board, union

PERIODS: Final = {kind: KINDS[kind].period or 1 for kind in MOVERS}
"""Ticks that a mover of each kind needs for one cell. An obstacle vehicle moves every tick."""
_SLOW: Final = tuple((place, PERIODS[kind]) for place, kind in enumerate(MARKED) if PERIODS[kind] > 1)
_BEAT: Final = PERIODS[Kind.PEDESTRIAN]

_COMMON: Final = lcm(_BEAT, *(period for _, period in _SLOW))

_shifted = field_setter(Boards, "marked", "others")


def resting_marked(marked: Sequence[Board], episode_tick: int) -> Board:
    """Of the movers of each kind in `MARKED`, those that are between two steps in this tick."""
    resting = 0
    for place, period in _SLOW:
        board = marked[place]
        if board and not steps_in_tick(period, episode_tick):
            resting |= board
    return resting


def shift_boards(boards: Boards, motion: Motion) -> Boards:
    """The boards one tick later: those of movers moved along with them."""
    if not boards.others:
        return boards
    return with_marked(boards, shift_marked(boards.marked, motion))


def with_marked(boards: Boards, marked: tuple[Board, ...]) -> Boards:
    """The boards with those of the movers of each kind in `MARKED` replaced."""
    return _shifted(boards, marked, union(marked))


def shift_marked(marked: Sequence[Board], motion: Motion) -> tuple[Board, ...]:
    """The movers of each kind in `MARKED`, one tick later."""
    return tuple([shift_board(board, motion) if board else 0 for board in marked])


def common_period(boards: Boards) -> int:
    """Ticks after which every mover's steps fall on the same ticks again; the pedestrians' at least."""
    if _COMMON == _BEAT or not boards.others:
        return _BEAT
    marked = boards.marked
    return lcm(_BEAT, *(period for place, period in _SLOW if marked[place]))
