"""The closest call of a stretch of ticks: how near what moves came to the ego, body to body.

Within a tick bodies go in straight lines (`sim.rules.collision_geometry`), so the gap between two of them is
that between a box and a point on a line; it is least at an end of the line, where the point comes level with
a side of the box, or where it is nearest to a corner. The time to collision is the usual one: how long until
contact if both kept the motion they have (J. C. Hayward, *Near-miss determination through use of a scale of
danger*, 1972).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import pairwise, product
from math import hypot, inf
from typing import Final

from sim.rules.collision_geometry import SIZES, Path
from sim.state import SimState
from sim.types import Kind, kind_of
from sim.world import World

REACH: Final = 3
"""Cells around the ego in which a mover is looked for; whatever is further off passes at more than a cell."""

NEAR_MISS_M: Final = 0.5
"""A gap under this many metres, without contact, is a near miss; a lane's width apart is more than that."""


@dataclass(frozen=True, slots=True)
class ClosestCall:
    """The least gap to something that moves, without contact."""

    before: SimState
    """the state at the tick in which it was"""
    id: str
    gap_m: float
    """metres between the two bodies"""
    ttc_s: float | None
    """seconds to contact had both kept their motion of that tick; None where they would not have met"""

    @property
    def tick(self) -> int:
        """The tick in which it was."""
        return self.before.world.tick

    @property
    def near_miss(self) -> bool:
        """Whether it was that close that it counts as a near miss."""
        return self.gap_m < NEAR_MISS_M


def closest_call(states: Iterable[SimState]) -> ClosestCall | None:
    """The closest call of the first ego in states one tick apart, the earliest of equals; None if none."""
    return next(iter(closest_calls(states)), None)


def closest_calls(states: Iterable[SimState], kind: Kind | None = None) -> tuple[ClosestCall, ...]:
    """The closest call with each mover, of a kind or of any: the closest first, of equals the earliest."""
    least: dict[str, ClosestCall] = {}
    for before, after in pairwise(states):
        for call in _calls(before, after, kind):
            if call.id not in least or call.gap_m < least[call.id].gap_m:
                least[call.id] = call
    return tuple(sorted(least.values(), key=lambda call: (call.gap_m, call.tick)))


def near_misses(states: Iterable[SimState], kind: Kind | None = None) -> tuple[ClosestCall, ...]:
    """Each near miss in its order; one that lasts several ticks is one, told where the gap was least."""
    found: list[ClosestCall] = []
    lasting: dict[str, int] = {}
    for before, after in pairwise(states):
        close = [call for call in _calls(before, after, kind) if call.near_miss]
        here: dict[str, int] = {}
        for call in close:
            at = lasting.get(call.id)
            if at is None:
                at = len(found)
                found.append(call)
            elif call.gap_m < found[at].gap_m:
                found[at] = call
            here[call.id] = at
        lasting = here
    return tuple(found)


def _calls(before: SimState, after: SimState, kind: Kind | None) -> Iterator[ClosestCall]:
    """What came near without contact in a tick, with its gap."""
    for id, own, other in encounters(before.world, after.world):
        if kind not in (None, kind_of(id)):
            continue
        gap_m = round(least_gap(own, other) * before.config.cell_m, 6)
        if gap_m > 0:
            ticks = ticks_to_contact(own, other)
            ttc_s = None if ticks is None else round(ticks * before.config.step_seconds, 6)
            yield ClosestCall(before, id, gap_m, ttc_s)


def encounters(before: World, after: World) -> Iterator[tuple[str, Path, Path]]:
    """What moved near the first ego in a tick: its id, the ego's way and its own."""
    same_drive = (before.episode, before.episode_start) == (after.episode, after.episode_start)
    if before.ended is not None or not same_drive or before.road != after.road:
        return
    road = before.road
    start, end = road.cell(before.avs[0]), road.cell(after.avs[0])
    if not _one_step(start, end):
        return
    own = Path(Kind.AV, start, end)
    columns = range(max(0, start[0] - REACH), min(road.columns, start[0] + REACH + 1))
    rows = range(max(0, start[1] - REACH), min(road.rows, start[1] + REACH + 1))
    for cell in product(columns, rows):
        id = before.movers.get(cell[1] * road.columns + cell[0])
        if id is None:
            continue
        for step in (0, -1, 1):
            to = cell[0] + step, cell[1]
            if 0 <= to[0] < road.columns and after.movers.get(road.index(to)) == id:
                yield id, own, Path(kind_of(id), cell, to)
    for number, (was, now) in enumerate(zip(before.avs[1:], after.avs[1:], strict=False), 2):
        if _one_step(road.cell(was), road.cell(now)):
            yield f"{Kind.AV}-{number}", own, Path(Kind.AV, road.cell(was), road.cell(now))


def _one_step(start: tuple[int, int], end: tuple[int, int]) -> bool:
    """Whether a tick leads from one cell to the other; a change of the road may lead anywhere."""
    return max(abs(end[0] - start[0]), abs(end[1] - start[1])) <= 1


def least_gap(one: Path, other: Path) -> float:
    """The least distance between two bodies within a tick, in cells; 0 on contact."""
    return _least_gap(*_relative(one, other))


def ticks_to_contact(one: Path, other: Path) -> float | None:
    """Ticks until two bodies touch if both keep the motion of this tick; None if they never do."""
    return _ticks_to_contact(*_relative(one, other))


@lru_cache(maxsize=10_000)
def _least_gap(x: int, y: int, u: int, v: int, reach_x: float, reach_y: float) -> float:
    times = [0.0, 1.0]
    times += [(side * reach_x - x) / u for side in (-1, 1) if u]
    times += [(side * reach_y - y) / v for side in (-1, 1) if v]
    if u or v:
        corners = product((-reach_x, reach_x), (-reach_y, reach_y))
        times += [((cx - x) * u + (cy - y) * v) / (u * u + v * v) for cx, cy in corners]
    return min(
        hypot(max(0.0, abs(x + u * t) - reach_x), max(0.0, abs(y + v * t) - reach_y))
        for t in times
        if 0 <= t <= 1
    )


@lru_cache(maxsize=10_000)
def _ticks_to_contact(x: int, y: int, u: int, v: int, reach_x: float, reach_y: float) -> float | None:
    enter, leave = 0.0, inf
    for apart, speed, reach in ((x, u, reach_x), (y, v, reach_y)):
        if not speed:
            if abs(apart) >= reach:
                return None
            continue
        first, last = sorted(((-reach - apart) / speed, (reach - apart) / speed))
        enter, leave = max(enter, first), min(leave, last)
    return enter if enter < leave else None


def _relative(one: Path, other: Path) -> tuple[int, int, int, int, float, float]:
    """Where another body is and how it moves in a tick as seen from one, and the half-sums of their sizes.

    There are few such situations, so what follows from them is remembered.
    """
    x, y = other.start[0] - one.start[0], other.start[1] - one.start[1]
    u = other.end[0] - one.end[0] - x
    v = other.end[1] - one.end[1] - y
    return x, y, u, v, *_reach(one.kind, other.kind)


@cache
def _reach(one: Kind, other: Kind) -> tuple[float, float]:
    a, b = SIZES[one], SIZES[other]
    return float(a.across + b.across) / 2, float(a.along + b.along) / 2
