"""What is seen, and what the ego would meet if it drove straight on: from the percept alone.

Nothing here looks at the world. What sensors miss is not in the answer, what they imagine is, and how
sure they are goes along with each thing: 1 under the perfect sensor, else as `likelihoods` says. When
something is met is not reckoned from speeds: the forecast that planners read is stepped row by row, so it
holds exactly where sight is perfect. Only the first meeting would happen; later ones are told as if the
vehicle had come through.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from sim.config import Config
from sim.forecast import predict
from sim.perceive import Percept
from sim.types import Cell, Kind, Move


@dataclass(frozen=True, slots=True)
class Detection:
    """One thing as it is seen."""

    id: str
    kind: Kind
    cell: Cell
    likelihood: float
    """how sure it is that the thing is there, 0 to 1"""
    lanes: int
    """lanes to the right of the ego; to the left below 0"""
    rows: int
    """rows ahead of the ego; behind it below 0"""
    heading: str | None
    """"left" or "right" for movers"""
    held: bool
    """a mover in a pothole: it stays where it is"""
    ticks: int | None
    """ticks until it is met, if the ego drives straight on; None if it is not met in the next rows"""

    @property
    def walks(self) -> bool:
        """Whether it may be somewhere else by the time it is met."""
        return self.kind.moves and not self.held


@dataclass(frozen=True, slots=True)
class Scene:
    """What is seen at a tick."""

    tick: int
    cell: Cell
    """where the ego is"""
    reach: int
    """rows ahead that were looked at for what would be met; fewer where the goal is nearer"""
    seen: tuple[Detection, ...]
    """what would be met, soonest first; then the rest, the nearest first"""

    @property
    def threats(self) -> tuple[Detection, ...]:
        """What would be met on the way straight on, soonest first."""
        return tuple(thing for thing in self.seen if thing.ticks is not None)

    def of(self, kind: Kind | None) -> tuple[Detection, ...]:
        """Everything, or the things of one kind."""
        return tuple(thing for thing in self.seen if kind is None or thing.kind is kind)


def describe_percept(
    percept: Percept, config: Config, likelihoods: Mapping[str, float] | None = None
) -> Scene:
    """What is seen. `likelihoods`: by id, in place of those of the percept."""
    likelihoods = percept.likelihoods if likelihoods is None else likelihoods
    road = percept.road
    column, row = road.cell(percept.ego)
    reach = min(row, config.visible_rows)
    ticks = _meetings(percept, reach)
    seen = []
    for index, name, kind in _things(percept):
        cell = road.cell(index)
        moves, bit = kind.moves, 1 << index
        seen.append(
            Detection(
                id=name,
                kind=kind,
                cell=cell,
                likelihood=likelihoods.get(name, 1.0),
                lanes=cell[0] - column,
                rows=row - cell[1],
                heading=("right" if percept.right & bit else "left") if moves else None,
                held=moves and bool(percept.boards.holding & bit),
                ticks=ticks.get(name),
            )
        )
    return Scene(percept.tick, (column, row), reach, tuple(sorted(seen, key=_nearest)))


def _things(percept: Percept) -> Iterator[tuple[int, str, Kind]]:
    """Cell, id and kind of all that is seen; what it is, the boards say."""
    for index, name in percept.hazards.items():
        yield index, name, percept.boards.fixed_kind(index)
    for index, name in percept.movers.items():
        yield index, name, percept.boards.mover_kind(index)
    for other in percept.egos:
        yield other.cell, other.id, Kind.AV


def _meetings(percept: Percept, reach: int) -> dict[str, int]:
    """In how many ticks each thing is met that stands in the way straight on."""
    if not reach:
        return {}
    forecast = predict(percept, reach)
    met: dict[str, int] = {}
    here = percept.ego
    for ahead in range(reach):
        then = forecast.dynamics.target(here, Move.FORWARD)
        if then is None or percept.ego - then > reach * percept.road.columns:
            break  # a motion may take fewer ticks than there are rows
        for name in forecast.check_step(here, then, ahead)[1]:
            met.setdefault(name, ahead + 1)
        here = then
    return met


def _nearest(thing: Detection) -> tuple[bool, int, int, int, bool, Cell]:
    """What is met first; then by distance, and among equals own lane, then ahead, first."""
    away = max(abs(thing.lanes), abs(thing.rows))
    return thing.ticks is None, thing.ticks or 0, away, abs(thing.lanes), thing.rows < 0, thing.cell
