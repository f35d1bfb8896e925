"""The names everything else is spoken of by: kinds of thing and what each does, moves, outcomes.

A leaf: it imports nothing of the project. Offsets are (columns, rows); row 0 is the
destination edge, so forward is −1 in rows. Lane 1 is column 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cache, lru_cache
from types import MappingProxyType
from typing import Final, NamedTuple

Cell = tuple[int, int]
"""(column, row), both counted from 0."""


class Kind(StrEnum):
    """What a thing on the road is."""

    POTHOLE = "pothole"
    BARRIER = "barrier"
    VEHICLE = "vehicle"
    PEDESTRIAN = "pedestrian"
    AV = "av"

    @property
    def moves(self) -> bool:
        """Whether things of this kind move sideways by themselves (a *mover*)."""
        return self in MOVERS

    @property
    def fixed(self) -> bool:
        """Whether things of this kind are part of the road (a *fixed hazard*)."""
        return self in HAZARDS


@lru_cache(16_384)
def kind_of(name: str) -> Kind:
    """The kind of the thing with this id ("vehicle-7"). Raises `ValueError`."""
    return Kind(name.rpartition("-")[0])


@cache
def ego_id(number: int) -> str:
    """The id of the ego at a place of `World.avs` (from 0)."""
    return f"{Kind.AV}-{number + 1}"


def is_ego(name: str) -> bool:
    """Whether this id is that of one of the egos."""
    return name.startswith(f"{Kind.AV}-")


def phantom_id(kind: Kind, number: int) -> str:
    """The id of something a sensor reports that is not there ("pothole-p1"): never that of a real thing."""
    return f"{kind}-p{number}"


class Size(NamedTuple):
    """A body's extent in cells: across the lanes and along the road."""

    across: Fraction
    along: Fraction

    @staticmethod
    def percent(across: int, along: int) -> Size:
        """A size in hundredths of a cell, so that a page can keep the same numbers exactly."""
        return Size(Fraction(across, 100), Fraction(along, 100))


@dataclass(frozen=True, slots=True, kw_only=True)
class KindSpec:
    """Everything that the code has to know about a kind."""

    size: Size
    """the box that holds all of a body (`sim.rules.collision_geometry`)"""
    plural: str
    """the name of its count: of the field of `Config` and `Scenario`, where there is one, and in changes"""
    signs: tuple[str, ...]
    """in the notation: one for what is fixed; for movers heading right and left, then the same when held"""
    sprite: str
    """how it is drawn (`sim.render.sprites`)"""
    period: int | None = None
    """ticks that a mover needs for one cell; None for what does not move by itself"""
    holds_movers: bool = False
    """whether a mover in the same cell is disabled for as long"""
    probability: str | None = None
    """the field of `Config` that furnishes a road where no exact count is given"""
    occludes: bool = False
    """whether its body hides what is behind it from sensors (`sim.perceive.occlusion`)"""


KINDS: Final[Mapping[Kind, KindSpec]] = MappingProxyType(
    {
        Kind.POTHOLE: KindSpec(
            size=Size.percent(50, 50),
            plural="potholes",
            signs=("o",),
            sprite="pothole",
            holds_movers=True,
            probability="pothole_probability",
        ),
        Kind.BARRIER: KindSpec(
            size=Size.percent(66, 30),
            plural="barriers",
            signs=("#",),
            sprite="barrier",
            occludes=True,
        ),
        Kind.VEHICLE: KindSpec(
            size=Size.percent(66, 32),
            plural="vehicles",
            signs=(">", "<", "}", "{"),
            sprite="car",
            period=1,
            probability="spawn_probability",
            occludes=True,
        ),
        Kind.PEDESTRIAN: KindSpec(
            size=Size.percent(30, 32),
            plural="pedestrians",
            signs=(")", "(", "]", "["),
            sprite="pedestrian",
            period=2,
        ),
        Kind.AV: KindSpec(
            size=Size.percent(32, 66),
            plural="avs",
            signs=("A",),
            sprite="ego",
            occludes=True,
        ),
    }
)
"""Every kind, in the order that counts are told in. A mover is blocked by everything; everything blocks the
ego. An ego points up the road, an obstacle vehicle across it."""

PLACEABLE: Final[tuple[Kind, ...]] = tuple(kind for kind in KINDS if kind is not Kind.AV)
"""The kinds that may be added to and removed from a road, in the order counts are told."""
HAZARDS: Final[tuple[Kind, ...]] = tuple(kind for kind in PLACEABLE if KINDS[kind].period is None)
MOVERS: Final[tuple[Kind, ...]] = tuple(kind for kind in PLACEABLE if KINDS[kind].period is not None)
MARKED: Final[tuple[Kind, ...]] = tuple(kind for kind in MOVERS if kind is not Kind.VEHICLE)
"""The movers that have a board of their own: a mover on none of these boards is an obstacle vehicle."""


class Move(StrEnum):
    """What an autonomous vehicle may do in one tick."""

    FORWARD = "forward"
    LEFT = "left"
    RIGHT = "right"
    FORWARD_LEFT = "forward_left"
    FORWARD_RIGHT = "forward_right"
    STAY = "stay"

    offset: Cell
    """(columns, rows) the move adds to the cell of the ego"""


MOVES = tuple(Move)
"""Every move, in the one order that ties are broken in and that numbers of moves refer to."""

# Attributes of the members: a table by move would hash the name each time, which takes longer than all else.
Move.FORWARD.offset = (0, -1)
Move.LEFT.offset = (-1, 0)
Move.RIGHT.offset = (1, 0)
Move.FORWARD_LEFT.offset = (-1, -1)
Move.FORWARD_RIGHT.offset = (1, -1)
Move.STAY.offset = (0, 0)


class Outcome(StrEnum):
    """How an episode stands."""

    RUNNING = "running"
    SUCCESS = "success"
    CRASH = "crash"
    STUCK = "stuck"


class Mode(StrEnum):
    """Who drives the first autonomous vehicle."""

    AUTO = "auto"
    MANUAL = "manual"
