"""The volume (tick, row, column) of what is expected: fixed hazards, and movers rolled out by the rules.

Risk and preferences enter as further terms beside `fixed` and the slices.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.forecast.rollout import RollOut
from sim.perceive import Percept, perceive_truth
from sim.rules.traffic import Steps, free_steps, spread, spread_back, swap_conflicts
from sim.types import HAZARDS, Kind, Move
from sim.world import World
from sim.world.boards import Boards
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


_VERDICTS = {kind: StepVerdict(kind) for kind in HAZARDS}


@dataclass(frozen=True, slots=True)
class Forecast:
    """`slices[k]` is expected k + 1 ticks from now; fixed hazards hold throughout."""

    road: Road
    tick: int
    episode_tick: int
    ego: int
    ego_id: str
    boards: Boards
    """which cells hold what kind of thing now"""
    disabled: Board
    swept: bool
    """whether bodies collide by what they sweep within a tick"""
    hazards: Mapping[int, str]
    slices: RollOut

    @staticmethod
    def of_truth(world: World, config: Config, horizon: int, ego: int = 0) -> Forecast:
        """What follows from what *is*, whatever the sensors show: the ground of every proof.

        `horizon` is in ticks, at least one; `ego` numbers the autonomous vehicles from 0.
        """
        return predict(perceive_truth(world, config, ego), horizon)

    @property
    def potholes(self) -> Board:
        """The cells of potholes."""
        return self.boards[Kind.POTHOLE]

    @property
    def barriers(self) -> Board:
        """The cells of barriers."""
        return self.boards[Kind.BARRIER]

    @property
    def percept(self) -> Percept:
        """What the forecast was made from: headings, pedestrians, ids, and all else that is seen."""
        return self.slices.percept

    @property
    def fixed(self) -> Board:
        """Everything that does not move."""
        return self.boards.fixed

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

    def cut_off(self, ahead: int = 0) -> tuple[Board, Board]:
        """The cells straight ahead of vehicles whose diagonal to the left, or to the right, is cut off."""
        if not self.swept:
            return 0, 0
        _, _, came_right, came_left = self.slices[ahead]
        columns = self.road.columns
        return came_right | came_right >> columns, came_left | came_left >> columns

    def spread(self, start: Board, ahead: int = 0) -> Board:
        """Every cell a vehicle in any cell of `start` may be in one tick later, `ahead` ticks from now.

        Nobody brakes: `standing` is the forecast for a vehicle that stays where it would be hit.
        """
        road = self.road
        right, left, came_right, came_left = self.slices[ahead]
        return spread(
            start,
            start >> road.columns,
            self.boards.fixed | right | left,
            came_right,
            came_left,
            *self.cut_off(ahead),
            road.left_edge,
            road.right_edge,
        )

    def spread_back(self, end: Board, ahead: int = 0) -> Board:
        """Every cell from which one move, made `ahead` ticks from now, leads into a cell of `end`.

        The cells of `end` are taken to be free.
        """
        road = self.road
        _, _, came_right, came_left = self.slices[ahead]
        beside, on = spread_back(
            end, came_right, came_left, *self.cut_off(ahead), road.left_edge, road.right_edge
        )
        return beside | on << road.columns & road.all

    def steps(self, start: Board, ahead: int = 0) -> Steps:
        """Where vehicles in `start` may be one tick later, `ahead` ticks from now. Nobody brakes."""
        road = self.road
        right, left, came_right, came_left = self.slices[ahead]
        return free_steps(
            start,
            start >> road.columns,
            self.boards.fixed | right | left,
            came_right,
            came_left,
            *self.cut_off(ahead),
            road.left_edge,
            road.right_edge,
        )

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
        right, left, came_right, came_left = self.slices[ahead]
        bit = 1 << end
        verdict = StepVerdict.FREE
        who: tuple[str, ...] = ()
        if swap_conflicts(1 << start, bit, came_right, came_left):
            verdict, who = StepVerdict.MOVER_SWAPS, (self.slices.movers(ahead)[start],)
        elif crossing := self._crossing(start, end, ahead):
            verdict, who = (
                StepVerdict.MOVER_CROSSES,
                tuple(self.slices.movers(ahead)[cell] for cell in crossing),
            )
        if bit & (right | left):
            who = (self.slices.movers(ahead)[end], *who)
            if bit & self.disabled:
                verdict = StepVerdict.DISABLED_MOVER
            elif bit & (came_right | came_left):
                verdict = StepVerdict.MOVER_ENTERS
            else:
                verdict = StepVerdict.MOVER_STAYS
        if bit & self.boards.fixed:
            who = (self.hazards[end], *who)
            if not bit & self.disabled:
                verdict = _VERDICTS[self.boards.fixed_kind(end)]
        return verdict, who

    def _crossing(self, start: int, end: int, ahead: int) -> tuple[int, ...]:
        """The cells of the movers that cut off a diagonal, after the tick; empty for any other step."""
        on = start - self.road.columns
        if not self.swept or end not in (on - 1, on + 1):
            return ()
        motion = self.slices[ahead]
        came = motion.came_right if end < on else motion.came_left
        return tuple(cell for cell in (on, start) if came >> cell & 1)

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
    "boards",
    "disabled",
    "swept",
    "hazards",
    "slices",
)


def predict(percept: Percept, horizon: int) -> Forecast:
    """What to expect of the next `horizon` ticks (at least one)."""
    boards = percept.boards
    return _expected(
        percept.road,
        percept.tick,
        percept.episode_tick,
        percept.ego,
        percept.ego_id,
        boards,
        (percept.right | percept.left) & boards.holding,
        percept.swept,
        percept.hazards,
        RollOut(percept, horizon),
    )
