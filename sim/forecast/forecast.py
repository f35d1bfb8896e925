"""The volume (tick, row, column) of what is expected: fixed hazards, and movers rolled out by the rules.

Risk and preferences enter as further terms beside `fixed` and the slices.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from sim.fast_replace import fast_constructor
from sim.forecast.rollout import RollOut
from sim.perceive import Percept
from sim.rules.dynamics import Dynamics
from sim.rules.dynamics_registry import dynamics_on
from sim.rules.ego_step import Steps
from sim.types import Move
from sim.world.grid import Board, Road


class StepVerdict(StrEnum):
    """What is to be expected of a step into a cell, and through what."""

    FREE = "free"
    OFF_ROAD = "off_road"
    POTHOLE = "pothole"
    BARRIER = "barrier"
    DISABLED_MOVER = "disabled_mover"
    MOVER_STAYS = "mover_stays"
    MOVER_ENTERS = "mover_enters"
    MOVER_SWAPS = "mover_swaps"
    MOVER_CROSSES = "mover_crosses"
    """a mover cuts off a diagonal: from that side it enters the vehicle's cell or the one straight ahead"""

    @property
    def blocks(self) -> bool:
        """Whether the step would end in a collision or off the road."""
        return self is not StepVerdict.FREE


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
    dynamics: Dynamics
    """how the vehicle moves, and what its steps sweep"""
    hazards: Mapping[int, str]
    slices: RollOut

    @property
    def fixed(self) -> Board:
        """Every pothole and barrier."""
        return self.potholes | self.barriers

    def blocked(self, ahead: int = 0) -> Board:
        """Every cell that anything stands in, `ahead` + 1 ticks from now."""
        return self.fixed | self.slices[ahead].occupied

    @property
    def standing(self) -> Forecast | None:
        """What to expect if the vehicle stays now and a mover brakes for it; None where none would."""
        slices = self.slices.if_standing()
        return None if slices is None else replace(self, slices=slices)

    def after(self, move: Move) -> Forecast:
        """The forecast that holds once the vehicle has made this move now."""
        return self.standing or self if move is Move.STAY else self

    def spread(self, start: Board, ahead: int = 0) -> Board:
        """Every cell a vehicle in any cell of `start` may be in one tick later, `ahead` ticks from now.

        Nobody brakes: `standing` is the forecast for a vehicle that stays where it would be hit.
        """
        right, left, came_right, came_left = self.slices[ahead]
        blocked = self.potholes | self.barriers | right | left
        return self.dynamics.spread(start, blocked, came_right, came_left)

    def spread_back(self, end: Board, ahead: int = 0) -> Board:
        """Every cell from which one move, made `ahead` ticks from now, leads into a cell of `end`.

        The cells of `end` are taken to be free.
        """
        right, left, came_right, came_left = self.slices[ahead]
        blocked = self.potholes | self.barriers | right | left
        return self.dynamics.spread_back(end, blocked, came_right, came_left)

    def steps(self, start: Board, ahead: int = 0) -> Steps:
        """Where vehicles in `start` may be one tick later, `ahead` ticks from now. Nobody brakes."""
        right, left, came_right, came_left = self.slices[ahead]
        blocked = self.potholes | self.barriers | right | left
        return self.dynamics.steps(start, blocked, came_right, came_left)

    def own_steps(self) -> Steps:
        """Where the forecast's own vehicle may be after the coming tick; a mover may brake for it."""
        start = 1 << self.ego
        found = self.steps(start)
        if not found.stay and (standing := self.standing) is not None:
            return found._replace(stay=standing.steps(start).stay)
        return found

    def check_step(self, start: int, end: int | None, ahead: int = 0) -> tuple[StepVerdict, tuple[str, ...]]:
        """What a step from `start` to `end` meets, `ahead` ticks from now, and the ids of who is met.

        Cell indices; `end` None means off the road. All who block are named, not the first.
        """
        if end is None:
            return StepVerdict.OFF_ROAD, ()
        if start == end == self.ego and ahead == 0 and (standing := self.standing) is not None:
            return standing.check_step(start, end)
        motion = self.slices[ahead]
        swept = self.dynamics.swept(start, end)
        verdict = StepVerdict.FREE
        who: tuple[str, ...] = ()
        passed = None
        if swept.from_left:
            passed = [cell for cell in swept.from_left if motion.came_right >> cell & 1]
        if swept.from_right:
            passed = [cell for cell in swept.from_right if motion.came_left >> cell & 1] + (passed or [])
        if passed:
            aside = passed == [start] and start // self.road.columns == end // self.road.columns
            verdict = StepVerdict.MOVER_SWAPS if aside else StepVerdict.MOVER_CROSSES
            who = tuple(self.slices.movers(ahead)[cell] for cell in passed)
        for cell in swept.cells:
            bit = 1 << cell
            if bit & (motion.right | motion.left):
                who = (self.slices.movers(ahead)[cell], *who)
                if bit & self.disabled:
                    verdict = StepVerdict.DISABLED_MOVER
                elif bit & (motion.came_right | motion.came_left):
                    verdict = StepVerdict.MOVER_ENTERS
                else:
                    verdict = StepVerdict.MOVER_STAYS
            if bit & (self.potholes | self.barriers):
                who = (self.hazards[cell], *who)
                if not bit & self.disabled:
                    verdict = StepVerdict.POTHOLE if bit & self.potholes else StepVerdict.BARRIER
        return verdict, who

    def will_be_free(self, start: int, end: int | None, ahead: int = 0) -> bool:
        """Whether a step meets nothing."""
        return not self.check_step(start, end, ahead)[0].blocks


_expected = fast_constructor(
    Forecast,
    "road",
    "tick",
    "episode_tick",
    "ego",
    "ego_id",
    "potholes",
    "barriers",
    "disabled",
    "dynamics",
    "hazards",
    "slices",
)


def predict(percept: Percept, horizon: int) -> Forecast:
    """What to expect of the next `horizon` ticks (at least one)."""
    road = percept.road
    return _expected(
        road,
        percept.tick,
        percept.episode_tick,
        percept.ego,
        percept.ego_id,
        percept.potholes,
        percept.barriers,
        (percept.right | percept.left) & percept.potholes,
        dynamics_on(road, percept.dynamics, percept.swept),
        percept.hazards,
        RollOut(percept, horizon),
    )
