"""Which steps of an autonomous vehicle meet nothing, for whole sets of cells at once: the grid's fast path.

What a single step sweeps is defined in `sim.rules.grid_dynamics`; the tests compare the two on every road.
Written in `& | ^ >> <<` alone, so that the same lines serve Python's integers (one world, any size) and
machine words cut at row boundaries (many worlds, compiled by `sim.batch.compiled`).

Arguments are boards (`sim.world.grid`), all of one road or all of one word of it:

- `start`: the cells that vehicles stand in; `ahead`: the same one row on (a caller with boards cut into words
  carries it over from the next word);
- `blocked`: the cells taken after the tick, by fixed hazards and by movers;
- `came_right`, `came_left`: the cells that movers entered in this tick by a step to the right, to the left;
- `cut_left`, `cut_right`: the cells straight ahead of vehicles whose diagonal to that side a mover cuts off
  (`cut_off`); empty under the rule `collision: cell`;
- `left_edge`, `right_edge`: the cells of the first and of the last column.
"""

from __future__ import annotations

from typing import NamedTuple

from sim.world.grid import Board


class Steps(NamedTuple):
    """Cells that a vehicle (or each of a set of them) may be in after a tick, by move."""

    forward: Board
    left: Board
    right: Board
    forward_left: Board
    forward_right: Board
    stay: Board


def cut_off(
    came_right: Board, came_left: Board, right_behind: Board, left_behind: Board
) -> tuple[Board, Board]:
    """The cells straight ahead of vehicles whose diagonal to the left, and to the right, is cut off.

    A mover cuts off the diagonal to the left if by a step to the right it enters the cell straight ahead of
    the ego, or the ego's own; to the right it is the mirror image. `…_behind` are the cells entered,
    moved one row on: the ego's own cell is then where the one straight ahead of it is.
    """
    return came_right | right_behind, came_left | left_behind


def free_steps(
    start: Board,
    ahead: Board,
    blocked: Board,
    came_right: Board,
    came_left: Board,
    cut_left: Board,
    cut_right: Board,
    left_edge: Board,
    right_edge: Board,
) -> Steps:
    """Where vehicles standing in `start` may be next, by move, meeting nothing."""
    left = (start ^ start & (left_edge | came_right)) >> 1
    right = (start ^ start & (right_edge | came_left)) << 1
    ahead_left = (ahead ^ ahead & (left_edge | cut_left)) >> 1
    ahead_right = (ahead ^ ahead & (right_edge | cut_right)) << 1
    return Steps(
        ahead ^ ahead & blocked,
        left ^ left & blocked,
        right ^ right & blocked,
        ahead_left ^ ahead_left & blocked,
        ahead_right ^ ahead_right & blocked,
        start ^ start & blocked,
    )


def spread(
    start: Board,
    ahead: Board,
    blocked: Board,
    came_right: Board,
    came_left: Board,
    cut_left: Board,
    cut_right: Board,
    left_edge: Board,
    right_edge: Board,
) -> Board:
    """All of `free_steps` together: every cell that may be reached from `start` by one move."""
    reached = (
        start
        | ahead
        | (start ^ start & (left_edge | came_right)) >> 1
        | (start ^ start & (right_edge | came_left)) << 1
        | (ahead ^ ahead & (left_edge | cut_left)) >> 1
        | (ahead ^ ahead & (right_edge | cut_right)) << 1
    )
    return reached ^ reached & blocked


def spread_back(
    end: Board,
    came_right: Board,
    came_left: Board,
    cut_left: Board,
    cut_right: Board,
    left_edge: Board,
    right_edge: Board,
) -> tuple[Board, Board]:
    """The reverse of `spread`: every cell from which one move leads into `end`, whose cells are free.

    In two parts: the cells in the rows of `end`, and the cells straight ahead of the others (a caller shifts
    them one row back).
    """
    ending_left = end ^ end & right_edge
    ending_right = end ^ end & left_edge
    by_left, by_right = ending_left << 1, ending_right >> 1
    return (
        end | by_left ^ by_left & came_right | by_right ^ by_right & came_left,
        end | by_left ^ by_left & cut_left | by_right ^ by_right & cut_right,
    )


class ClosedStarts(NamedTuple):
    """The cells from which a move is closed, wherever it leads: by the edge, or by a mover on the way."""

    left: Board
    right: Board
    forward_left: Board
    forward_right: Board


def closed_starts(
    came_right: Board,
    came_left: Board,
    cut_left_behind: Board,
    cut_right_behind: Board,
    left_edge: Board,
    right_edge: Board,
) -> ClosedStarts:
    """What `free_steps` leaves out by the cell a move starts from; `cut_…_behind` are moved one row back."""
    return ClosedStarts(
        left_edge | came_right,
        right_edge | came_left,
        left_edge | cut_left_behind,
        right_edge | cut_right_behind,
    )


def beside(board: Board, left_edge: Board, right_edge: Board) -> Board:
    """A set of cells with their neighbours to the left and right."""
    return board | (board ^ board & left_edge) >> 1 | (board ^ board & right_edge) << 1
