"""The rules of motion: the only copy.

Written in `& | ^ ~ << >>` alone, so that the same lines serve Python's integers (one world, any
size) and machine words cut at row boundaries (many worlds, compiled). All movers decide at once:
no order of ids matters, and a mirrored road behaves as the mirror image.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from sim.world.grid import Board


class Motion(NamedTuple):
    """Where all movers are after a tick, by heading, and which of those cells were entered."""

    right: Board
    left: Board
    came_right: Board
    """cells entered by a step to the right (from column − 1)"""
    came_left: Board
    """cells entered by a step to the left (from column + 1)"""

    @property
    def occupied(self) -> Board:
        """Every cell a mover stands in."""
        return self.right | self.left


def steps_in_tick(period: int, episode_tick: int) -> bool:
    """Whether movers that need `period` ticks for a cell step in the tick that begins at `episode_tick`."""
    return episode_tick % period == period - 1


def move_movers(
    right: Board,
    left: Board,
    resting: Board,
    fixed: Board,
    yielding: Board,
    vehicles: Board,
    left_edge: Board,
    right_edge: Board,
) -> Motion:
    """One tick of all movers at once.

    A mover wants the next cell in its heading. It is blocked by the edge, by `fixed`, by any
    mover standing there now, or by another mover that wants the same cell (then both are). The
    blocked turn round and want the other side under the same test, cells already won counting
    as taken; blocked again, they stay and face the new way. `resting` movers (disabled, or
    between two steps) keep cell and heading. A mover in `yielding` counts the cells of
    `vehicles` (the autonomous ones) as blocked as well.
    """
    # `x ^ x & y` is x without y: Python's integers take it faster than a complement.
    occupied = right | left | fixed
    yields_right = yielding << 1 & vehicles
    yields_left = yielding >> 1 & vehicles
    going_right = right ^ right & resting
    going_left = left ^ left & resting

    want_right = (going_right ^ going_right & right_edge) << 1
    want_left = (going_left ^ going_left & left_edge) >> 1
    taken = occupied | want_right & want_left
    won_right = want_right ^ want_right & (taken | yields_right)
    won_left = want_left ^ want_left & (taken | yields_left)
    turned_left = going_right ^ won_right >> 1
    turned_right = going_left ^ won_left << 1

    occupied |= won_right | won_left
    want_left = (turned_left ^ turned_left & left_edge) >> 1
    want_right = (turned_right ^ turned_right & right_edge) << 1
    taken = occupied | want_right & want_left
    late_left = want_left ^ want_left & (taken | yields_left)
    late_right = want_right ^ want_right & (taken | yields_right)

    came_right = won_right | late_right
    came_left = won_left | late_left
    return Motion(
        came_right | turned_right ^ late_right >> 1 | right & resting,
        came_left | turned_left ^ late_left << 1 | left & resting,
        came_right,
        came_left,
    )


def brake(motion: Motion, standing: Board, attentive: Board) -> Motion:
    """The motion where movers in `attentive` brake for the vehicles that stand still in `standing`.

    A mover that would enter the cell of a vehicle which does not move in this tick keeps its cell and
    its heading instead. Nothing else changes: a cell with a mover in it is never entered by another.
    """
    held_right = motion.came_right & standing & attentive << 1
    held_left = motion.came_left & standing & attentive >> 1
    return Motion(
        motion.right ^ held_right | held_right >> 1,
        motion.left ^ held_left | held_left << 1,
        motion.came_right ^ held_right,
        motion.came_left ^ held_left,
    )


def swap_conflicts(start: Board, end: Board, came_right: Board, came_left: Board) -> Board:
    """`start` if a vehicle that moves sideways from there to `end` passes through a mover on the way."""
    return end << 1 & start & came_right | end >> 1 & start & came_left


class Steps(NamedTuple):
    """Cells that a vehicle (or each of a set of them) may be in after a tick, by move."""

    forward: Board
    left: Board
    right: Board
    forward_left: Board
    forward_right: Board
    stay: Board


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
    """Where vehicles standing in `start` may be next, meeting nothing.

    `ahead` is `start` one row on (a caller with boards cut into words carries it over), `blocked` the fixed
    hazards and the movers after the tick, `came_*` the cells they entered. The sideways steps leave out those
    that pass through a mover (`swapped`, said of sets). `cut_left` holds the cells straight ahead of vehicles
    whose diagonal to the left a mover cuts off: by a step to the right it entered that cell, or the vehicle's
    own behind it (`came_right | came_right >> columns`); `cut_right` is the mirror image. Both are empty
    under the rule `collision: cell`.
    """
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


def beside(board: Board, left_edge: Board, right_edge: Board) -> Board:
    """A set of cells with their neighbours to the left and right."""
    return board | (board & ~left_edge) >> 1 | (board & ~right_edge) << 1


def shift_board(board: Board, motion: Motion) -> Board:
    """A subset of the movers, moved along with them."""
    gone_right = board & motion.came_right >> 1
    gone_left = board & motion.came_left << 1
    return gone_right << 1 | gone_left >> 1 | board & ~gone_right & ~gone_left


def shift_table(table: Mapping[int, str], motion: Motion) -> dict[int, str]:
    """A table of movers by cell index, moved along with them."""
    # As digits, lowest first, and enough of them: looking at one takes half as long as shifting a board does.
    top = 2 << (motion.right | motion.left).bit_length()
    gone_right = bin(motion.came_right >> 1 | top)[:1:-1]
    gone_left = bin(motion.came_left << 1 | top)[:1:-1]
    return {
        cell + 1 if gone_right[cell] == "1" else cell - 1 if gone_left[cell] == "1" else cell: name
        for cell, name in table.items()
    }
