"""Movers rolled out by the rules, as far ahead as is read and no further than was asked for.

The roll-out assumes that movers do not react to the vehicle after the first tick: nobody gives way and
nobody brakes. With perfect sight it *is* what happens along every way that meets nothing, where movers leave
alone who meets nothing (`Behaviour.free_ways_hold`). `if_standing` is the roll-out where a mover brakes in
the first tick.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import overload

from sim.perceive import Percept
from sim.rules.behaviour import NOBODY, Reactions
from sim.rules.behaviour_registry import BEHAVIOURS
from sim.rules.traffic import Motion, shift_board
from sim.rules.traffic_cache import cached_shift_table, cached_step
from sim.world.grid import Board


class RollOut(Sequence[Motion]):
    """`roll_out[k]` is expected k + 1 ticks from now. Ticks are computed when they are first read."""

    __slots__ = (
        "_behaviour",
        "_disabled",
        "_fixed",
        "_horizon",
        "_left",
        "_pedestrians",
        "_percept",
        "_reactions",
        "_right",
        "_slices",
        "_stands",
        "_tables",
        "_walked",
    )

    def __init__(self, percept: Percept, horizon: int, *, stands: bool = False) -> None:
        """The next `horizon` ticks (at least one) from what is seen.

        With `stands`, the vehicle does not move in the first of them, and attentive movers brake for it.
        """
        if horizon < 1:
            raise ValueError("a horizon is at least one tick")
        self._percept = percept
        self._horizon = horizon
        self._stands = stands
        self._behaviour = BEHAVIOURS[percept.behaviour]
        yielding, attentive = percept.yielding, percept.attentive
        self._reactions = Reactions(yielding, attentive) if yielding or attentive else NOBODY
        self._fixed = percept.potholes | percept.barriers
        self._disabled = (percept.right | percept.left) & percept.potholes
        self._slices: list[Motion] = []
        self._walked: list[Board] = []
        self._tables: list[Mapping[int, str]] = []
        self._right, self._left, self._pedestrians = percept.right, percept.left, percept.pedestrians

    def __len__(self) -> int:
        return self._horizon

    @overload
    def __getitem__(self, ahead: int) -> Motion: ...
    @overload
    def __getitem__(self, ahead: slice) -> list[Motion]: ...
    def __getitem__(self, ahead: int | slice) -> Motion | list[Motion]:
        slices = self._slices
        if ahead == 0 and slices:
            return slices[0]  # asked for most, by far
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
            before = self._tables[-1] if self._tables else self._percept.movers
            self._tables.append(cached_shift_table(before, self[len(self._tables)]))
        return self._tables[ahead]

    def pedestrians(self, ahead: int) -> Board:
        """Where pedestrians are expected, `ahead` + 1 ticks from now."""
        self[ahead]  # rolls out that far
        return self._walked[ahead]

    def if_standing(self) -> RollOut | None:
        """The roll-out where the vehicle does not move in the first tick; None where that changes nothing."""
        ego, motion = self._percept.ego, self[0]
        if self._stands or not motion.occupied >> ego & 1:
            return None
        if self._behaviour.brake(motion, 1 << ego, self._reactions) == motion:
            return None
        return RollOut(self._percept, self._horizon, stands=True)

    def _next(self) -> Motion:
        percept, ahead = self._percept, len(self._slices)
        road = percept.road
        movers = (
            self._behaviour,
            self._right,
            self._left,
            self._pedestrians,
            self._disabled,
            self._fixed,
            road.left_edge,
            road.right_edge,
            percept.episode_tick + ahead,
        )
        # Only the first tick is asked for again: when it comes.
        if ahead:
            motion = self._behaviour.step(*movers[1:], 0, NOBODY)
        else:
            motion = cached_step(*movers, percept.vehicles, self._reactions)
            if self._stands:
                motion = self._behaviour.brake(motion, 1 << percept.ego, self._reactions)
        self._right, self._left = motion.right, motion.left
        if self._pedestrians:
            self._pedestrians = shift_board(self._pedestrians, motion)
        self._walked.append(self._pedestrians)
        return motion
