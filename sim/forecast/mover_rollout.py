"""Movers rolled out by the rules, as far ahead as is read and no further than was asked for.

The roll-out assumes that movers do not react to the ego after the first tick: nobody gives way and
nobody brakes, but for other egos. With perfect sight it *is* what happens along every way that meets nothing,
where movers leave alone who meets nothing (`Behaviour.free_ways_hold`). `if_standing` is the roll-out where a
mover brakes in the first tick.

Other egos make the move they have announced and then stand where it leads, as far as is known. Movers brake
for those that stand: in the first tick those that are attentive then, later all. A mover that would not brake
ends the episode, so that what comes after it does not matter.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import overload

from sim.perceive import OtherEgo, Percept
from sim.rules.behaviour import NOBODY, Reactions
from sim.rules.behaviour_registry import BEHAVIOURS
from sim.rules.dynamics import Dynamics
from sim.rules.dynamics_registry import dynamics_on
from sim.rules.mover_boards import shift_marked, with_marked
from sim.rules.traffic import Motion
from sim.rules.traffic_cache import cached_shift_table, cached_step
from sim.types import Move
from sim.world.boards import Boards
from sim.world.grid import Board, board_of


class RollOut(Sequence[Motion]):
    """`roll_out[k]` is expected k + 1 ticks from now. Ticks are computed when they are first read."""

    __slots__ = (
        "_behaviour",
        "_fixed",
        "_horizon",
        "_left",
        "_left_edge",
        "_marked",
        "_marked_after",
        "_reactions",
        "_right",
        "_right_edge",
        "_slices",
        "_standing",
        "_stands",
        "_tables",
        "disabled",
        "percept",
    )

    def __init__(self, percept: Percept, horizon: int, *, stands: bool = False) -> None:
        """The next `horizon` ticks (at least one) from what is seen.

        With `stands`, the ego does not move in the first of them, and attentive movers brake for it.
        """
        if horizon < 1:
            raise ValueError("a horizon is at least one tick")
        self.percept = percept
        """what it was made from"""
        self._horizon = horizon
        self._stands = stands
        boards = percept.boards
        self._behaviour = BEHAVIOURS[percept.behaviour]
        yielding, attentive = percept.yielding, percept.attentive
        self._reactions = Reactions(yielding, attentive) if yielding or attentive else NOBODY
        self._fixed = boards.fixed
        self._right, self._left = right, left = percept.right, percept.left
        self.disabled = (right | left) & boards.holding
        """movers that a hazard holds"""
        self._slices: list[Motion] = []
        self._marked = boards.marked if boards.others else ()
        self._marked_after: list[tuple[Board, ...]] = []
        self._tables: list[Mapping[int, str]] = []
        self._left_edge, self._right_edge = percept.road.left_edge, percept.road.right_edge
        self._standing: Board | None = None

    def __len__(self) -> int:
        return self._horizon

    def __repr__(self) -> str:
        return f"RollOut(horizon={self._horizon}, stands={self._stands})"

    @overload
    def __getitem__(self, ahead: int) -> Motion: ...
    @overload
    def __getitem__(self, ahead: slice) -> list[Motion]: ...
    def __getitem__(self, ahead: int | slice) -> Motion | list[Motion]:
        slices = self._slices
        if ahead == 0:  # asked for most, by far
            if not slices:
                slices.append(self._next())
            return slices[0]
        if isinstance(ahead, slice):
            return [self[each] for each in range(*ahead.indices(self._horizon))]
        if not 0 <= ahead < len(slices):
            if not 0 <= ahead < self._horizon:
                raise IndexError(f"{ahead} ticks ahead is beyond the horizon of {self._horizon}")
            while len(slices) <= ahead:
                slices.append(self._next())
        return slices[ahead]

    def movers(self, ahead: int) -> Mapping[int, str]:
        """Who is expected in which cell, `ahead` + 1 ticks from now."""
        while len(self._tables) <= ahead:
            before = self._tables[-1] if self._tables else self.percept.movers
            self._tables.append(cached_shift_table(before, self[len(self._tables)]))
        return self._tables[ahead]

    def boards(self, ahead: int) -> Boards:
        """Where things of which kind are expected, `ahead` + 1 ticks from now."""
        boards, marked = self.percept.boards, self.marked(ahead)
        return with_marked(boards, marked) if marked else boards

    def marked(self, ahead: int) -> tuple[Board, ...]:
        """Where the movers of each kind in `MARKED` are expected then; empty where there are none."""
        if not self._marked:
            return ()  # they do not come and go
        if len(self._marked_after) <= ahead:
            self[ahead]  # rolls out that far
        return self._marked_after[ahead]

    @property
    def standing(self) -> Board:
        """The cells that other egos stand in after the first tick."""
        if self._standing is None:
            percept = self.percept
            dynamics = dynamics_on(percept.road, percept.dynamics, percept.swept)
            self._standing = board_of([other_end(dynamics, other) for other in percept.egos])
        return self._standing

    def if_standing(self) -> RollOut | None:
        """The roll-out where the ego does not move in the first tick; None where that changes nothing."""
        ego, motion = self.percept.ego, self[0]
        if self._stands or not motion.occupied >> ego & 1:
            return None
        braked = self._behaviour.brake(motion, 1 << ego, self._reactions)
        if braked is motion or braked == motion:
            return None
        return RollOut(self.percept, self._horizon, stands=True)

    def _next(self) -> Motion:
        percept, ahead, marked = self.percept, len(self._slices), self._marked
        if ahead:
            motion = self._behaviour.step(
                self._right,
                self._left,
                marked,
                self.disabled,
                self._fixed,
                self._left_edge,
                self._right_edge,
                percept.episode_tick + ahead,
                0,
                NOBODY,
            )
        else:
            # Only the first tick is asked for again: when it comes.
            motion = cached_step(
                self._behaviour,
                self._right,
                self._left,
                percept.boards.marked,
                self.disabled,
                self._fixed,
                self._left_edge,
                self._right_edge,
                percept.episode_tick,
                percept.vehicles,
                self._reactions,
            )
            if self._stands:
                motion = self._behaviour.brake(motion, 1 << percept.ego, self._reactions)
        if percept.egos:
            motion = self._braked_for_egos(motion, ahead)
        self._right, self._left = motion.right, motion.left
        if marked:
            self._marked = shift_marked(marked, motion)
            self._marked_after.append(self._marked)
        return motion

    def _braked_for_egos(self, motion: Motion, ahead: int) -> Motion:
        """The motion of a tick with the movers that brake for other egos."""
        percept = self.percept
        if ahead:
            return self._behaviour.brake(motion, self.standing, Reactions(attentive=percept.road.all))
        staying = board_of([other.cell for other in percept.egos if other.move is Move.STAY])
        return self._behaviour.brake(motion, staying, self._reactions)


def other_end(dynamics: Dynamics, other: OtherEgo) -> int:
    """The cell that another ego's announced move leads to; its own where that is off the road."""
    end = dynamics.target(other.cell, other.move)
    return other.cell if end is None else end
