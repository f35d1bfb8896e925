"""The names everything else is spoken of by: kinds of thing, moves, outcomes.

A leaf: it imports nothing of the project. Offsets are (columns, rows); row 0 is the
destination edge, so forward is −1 in rows. Lane 1 is column 0.
"""

from __future__ import annotations

from enum import StrEnum

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


def kind_of(name: str) -> Kind:
    """The kind of the thing with this id ("vehicle-7"). Raises `ValueError`."""
    return Kind(name.rpartition("-")[0])


HAZARDS = (Kind.POTHOLE, Kind.BARRIER)
MOVERS = (Kind.VEHICLE, Kind.PEDESTRIAN)
PLACEABLE = (*HAZARDS, *MOVERS)
"""The kinds that may be added to and removed from a road, in the order counts are told."""


class Move(StrEnum):
    """What an autonomous vehicle may do in one tick."""

    FORWARD = "forward"
    LEFT = "left"
    RIGHT = "right"
    FORWARD_LEFT = "forward_left"
    FORWARD_RIGHT = "forward_right"
    STAY = "stay"

    @property
    def offset(self) -> Cell:
        """(columns, rows) the move adds to the vehicle's cell."""
        return _OFFSETS[self]


MOVES = tuple(Move)
"""Every move, in the one order that ties are broken in and that numbers of moves refer to."""

_OFFSETS: dict[Move, Cell] = {
    Move.FORWARD: (0, -1),
    Move.LEFT: (-1, 0),
    Move.RIGHT: (1, 0),
    Move.FORWARD_LEFT: (-1, -1),
    Move.FORWARD_RIGHT: (1, -1),
    Move.STAY: (0, 0),
}


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
