"""A world: sets of cells as bitboards, plus the table of things with ids. A value, never changed.

What moves is in `right` and `left`, by heading. `boards` says of which kind things are: what does not move,
and which movers are no obstacle vehicles. The tables `movers` and `hazards` hang ids on cells. Derived state
is derived: a mover on a pothole is *disabled* for as long as the pothole is there.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from hashlib import blake2b
from struct import Struct, pack

from sim.fast_replace import field_setter
from sim.types import PLACEABLE, Cell, Kind, Outcome
from sim.world.boards import NO_BOARDS, Boards
from sim.world.grid import Board, Road, bits, board_of

_OUTCOMES = {outcome: number for number, outcome in enumerate(Outcome)}
_HEAD = Struct("<IIQQQqBH").pack
_CELL = Struct("<I").pack
_UNREAD = blake2b(digest_size=16)
_KINDS = {kind.value: kind for kind in Kind}


@dataclass(frozen=True, slots=True)
class Thing:
    """One thing on the road, with its id."""

    id: str
    kind: Kind
    cell: Cell
    heading: str | None = None
    """"left" or "right" for movers"""
    disabled: bool = False
    """a mover in a pothole: it stays where it is"""


@dataclass(frozen=True, slots=True)
class Cause:
    """Why an episode ended in a crash: what was hit, how (`hit`, `swap` or `cross`), and where."""

    how: str
    kind: Kind
    ids: tuple[str, ...]
    cell: Cell
    ego: str = "av-1"
    """the ego that crashed; of two egos, the later one by id"""


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """Everything that is so at one tick. `avs` and the tables' keys are cell indices."""

    road: Road
    tick: int = 0
    """ticks since the session began"""
    episode: int = 1
    episode_start: int = 0
    """the tick this episode began at"""
    outcome: Outcome = Outcome.RUNNING
    ended: int | None = None
    """the tick at which the outcome was decided"""
    cause: Cause | None = None
    avs: tuple[int, ...]
    right: Board = 0
    left: Board = 0
    boards: Boards = NO_BOARDS
    """which cells hold things of which kind; a mover on none of them is an obstacle vehicle"""
    movers: Mapping[int, str]
    hazards: Mapping[int, str]
    numbered: Mapping[Kind, int]
    """the highest number given so far in the session, by kind: ids are never given twice"""

    @property
    def av(self) -> int:
        """The cell index of the first autonomous vehicle."""
        return self.avs[0]

    @property
    def episode_tick(self) -> int:
        """Ticks since this episode began."""
        return self.tick - self.episode_start

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

    @property
    def fixed(self) -> Board:
        """Everything that does not move."""
        return self.boards.fixed

    @property
    def moving(self) -> Board:
        """Every mover, disabled ones included."""
        return self.right | self.left

    @property
    def disabled(self) -> Board:
        """Movers that a pothole holds."""
        return (self.right | self.left) & self.boards.holding

    @property
    def occupied(self) -> Board:
        """Every cell with anything on it, autonomous vehicles included."""
        return self.fixed | self.moving | self.driven

    @property
    def driven(self) -> Board:
        """The cells of the autonomous vehicles."""
        avs = self.avs
        if len(avs) == 1:
            return 1 << avs[0]
        board = 0
        for cell in avs:
            board |= 1 << cell
        return board

    def board(self, kind: Kind) -> Board:
        """The cells of one kind."""
        if kind is Kind.AV:
            return self.driven
        return self.moving & ~self.boards.others if kind is Kind.VEHICLE else self.boards[kind]

    def count(self, kind: Kind) -> int:
        """How many things of one kind there are."""
        return len(self.avs) if kind is Kind.AV else self.board(kind).bit_count()

    def counts(self) -> dict[Kind, int]:
        """How many things of each placeable kind there are."""
        return {kind: self.count(kind) for kind in PLACEABLE}

    def id_at(self, index: int, kind: Kind) -> str:
        """The id of the thing of that kind in a cell. Raises `KeyError` if there is none."""
        if kind is Kind.AV:
            return f"av-{self.avs.index(index) + 1}"
        return (self.movers if kind.moves else self.hazards)[index]

    def things(self) -> Iterator[Thing]:
        """Everything but the autonomous vehicles, hazards first, each in reading order."""
        for kind in PLACEABLE:
            for index in bits(self.board(kind)):
                yield self._thing(index, kind)

    def find(self, name: str) -> Thing | None:
        """The thing with this id, if it is on the road."""
        found = self.index_of(name)
        if found is None:
            return None
        index, kind = found
        return Thing(name, kind, self.road.cell(index)) if kind is Kind.AV else self._thing(index, kind)

    def index_of(self, name: str) -> tuple[int, Kind] | None:
        """The cell index and the kind of the thing with this id, if it is on the road."""
        kind_word, _, number = name.rpartition("-")
        kind = _KINDS.get(kind_word)
        if kind is None:
            return None
        if kind is Kind.AV:
            places = (index for order, index in enumerate(self.avs, 1) if str(order) == number)
            return next(((index, kind) for index in places), None)
        for index, other in (self.hazards if kind.fixed else self.movers).items():
            if other == name:
                return index, kind
        return None

    def without(self, ids: Collection[str]) -> World:
        """The same world had these things never been there. Unknown ids are no matter."""
        movers = {index: name for index, name in self.movers.items() if name not in ids}
        return self._with_only(movers, {at: name for at, name in self.hazards.items() if name not in ids})

    def keeping(self, ids: Collection[str]) -> World:
        """The same world with nothing on the road but these things."""
        movers = {index: name for index, name in self.movers.items() if name in ids}
        return self._with_only(movers, {at: name for at, name in self.hazards.items() if name in ids})

    def digest(self) -> str:
        """128 bits that are equal exactly when the states are (ids aside), as hexadecimal."""
        columns, rows, avs = self.road.columns, self.road.rows, self.avs
        size = (columns * rows + 7) // 8
        head = _HEAD(
            columns,
            rows,
            self.tick,
            self.episode,
            self.episode_start,
            -1 if self.ended is None else self.ended,
            _OUTCOMES[self.outcome],
            len(avs),
        )
        potholes, barriers, pedestrians = self.boards.first
        parts = (
            head,
            _CELL(avs[0]) if len(avs) == 1 else pack(f"<{len(avs)}I", *avs),
            potholes.to_bytes(size, "little"),
            barriers.to_bytes(size, "little"),
            self.right.to_bytes(size, "little"),
            self.left.to_bytes(size, "little"),
            pedestrians.to_bytes(size, "little"),
            *[kind.encode() + board.to_bytes(size, "little") for kind, board in self.boards.later],
        )
        read = _UNREAD.copy()  # a new one takes as long as all the rest
        read.update(b"".join(parts))
        return read.hexdigest()

    def _thing(self, index: int, kind: Kind) -> Thing:
        bit = 1 << index
        heading = None if kind.fixed else "right" if self.right & bit else "left"
        disabled = kind.moves and bool(self.boards.holding & bit)
        return Thing(self.id_at(index, kind), kind, self.road.cell(index), heading, disabled)

    def _with_only(self, movers: Mapping[int, str], hazards: Mapping[int, str]) -> World:
        """With the things of these tables, parts of its own."""
        moving, fixed = board_of(movers), board_of(hazards)
        return _cut_down(
            self,
            self.right & moving,
            self.left & moving,
            self.boards.within(fixed, moving),
            movers,
            hazards,
        )


_cut_down = field_setter(World, "right", "left", "boards", "movers", "hazards")
