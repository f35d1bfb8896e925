"""Interpolates positions between two ticks, for windows, videos and measurements alike.

Everything moves in a straight line from cell to cell, all at the same share of its way at the same time, as
`sim.rules.collision_geometry` judges collisions. In the tick of a crash everything stops at the first
contact and stays there while the result is shown.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.rules.collision_geometry import SIZES, Path, first_contact
from sim.state import SimState
from sim.types import HAZARDS, Kind, Outcome, ego_id
from sim.world import Thing, World

STEP_FRAMES: Final = 30
"""frames per tick at 60 frames a second and `step_seconds` 0.5"""

Box = tuple[float, float, float, float]
"""left, top, right, bottom, in cells; integers are centres of cells"""


@dataclass(frozen=True, slots=True)
class Pose:
    """A thing and the position of its centre, in cells; integers are centres of cells."""

    thing: Thing
    column: float
    row: float

    @property
    def box(self) -> Box:
        """The area that its body covers."""
        across, along = (float(side) / 2 for side in SIZES[self.thing.kind])
        return self.column - across, self.row - along, self.column + across, self.row + along


@dataclass(frozen=True, slots=True)
class Scene:
    """All poses at one moment."""

    av: Pose
    """the ego that the view is about"""
    things: tuple[Pose, ...]
    """in drawing order: fixed hazards first, other egos last"""
    share: float
    """share of the tick's way that is done, from 0 to 1"""
    touch: tuple[float, float] | None = None
    """(column, row) of the first contact of a crash, from the contact on"""


def smoothstep(phase: float) -> float:
    """f(t) = t²(3 − 2t): the share of the way done after the share `phase` of the time, clipped to [0, 1]."""
    share = min(1.0, max(0.0, phase))
    return share * share * (3.0 - 2.0 * share)


def lerp(start: float, end: float, share: float) -> float:
    """Linear interpolation from `start` (share 0) to `end` (share 1)."""
    return start + (end - start) * share


def glide_start(
    state: SimState, before: World | None, phase: float, *, ego: str | None = None
) -> tuple[World, float]:
    """Returns the world from which things glide to the present one, and the phase of the motion.

    Nothing glides from a world of another episode, or without one. While the result of a crash is shown, the
    answer is the world before the crash with phase 1, so that the bodies stay where they touched.
    """
    world, last = state.world, state.ego(ego).record.last
    if before is not None and before.episode_start != world.episode_start:
        before = None
    stands = world.outcome is Outcome.CRASH and (before is None or before.outcome is Outcome.CRASH)
    if stands and last is not None:
        return last, 1.0
    return (world, 1.0) if before is None else (before, phase)


def poses(before: World, after: World, phase: float, number: int = 0) -> Scene:
    """Interpolates everything on the road at `phase` (share of the time) from one world to the next.

    A thing that `before` lacks is drawn at its present cell. `number`: the ego that the view is about.
    """
    share = smoothstep(phase)
    av = Thing(ego_id(number), Kind.AV, after.road.cell(after.avs[number]))
    start = before.road.cell(before.avs[number])
    was, things = _cells(before), _things(after)
    if len(after.avs) > 1:
        others = _egos(after)
        was = was | {each.id: each.cell for each in _egos(before)}
        things = (*things, *(each for each in others if each.id != av.id))
    touch = None
    if after.outcome is Outcome.CRASH and before.outcome is Outcome.RUNNING:
        several = len(after.avs) > 1 and after.cause is not None
        crashed = _ego(after, after.cause.ego) if several and after.cause is not None else av
        begun = was[crashed.id] if several else start
        around = tuple(each for each in (*things, av) if each.id != crashed.id) if several else things
        struck = _first_contact(Path(Kind.AV, begun, crashed.cell), was, around)
        if struck is not None and share >= struck[0]:
            share = struck[0]
            touch = _overlap_centre(
                _pose_at(crashed, begun, share).box, _pose_at(struck[1], struck[2], share).box
            )
    seen = tuple(_pose_at(thing, was.get(thing.id, thing.cell), share) for thing in things)
    return Scene(_pose_at(av, start, share), seen, share, touch)


def _ego(world: World, name: str) -> Thing:
    return next(each for each in _egos(world) if each.id == name)


def _egos(world: World) -> tuple[Thing, ...]:
    """All egos of a world, by their ids."""
    return tuple(Thing(ego_id(n), Kind.AV, world.road.cell(cell)) for n, cell in enumerate(world.avs))


def _pose_at(thing: Thing, start: tuple[int, int], share: float) -> Pose:
    return Pose(thing, lerp(start[0], thing.cell[0], share), lerp(start[1], thing.cell[1], share))


def _first_contact(
    av: Path, was: dict[str, tuple[int, int]], things: tuple[Thing, ...]
) -> tuple[float, Thing, tuple[int, int]] | None:
    """Finds the first contact of the ego: its share of the way, the thing, and the thing's start cell."""
    first = None
    for thing in things:
        if min(abs(thing.cell[1] - av.start[1]), abs(thing.cell[1] - av.end[1])) > 1:
            continue  # out of reach; the exact test is slow where there are thousands of things
        start = was.get(thing.id, thing.cell)
        when = first_contact(av, Path(thing.kind, start, thing.cell))
        if when is not None and (first is None or when < first[0]):
            first = float(when), thing, start
    return first


def _overlap_centre(one: Box, other: Box) -> tuple[float, float]:
    """The centre of the overlap of two boxes that touch."""
    across = (max(one[0], other[0]) + min(one[2], other[2])) / 2
    return across, (max(one[1], other[1]) + min(one[3], other[3])) / 2


_SEEN: list[tuple[World, tuple[Thing, ...], dict[str, tuple[int, int]]]] = []
"""The two latest worlds with their things: the same two are drawn for many frames."""


def _cached_things(world: World) -> tuple[tuple[Thing, ...], dict[str, tuple[int, int]]]:
    for known, things, cells in _SEEN:
        if known is world:
            return things, cells
    things = tuple(sorted(world.things(), key=lambda thing: thing.kind not in HAZARDS))
    cells = {thing.id: thing.cell for thing in things}
    _SEEN.append((world, things, cells))
    del _SEEN[:-2]
    return things, cells


def _things(world: World) -> tuple[Thing, ...]:
    """The things on the road in drawing order: fixed hazards first."""
    return _cached_things(world)[0]


def _cells(world: World) -> dict[str, tuple[int, int]]:
    return _cached_things(world)[1]
