"""Moments like another: the same move among much the same things around the ego.

What is compared is what was seen: each cell in a window around the ego with the kind of thing in it. How
alike two moments are is the share of the cells with something in them that hold the same in both (the Jaccard
index; P. Jaccard, *The distribution of the flora in the alpine zone*, 1912).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from sim.decide import sense
from sim.explain.facts import QuestionError
from sim.explain.pattern import move_between
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Kind, Move, kind_of

ACROSS: Final = 1
"""Columns to either side that are compared."""
AHEAD: Final = 2
"""Rows ahead that are compared, beside the ego's own."""
MOST_TICKS: Final = 400
"""Ticks before the present that are looked through."""
LEAST_ALIKE: Final = 0.3
"""Moments that are less alike than this are not like each other."""
APART: Final = 3
"""Ticks that two of the moments found are apart at least, since neighbouring ticks are always alike."""

Around = Mapping[tuple[int, int], Kind]
"""What is around the ego, by columns to the right and rows ahead."""


@dataclass(frozen=True, slots=True)
class Likeness:
    """A moment that is like the one asked about."""

    before: SimState
    shared: tuple[tuple[tuple[int, int], Kind], ...]
    """what is around the ego in both, the nearest first"""
    alike: float
    """the share of what is around it that is the same, 0 to 1"""

    @property
    def tick(self) -> int:
        """Its tick."""
        return self.before.world.tick


@dataclass(frozen=True, slots=True)
class Similar:
    """The moment asked about, and those that are like it, the most alike first."""

    before: SimState
    move: Move
    around: int
    """how many things were around the ego"""
    found: tuple[Likeness, ...]
    searched: int
    """ticks that were looked through"""


def similar(timeline: Timeline, count: int, tick: int | None = None) -> Similar:
    """The moments most like one: that at a tick, or of the latest decision; the same move was made in each.

    Raises `QuestionError`: `no_such_tick`, `nothing_yet`, `not_yet`.
    """
    now = timeline.tick
    if tick is not None and tick >= now:
        raise QuestionError("not_yet" if tick == now else "no_such_tick", tick=tick, now=now)
    first = max(0, now - MOST_TICKS)
    states = list(timeline.between(min(first, now if tick is None else tick), now + 1))
    driven = [
        (state, move) for state, after in pairwise(states) if (move := move_between(state, after)) is not None
    ]
    meant = driven[-1:] if tick is None else [each for each in driven if each[0].world.tick == tick]
    if not meant:
        raise QuestionError("nothing_yet" if tick is None else "no_drive", tick=now if tick is None else tick)
    (state, made) = meant[0]
    seen = around(state)
    likes = []
    for other, move in driven:
        if move is not made or abs(other.world.tick - state.world.tick) < APART:
            continue
        theirs = around(other)
        shared = [(at, kind) for at, kind in seen.items() if theirs.get(at) is kind]
        whole = len({*seen, *theirs})
        alike = len(shared) / whole if whole else 1.0
        if alike >= LEAST_ALIKE:
            shared.sort(key=lambda each: (max(map(abs, each[0])), each[0]))
            likes.append(Likeness(other, tuple(shared), alike))
    likes.sort(key=lambda each: (-each.alike, -each.tick))
    found: list[Likeness] = []
    for like in likes:
        if len(found) < count and all(abs(like.tick - other.tick) >= APART for other in found):
            found.append(like)
    return Similar(state, made, len(seen), tuple(found), len(driven))


def around(state: SimState) -> Around:
    """What the first ego sees around it."""
    road, percept = state.world.road, sense(state)[0]
    column, row = road.cell(state.world.av)
    found: dict[tuple[int, int], Kind] = {}
    for table in (percept.hazards, percept.movers):
        for index, name in table.items():
            other_column, other_row = road.cell(index)
            across, ahead = other_column - column, row - other_row
            if abs(across) <= ACROSS and 0 <= ahead <= AHEAD:
                found[across, ahead] = kind_of(name)
    return found
