"""The decisions of `priority` and `rules` in compiled words, from what the vehicle's row and the next hold.

Guarantee: the moves of `sim.plan.priority` and of `sim.plan.rule_based`. Arguments: as in
`sim.batch.row_motion`; besides them

- `free`: the moves that meet nothing, bit by bit (`free_moves`);
- `ways` (3, rows, columns; int16): by cell what leads to the goal past all that never moves, see `ASIDE`.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from sim.batch.row_motion import LEFT, RIGHT, STAY, beside_row
from sim.compilation import compiled

_ZERO: Final = np.uint64(0)
_ONE: Final = np.uint64(1)

PRIORITY, RULES, BY_COST = range(3)
"""Planners; those that go by cost are one, with charges of their own (`sim.batch.row_costs`)."""
ASIDE, OPEN, STILL = range(3)
"""Planes of `ways`: the columns to go aside to a way on (−1: none), whether the cell leads to the goal, and
whether it is taken for good. As `sim.search.passages.Ways`."""

# The ranks of `sim.plan.rule_based`.
_CLASS: Final = 1 << 8
_FIRST, _FORWARD, _DIAGONAL, _ASIDE, _STAY, _DODGE, _CLOSED, _LAST = range(-_CLASS, 7 * _CLASS, _CLASS)
_NONE, _ON, _SHUT, _BACK, _NOWHERE = range(5)
"""Where a move leads: off the road, to a way on, to one that a mover closes, away from it, to a dead end."""


@compiled
def first_free(free):
    """The first move that meets nothing; to stay where none does."""
    for move in range(6):
        if free >> move & 1:
            return move
    return STAY


@compiled
def locked_columns(movers, fixed, last_bit):
    """The movers of a row that can never leave their cell."""
    locked = movers
    while True:
        still = fixed | locked
        kept = locked & (still << _ONE | _ONE) & (still >> _ONE | last_bit)
        if kept == locked:
            return locked
        locked = kept


@compiled
def find_ways(ways, movers, fixed, count, columns, last_bit):
    """Fill `ways` for rows 0 to before `count`; `movers` (rows; uint64): the cells of all movers.

    Written for rows from the goal on: no row hangs on one behind it.
    """
    whole = (last_bit - _ONE) | last_bit
    reached = _ZERO
    for row in range(count):
        still = fixed[row] | locked_columns(movers[row], fixed[row], last_bit)
        free = whole & ~still
        if row == 0:
            open_now, straight, nearby = free, free, _ZERO
        else:
            before, reachable = reached, free & beside_row(reached, last_bit)
            grown = _ZERO
            while grown != reachable:
                grown = reachable
                reachable = free & beside_row(grown, last_bit)
            open_now, straight = reachable, reachable & before
            nearby = (beside_row(before, last_bit) | beside_row(straight, last_bit)) & open_now & ~straight
        for column in range(columns):
            at = np.uint64(column)
            ways[OPEN, row, column] = open_now >> at & _ONE
            ways[STILL, row, column] = still >> at & _ONE
            ways[ASIDE, row, column] = 0 if straight >> at & _ONE else -1
        left, away = open_now & ~straight, 1
        while nearby != _ZERO:
            for column in range(columns):
                if nearby >> np.uint64(column) & _ONE:
                    ways[ASIDE, row, column] = away
            left &= ~nearby
            nearby = beside_row(nearby, last_bit) & left
            away += 1
        reached = open_now


@compiled
def _toward(ways, row, column, columns, side, right, left):
    """From a cell to the nearest way on to one side: where that leads, and how many columns away."""
    room = columns - 1 - column if side > 0 else column
    away, last = 0, room
    for far in range(1, room + 1):
        if ways[OPEN, row - 1, column + side * far]:
            away = far
            break
    for far in range(1, room + 1):
        if ways[STILL, row, column + side * far]:
            last = far - 1
            break
    if away == 0 or last < away - 1:
        return _BACK, -1
    coming, leaving = (left, right) if side > 0 else (right, left)
    for far in range(1, last + 1):
        there = np.uint64(column + side * far)
        comes = coming >> there & _ONE and far < 2 * away
        if comes or (leaving >> there & _ONE and 2 * last - far < 2 * away):
            return _SHUT, away
    return _ON, away


@compiled
def _prospect(ways, row, column, columns, side, right, left):
    """What a cell has to offer, looked at to one side, or to both where `side` is 0."""
    if column < 0 or column >= columns:
        return _NONE, -1
    if ways[ASIDE, row, column] == 0:
        return _ON, 0
    if not ways[OPEN, row, column]:
        return _NOWHERE, -1
    if side:
        return _toward(ways, row, column, columns, side, right, left)
    leads, away = _toward(ways, row, column, columns, -1, right, left)
    other, far = _toward(ways, row, column, columns, 1, right, left)
    if other != _BACK and (leads == _BACK or (other, far) < (leads, away)):
        return other, far
    return leads, away


@compiled
def _rank_diagonal(leads, away):
    if leads == _NONE or away < 0:
        return _LAST + 1
    return (_DIAGONAL if leads == _ON else _CLOSED) + away


@compiled
def _rank_aside(leads, away, below):
    if leads in (_NONE, _NOWHERE):
        return _LAST + 1
    if leads == _ON:
        return (_DODGE if below else _ASIDE) + away
    return _CLOSED + 1


@compiled
def by_rank(free, ways, row, column, columns, motion, ahead):
    """The first of the ranking that is free and leads on; else to stay, if free; else whatever is.

    `motion`: of the vehicle's row; `ahead`: the next row's words after the tick.
    """
    right, left = motion.right, motion.left
    next_right, next_left = ahead[RIGHT], ahead[LEFT]
    below = ways[ASIDE, row, column] == 0
    ranks = np.empty(6, np.int64)
    leads, away = _prospect(ways, row - 1, column, columns, 0, next_right, next_left)
    ranks[0] = _FORWARD
    if leads == _NOWHERE:
        ranks[0] = _FIRST
    elif leads == _SHUT:
        ranks[0] = _CLOSED
    leads, away = _prospect(ways, row, column - 1, columns, -1, right, left)
    ranks[1] = _rank_aside(leads, away, below)
    leads, away = _prospect(ways, row, column + 1, columns, 1, right, left)
    ranks[2] = _rank_aside(leads, away, below)
    leads, away = _prospect(ways, row - 1, column - 1, columns, 0, next_right, next_left)
    ranks[3] = _rank_diagonal(leads, away)
    leads, away = _prospect(ways, row - 1, column + 1, columns, 0, next_right, next_left)
    ranks[4] = _rank_diagonal(leads, away)
    ranks[5] = _LAST if ways[ASIDE, row, column] < 0 else _STAY
    best, first = -1, -1
    for move in range(6):
        if not free >> move & 1:
            continue
        if _FIRST < ranks[move] < _LAST and (best < 0 or ranks[move] < ranks[best]):
            best = move
        if first < 0 or ranks[move] < ranks[first]:
            first = move
    if best >= 0:
        return best
    return first if first >= 0 and not free >> STAY & 1 else STAY


@compiled
def made_move(planner, free, ways, row, column, columns, motion, ahead):
    """The move that a planner makes; of `priority` only what is free has a part in it."""
    if planner == PRIORITY:
        return first_free(free)
    return by_rank(free, ways, row, column, columns, motion, ahead)
