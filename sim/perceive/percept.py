"""The one value that sensors hand to forecasting."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Final, NamedTuple

from sim.fast_replace import field_setter
from sim.rules.behaviour import DEFAULT_BEHAVIOUR
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.types import Kind, Move
from sim.world import Thing
from sim.world.boards import Boards
from sim.world.grid import Board, Road, board_of

CERTAIN: Final[Mapping[str, float]] = {}
"""The likelihoods of sensors that are always sure."""


DOUBTS: Final = (0.05, 0.1, 0.2, 0.35)
"""Levels of doubt: cells that hold something fixed with at least this likelihood, and less than is heeded."""


class OtherEgo(NamedTuple):
    """Another ego, as it tells of itself: announcements need no sensor."""

    id: str
    cell: int
    """cell index now"""
    move: Move
    """the move it has announced for the coming tick; to stay where it has announced none"""
    parked: bool
    """whether it stays until a person asks for something: it has arrived, or nobody drives it"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Percept:
    """What is believed to be where, with the ids that sensors tell apart. Boards as in `World`."""

    road: Road
    tick: int
    episode_tick: int
    ego: int
    """cell index of the ego that looks"""
    ego_id: str
    right: Board
    left: Board
    boards: Boards
    yielding: Board
    """movers seen to give way to autonomous vehicles in this tick"""
    attentive: Board
    """movers beside an autonomous vehicle that brake in this tick if it stands still"""
    vehicles: Board
    """autonomous vehicles, the one that looks included"""
    swept: bool
    """whether bodies collide by what they sweep within a tick (`Config.collision`)"""
    movers: Mapping[int, str]
    hazards: Mapping[int, str]
    dynamics: str = DEFAULT_DYNAMICS
    """how autonomous vehicles move (`sim.rules.dynamics`)"""
    behaviour: str = DEFAULT_BEHAVIOUR
    """how the others move (`sim.rules.behaviour`)"""
    egos: tuple[OtherEgo, ...] = ()
    """the other egos, in the order of their ids"""
    likelihoods: Mapping[str, float] = field(default_factory=lambda: CERTAIN)
    """how likely each thing is to be there, by id, 0 to 1; what is left out is certain"""
    doubtful: tuple[Board, ...] = ()
    """cells that may hold something fixed that is not among the hazards, one board for each of `DOUBTS`"""

    @property
    def potholes(self) -> Board:
        """The cells of potholes."""
        return self.boards[Kind.POTHOLE]

    @property
    def barriers(self) -> Board:
        """The cells of barriers."""
        return self.boards[Kind.BARRIER]

    @property
    def pedestrians(self) -> Board:
        """The cells of pedestrians."""
        return self.boards[Kind.PEDESTRIAN]

    def things(self) -> Iterator[Thing]:
        """Everything that is seen but autonomous vehicles, hazards first."""
        for table in (self.hazards, self.movers):
            for index in table:
                yield self._thing(index, table)

    def find(self, name: str) -> Thing | None:
        """The thing with this id as it is seen, or the other ego, if it is."""
        for other in self.egos:
            if other.id == name:
                return Thing(name, Kind.AV, self.road.cell(other.cell))
        for table in (self.hazards, self.movers):
            for index, found in table.items():
                if found == name:
                    return self._thing(index, table)
        return None

    def without(self, ids: Collection[str]) -> Percept:
        """The same percept had these things not been detected, or these egos not been there.

        Unknown ids are ignored.
        """
        if self.egos and any(other.id in ids for other in self.egos):
            return self._without_egos(lambda name: name not in ids).without(ids)
        movers = {index: name for index, name in self.movers.items() if name not in ids}
        return self._with_only(movers, {at: name for at, name in self.hazards.items() if name not in ids})

    def keeping(self, ids: Collection[str]) -> Percept:
        """The same percept had nothing but these things been detected, and no other egos been there."""
        if self.egos and any(other.id not in ids for other in self.egos):
            return self._without_egos(lambda name: name in ids).keeping(ids)
        movers = {index: name for index, name in self.movers.items() if name in ids}
        return self._with_only(movers, {at: name for at, name in self.hazards.items() if name in ids})

    def _thing(self, index: int, table: Mapping[int, str]) -> Thing:
        name, cell, bit = table[index], self.road.cell(index), 1 << index
        if table is self.hazards:
            return Thing(name, self.boards.fixed_kind(index), cell)
        heading = "right" if self.right & bit else "left"
        return Thing(name, self.boards.mover_kind(index), cell, heading, bool(self.boards.holding & bit))

    def _with_only(self, movers: Mapping[int, str], hazards: Mapping[int, str]) -> Percept:
        """With the things of these tables, parts of its own."""
        moving, fixed = board_of(movers), board_of(hazards)
        return _cut_down(
            self,
            self.right & moving,
            self.left & moving,
            self.boards.within(fixed, moving),
            self.yielding & moving,
            self.attentive & moving,
            movers,
            hazards,
        )

    def _without_egos(self, kept: Callable[[str], bool]) -> Percept:
        """The same with those other egos alone; nobody reacts to one that is not there."""
        egos = tuple(other for other in self.egos if kept(other.id))
        vehicles = 1 << self.ego | board_of([other.cell for other in egos])
        near = vehicles << 1 | vehicles >> 1
        return replace(
            self,
            egos=egos,
            vehicles=vehicles,
            yielding=self.yielding & near,
            attentive=self.attentive & near,
        )


_cut_down = field_setter(
    Percept,
    "right",
    "left",
    "boards",
    "yielding",
    "attentive",
    "movers",
    "hazards",
)
