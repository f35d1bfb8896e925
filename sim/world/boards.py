"""Which cell holds what kind of thing: a board for each kind, and what follows from them.

A value that worlds share from tick to tick: it is made anew only where a mover with a board of its own moved.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Final

from sim.fast_replace import fast_constructor
from sim.types import HAZARDS, KINDS, MARKED, Kind
from sim.world.grid import Board, union

BOARDED: Final = (*HAZARDS, *MARKED)
"""The kinds with a board, in the order of `Boards.by_kind`. Movers on none of them are obstacle vehicles."""
PLACE: Final[Mapping[Kind, int]] = {kind: place for place, kind in enumerate(BOARDED)}
"""The place of each of these kinds in `Boards.by_kind`."""
_HOLDING: Final = tuple(PLACE[kind] for kind in HAZARDS if KINDS[kind].holds_movers)
_FIXED: Final = len(HAZARDS)
_FIRST: Final = (Kind.POTHOLE, Kind.BARRIER, Kind.PEDESTRIAN)
_LATER: Final = tuple(kind for kind in BOARDED if kind not in _FIRST)
_of_first: Final = itemgetter(*(PLACE[kind] for kind in _FIRST))


@dataclass(frozen=True, slots=True)
class Boards:
    """The cells of every kind in `BOARDED`, and their unions. Made by `of`."""

    hazards: tuple[Board, ...]
    """of each kind in `HAZARDS`"""
    marked: tuple[Board, ...]
    """the movers of each kind in `MARKED`"""
    fixed: Board
    """everything that does not move"""
    holding: Board
    """everything that disables a mover in its cell"""
    others: Board
    """every mover that is not an obstacle vehicle"""

    @staticmethod
    def of(boards: Mapping[Kind, Board]) -> Boards:
        """The boards of these kinds; the others are empty. Raises `KeyError` for a kind that has no board."""
        unknown = set(boards) - set(BOARDED)
        if unknown:
            raise KeyError(*unknown)
        return Boards.in_order([boards.get(kind, 0) for kind in BOARDED])

    @staticmethod
    def in_order(boards: Sequence[Board]) -> Boards:
        """From a board for every kind of `BOARDED`, in that order."""
        hazards, marked = tuple(boards[:_FIXED]), tuple(boards[_FIXED:])
        holding = union(boards[place] for place in _HOLDING)
        return Boards(hazards, marked, union(hazards), holding, union(marked))

    def __getitem__(self, kind: Kind) -> Board:
        """The cells of a kind in `BOARDED`."""
        place = PLACE[kind]
        return self.hazards[place] if place < _FIXED else self.marked[place - _FIXED]

    @property
    def by_kind(self) -> tuple[Board, ...]:
        """A board for every kind of `BOARDED`, in that order."""
        return self.hazards + self.marked

    @property
    def first(self) -> tuple[Board, ...]:
        """The boards of the first three kinds with one: potholes, barriers, pedestrians."""
        found: tuple[Board, ...] = _of_first(self.hazards + self.marked)
        return found

    @property
    def later(self) -> tuple[tuple[Kind, Board], ...]:
        """What is on the road of kinds that came after the first four.

        The boards of the first are part of every digest and every saved world, others where there are such.
        """
        return tuple([(kind, self[kind]) for kind in _LATER if self[kind]]) if _LATER else ()

    def with_kind(self, kind: Kind, board: Board) -> Boards:
        """The boards with the cells of one kind replaced."""
        place = PLACE[kind]
        return Boards.in_order((*self.by_kind[:place], board, *self.by_kind[place + 1 :]))

    def within(self, fixed: Board, moving: Board) -> Boards:
        """The fixed hazards in the cells of `fixed`, and the movers in those of `moving`."""
        return _boards(
            tuple([board & fixed for board in self.hazards]),
            tuple([board & moving for board in self.marked]),
            self.fixed & fixed,
            self.holding & fixed,
            self.others & moving,
        )

    def fixed_kind(self, index: int) -> Kind:
        """The kind of the fixed hazard in a cell, the first of several. Raises `KeyError`."""
        for kind, board in zip(HAZARDS, self.hazards, strict=True):
            if board >> index & 1:
                return kind
        raise KeyError(index)

    def mover_kind(self, index: int) -> Kind:
        """The kind of a mover in a cell, if there is one."""
        if self.others >> index & 1:
            for kind, board in zip(MARKED, self.marked, strict=True):
                if board >> index & 1:
                    return kind
        return Kind.VEHICLE


_boards = fast_constructor(Boards, "hazards", "marked", "fixed", "holding", "others")

NO_BOARDS: Final = Boards.of({})
"""Nothing anywhere."""
