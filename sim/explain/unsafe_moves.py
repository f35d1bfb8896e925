"""Moves that a person asked for and the rules of the planners forbid: their cell was seen not to be free.

That is read from the record: a decision keeps what each of its moves was seen to meet. No planner is asked.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.plan import Option
from sim.session.timeline import Timeline
from sim.state import SimState

MOST_TICKS: Final = 1_000
"""Ticks of an episode whose moves are looked at; of a longer one the last."""


@dataclass(frozen=True, slots=True)
class UnsafeMove:
    """One such move."""

    state: SimState
    """the state it was asked for in"""
    option: Option
    held_back: bool
    """whether it was not made, because its cell would not be free"""

    @property
    def tick(self) -> int:
        """Its tick."""
        return self.state.world.tick


@dataclass(frozen=True, slots=True)
class UnsafeMoves:
    """The moves of a person in the present episode."""

    by_hand: int
    """moves that a person asked for"""
    found: tuple[UnsafeMove, ...]


def unsafe_moves(timeline: Timeline) -> UnsafeMoves:
    """The moves of a person that were seen to meet something, for the first ego."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    first = max(world.episode_start, last - MOST_TICKS)
    by_hand, found = 0, []
    for before in timeline.between(first, last) if first < last and timeline.entries else ():
        decision = timeline.decided(before)
        if decision is None or decision.asked is None:
            continue
        by_hand += 1
        option = decision.option(decision.asked)
        if option.reason.blocks:
            found.append(UnsafeMove(before, option, decision.held_back))
    return UnsafeMoves(by_hand, tuple(found))


def latest_by_hand(timeline: Timeline) -> int | None:
    """The tick of the latest move of a person in the present episode; None where there is none."""
    world = timeline.state.world
    last = timeline.tick if world.ended is None else world.ended
    first = max(world.episode_start, last - MOST_TICKS)
    if first >= last or not timeline.entries:
        return None
    latest = None
    for before in timeline.between(first, last):
        decision = timeline.decided(before)
        if decision is not None and decision.asked is not None:
            latest = before.world.tick
    return latest
