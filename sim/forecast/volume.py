"""The volume (tick, row, column) of what is expected: fixed hazards, and movers rolled out by the rules.

Risk and preferences enter as further terms beside `fixed` and the slices.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from sim.changing import maker
from sim.forecast.rollout import RollOut
from sim.perceive import Percept
from sim.road import Board, Road
from sim.rules import Steps, free_steps, spread, swapped


class Verdict(StrEnum):
    """What is to be expected of a step into a cell, and through what."""

    FREE = "free"
    OFF_ROAD = "off_road"
    POTHOLE = "pothole"
    BARRIER = "barrier"
    DISABLED_MOVER = "disabled_mover"
    MOVER_STAYS = "mover_stays"
    MOVER_ENTERS = "mover_enters"
    MOVER_SWAPS = "mover_swaps"

    @property
    def blocks(self) -> bool:
        """Whether the step would end in a collision or off the road."""
        return self is not Verdict.FREE


@dataclass(frozen=True, slots=True)
class Forecast:
    """`slices[k]` is expected k + 1 ticks from now; fixed hazards hold throughout."""

    road: Road
    tick: int
    episode_tick: int
    ego: int
    ego_id: str
    potholes: Board
    barriers: Board
    disabled: Board
    hazards: Mapping[int, str]
    slices: RollOut

    @property
    def fixed(self) -> Board:
        """Every pothole and barrier."""
        return self.potholes | self.barriers

    def blocked(self, ahead: int = 0) -> Board:
        """Every cell that anything stands in, `ahead` + 1 ticks from now."""
        return self.fixed | self.slices[ahead].occupied

    def spread(self, start: Board, ahead: int = 0) -> Board:
        """Every cell a vehicle in any cell of `start` may be in one tick later, `ahead` ticks from now."""
        road = self.road
        right, left, came_right, came_left = self.slices[ahead]
        return spread(
            start,
            start >> road.columns,
            self.potholes | self.barriers | right | left,
            came_right,
            came_left,
            road.left_edge,
            road.right_edge,
        )

    def steps(self, start: Board, ahead: int = 0) -> Steps:
        """Where vehicles in any cell of `start` may be one tick later, `ahead` ticks from now."""
        road = self.road
        right, left, came_right, came_left = self.slices[ahead]
        return free_steps(
            start,
            start >> road.columns,
            self.potholes | self.barriers | right | left,
            came_right,
            came_left,
            road.left_edge,
            road.right_edge,
        )

    def expect(self, start: int, end: int | None, ahead: int = 0) -> tuple[Verdict, tuple[str, ...]]:
        """What a step from `start` to `end` meets, `ahead` ticks from now, and the ids of who is met.

        Cell indices; `end` None means off the road. All who block are named, not the first.
        """
        if end is None:
            return Verdict.OFF_ROAD, ()
        right, left, came_right, came_left = self.slices[ahead]
        bit = 1 << end
        verdict = Verdict.FREE
        who: tuple[str, ...] = ()
        if swapped(1 << start, bit, came_right, came_left):
            verdict, who = Verdict.MOVER_SWAPS, (self.slices.movers(ahead)[start],)
        if bit & (right | left):
            who = (self.slices.movers(ahead)[end], *who)
            if bit & self.disabled:
                verdict = Verdict.DISABLED_MOVER
            elif bit & (came_right | came_left):
                verdict = Verdict.MOVER_ENTERS
            else:
                verdict = Verdict.MOVER_STAYS
        if bit & (self.potholes | self.barriers):
            who = (self.hazards[end], *who)
            if not bit & self.disabled:
                verdict = Verdict.POTHOLE if bit & self.potholes else Verdict.BARRIER
        return verdict, who

    def will_be_free(self, start: int, end: int | None, ahead: int = 0) -> bool:
        """Whether a step meets nothing."""
        return not self.expect(start, end, ahead)[0].blocks


_expected = maker(
    Forecast,
    "road",
    "tick",
    "episode_tick",
    "ego",
    "ego_id",
    "potholes",
    "barriers",
    "disabled",
    "hazards",
    "slices",
)


def foretell(percept: Percept, horizon: int) -> Forecast:
    """What to expect of the next `horizon` ticks (at least one)."""
    return _expected(
        percept.road,
        percept.tick,
        percept.episode_tick,
        percept.ego,
        percept.ego_id,
        percept.potholes,
        percept.barriers,
        (percept.right | percept.left) & percept.potholes,
        percept.hazards,
        RollOut(percept, horizon),
    )
