"""The volume (tick, row, column) of what is expected: fixed hazards, and movers rolled out by the rules.

With perfect sight and no courtesy the roll-out *is* what will happen, since movers do not react to
vehicles; with courtesy the first tick is exact and later ones assume that nobody gives way.
Risk and preferences enter as further terms beside `fixed` and the slices.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from sim.perceive import Percept
from sim.road import Board, Road
from sim.rules import followed_board, followed_table, move_movers, pedestrians_walk, swapped


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
class Slice:
    """Movers as expected after some ticks: where, and which cells were entered in the last one."""

    occupied: Board
    came_right: Board
    came_left: Board
    movers: Mapping[int, str]


@dataclass(frozen=True, slots=True)
class Forecast:
    """`slices[k]` is expected k + 1 ticks from now; fixed hazards hold throughout."""

    road: Road
    tick: int
    ego: int
    ego_id: str
    potholes: Board
    barriers: Board
    disabled: Board
    hazards: Mapping[int, str]
    slices: tuple[Slice, ...]

    def expect(self, start: int, end: int | None, ahead: int = 0) -> tuple[Verdict, tuple[str, ...]]:
        """What a step from `start` to `end` meets, `ahead` ticks from now, and the ids of who is met.

        Cell indices; `end` None means off the road. All who block are named, not the first.
        """
        if end is None:
            return Verdict.OFF_ROAD, ()
        slice_ = self.slices[ahead]
        bit = 1 << end
        verdict = Verdict.FREE
        who: tuple[str, ...] = ()
        swap = swapped(1 << start, bit, slice_.came_right, slice_.came_left)
        if swap:
            verdict, who = Verdict.MOVER_SWAPS, (slice_.movers[start],)
        if bit & slice_.occupied:
            who = (slice_.movers[end], *who)
            if bit & self.disabled:
                verdict = Verdict.DISABLED_MOVER
            elif bit & (slice_.came_right | slice_.came_left):
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


def foretell(percept: Percept, horizon: int) -> Forecast:
    """What to expect of the next `horizon` ticks (at least one)."""
    road = percept.road
    fixed = percept.potholes | percept.barriers
    disabled = (percept.right | percept.left) & percept.potholes
    right, left, pedestrians = percept.right, percept.left, percept.pedestrians
    table, yielding = percept.movers, percept.yielding
    slices = []
    for ahead in range(horizon):
        walking = pedestrians_walk(percept.episode_tick + ahead)
        resting = disabled if walking else disabled | pedestrians
        motion = move_movers(
            right, left, resting, fixed, yielding, percept.vehicles, road.left_edge, road.right_edge
        )
        right, left, yielding = motion.right, motion.left, 0
        pedestrians = followed_board(pedestrians, motion)
        table = followed_table(table, motion)
        slices.append(Slice(right | left, motion.came_right, motion.came_left, table))
    return Forecast(
        road=road,
        tick=percept.tick,
        ego=percept.ego,
        ego_id=percept.ego_id,
        potholes=percept.potholes,
        barriers=percept.barriers,
        disabled=disabled,
        hazards=percept.hazards,
        slices=tuple(slices),
    )
