"""How the other road users move in a tick: the only copy of the rule.

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


def shift_board(board: Board, motion: Motion) -> Board:
    """A subset of the movers, moved along with them."""
    gone_right = board & motion.came_right >> 1
    gone_left = board & motion.came_left << 1
    return board ^ (gone_right | gone_left) | gone_right << 1 | gone_left >> 1


def shift_table(table: Mapping[int, str], motion: Motion) -> dict[int, str]:
    """A table of movers by cell index, moved along with them."""
    right, left, came_right, came_left = motion
    # As digits, lowest first, and enough of them: looking at one takes half as long as shifting a board does.
    top = 2 << (right | left).bit_length()
    gone_right = bin(came_right >> 1 | top)[:1:-1].encode()
    gone_left = bin(came_left << 1 | top)[:1:-1].encode()
    return {cell + gone_right[cell] - gone_left[cell]: name for cell, name in table.items()}
