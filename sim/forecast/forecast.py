"""The volume (tick, row, column) of what is expected: fixed hazards, and movers rolled out by the rules."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from sim.config import Config
from sim.fast_replace import fast_constructor, field_setter
from sim.forecast.mover_rollout import RollOut, other_end
from sim.perceive import OtherEgo, Percept, perceive_truth
from sim.rules.dynamics import Dynamics
from sim.rules.dynamics_registry import dynamics_on
from sim.rules.ego_contacts import Denied
from sim.rules.ego_step import Steps
from sim.types import HAZARDS, MOVES, Kind, Move
from sim.world import World
from sim.world.boards import Boards
from sim.world.grid import Board, Road, bits, board_of


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
    """a mover cuts off a diagonal: from that side it enters the ego's cell or the one straight ahead"""
    EGO_ENTERS = "ego_enters"
    EGO_STAYS = "ego_stays"
    EGO_SWAPS = "ego_swaps"
    EGO_CROSSES = "ego_crosses"
    """another ego touches this one on the way, although both end in other cells"""

    @property
    def blocks(self) -> bool:
        """Whether the step would end in a collision or off the road."""
        return self is not StepVerdict.FREE


_VERDICTS: Final = {kind: StepVerdict(kind) for kind in HAZARDS}


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
    dynamics: Dynamics
    """how the ego moves, and what its steps sweep"""
    hazards: Mapping[int, str]
    slices: RollOut
    egos: tuple[OtherEgo, ...] = ()
    """the other egos: they make the move they have announced, and then stand where it leads"""

    @staticmethod
    def of_truth(world: World, config: Config, horizon: int, ego: int = 0) -> Forecast:
        """The forecast from the ground truth, whatever the sensors show; every proof rests on it.

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
        return self.fixed | self.slices[ahead].occupied | (self.slices.standing if self.egos else 0)

    @property
    def parked(self) -> Board:
        """The cells of other egos that stay until a person asks for something."""
        return board_of([other.cell for other in self.egos if other.parked])

    def taken(self, ahead: int = 0) -> Board:
        """The cells that other egos keep this one from entering, `ahead` ticks from now.

        In the first tick: the ends of its own steps that touch another ego. Later: the cells of other egos.
        """
        if not self.egos:
            return 0
        if ahead:
            return self.slices.standing
        ends = [self.dynamics.target(self.ego, move) for move in MOVES if self.meets_ego(move)]
        return board_of([end for end in ends if end is not None])

    def meets_ego(self, move: Move) -> bool:
        """Whether a move in the coming tick would touch another ego."""
        return bool(self.egos) and bool(self._denied()[MOVES.index(move)].starts >> self.ego & 1)

    def _denied(self) -> Sequence[Denied]:
        """For each move, in the order of `Move`, what the other egos deny in the coming tick."""
        found = [self.dynamics.denied(other.cell, other.move) for other in self.egos]
        return [
            Denied(_union(each.starts for each in of_move), _union(each.ends for each in of_move))
            for of_move in zip(*found, strict=True)
        ]

    @property
    def standing(self) -> Forecast | None:
        """What to expect if the ego stays now and a mover brakes for it; None where none would."""
        slices = self.slices.if_standing()
        return None if slices is None else _rolled_out(self, slices)

    def after(self, move: Move) -> Forecast:
        """The forecast that holds once the ego has made this move now."""
        return self.standing or self if move is Move.STAY else self

    def spread(self, start: Board, ahead: int = 0) -> Board:
        """Every cell a vehicle in any cell of `start` may be in one tick later, `ahead` ticks from now.

        Nobody brakes: `standing` is the forecast for a vehicle that stays where it would be hit.
        """
        right, left, came_right, came_left = self.slices[ahead]
        if self.egos:
            if not ahead:
                return _union(self.steps(start))
            right |= self.slices.standing
        return self.dynamics.spread(start, self.boards.fixed | right | left, came_right, came_left)

    def spreads(self, start: Board, first: int, stop: int) -> Iterator[Board]:
        """`spread` again and again, from `first` until before `stop` ticks from now."""
        if self.egos:
            for ahead in range(first, stop):
                start = self.spread(start, ahead)
                yield start
            return
        fixed, slices, spread = self.boards.fixed, self.slices, self.dynamics.spread
        for ahead in range(first, stop):
            right, left, came_right, came_left = slices[ahead]
            start = spread(start, fixed | right | left, came_right, came_left)
            yield start

    def spread_back(self, end: Board, ahead: int = 0) -> Board:
        """Every cell from which one move, made `ahead` ticks from now, leads into a cell of `end`.

        The cells of `end` are taken to be free.
        """
        right, left, came_right, came_left = self.slices[ahead]
        found = self.dynamics.spread_back(end, self.boards.fixed | right | left, came_right, came_left)
        if not self.egos:
            return found
        return board_of([start for start in bits(found) if self.spread(1 << start, ahead) & end])

    def steps(self, start: Board, ahead: int = 0) -> Steps:
        """Where vehicles in `start` may be one tick later, `ahead` ticks from now. Nobody brakes."""
        right, left, came_right, came_left = self.slices[ahead]
        if not self.egos:
            return self.dynamics.steps(start, self.boards.fixed | right | left, came_right, came_left)
        if ahead:
            right |= self.slices.standing
        found = self.dynamics.steps(start, self.boards.fixed | right | left, came_right, came_left)
        return found if ahead else self._without_egos(start, found)

    def _without_egos(self, start: Board, steps: Steps) -> Steps:
        """The steps of the coming tick that touch no other ego."""
        free = []
        for board, (starts, ends) in zip(steps, self._denied(), strict=True):
            # One move leads from different cells to different ones, so bits do not mix.
            free.append(board & ~ends if start & starts else board)
        return Steps(*free)

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
        moving, fixed = right | left, self.boards.fixed
        cells, from_left, from_right = self.dynamics.swept(start, end)
        verdict = StepVerdict.FREE
        who: tuple[str, ...] = ()
        if from_left or from_right:
            passed = [cell for cell in from_right if came_left >> cell & 1]
            passed += [cell for cell in from_left if came_right >> cell & 1]
            if passed:
                aside = passed == [start] and start // self.road.columns == end // self.road.columns
                verdict = StepVerdict.MOVER_SWAPS if aside else StepVerdict.MOVER_CROSSES
                movers = self.slices.movers(ahead)
                who = tuple([movers[cell] for cell in passed])
        for cell in cells:
            bit = 1 << cell
            if bit & moving:
                who = (self.slices.movers(ahead)[cell], *who)
                if bit & self.disabled:
                    verdict = StepVerdict.DISABLED_MOVER
                elif bit & (came_right | came_left):
                    verdict = StepVerdict.MOVER_ENTERS
                else:
                    verdict = StepVerdict.MOVER_STAYS
            if bit & fixed:
                who = (self.hazards[cell], *who)
                if not bit & self.disabled:
                    verdict = _VERDICTS[self.boards.fixed_kind(cell)]
        if self.egos and (others := self._met_egos(start, end, ahead)):
            who = (*who, *(other.id for other in others))
            if verdict is StepVerdict.FREE:
                verdict = self._ego_verdict(start, end, ahead, others[0])
        return verdict, who

    def _met_egos(self, start: int, end: int, ahead: int) -> list[OtherEgo]:
        """The other egos that a step touches, those first that end in the same cell."""
        dynamics = self.dynamics
        if ahead:
            return [other for other in self.egos if other_end(dynamics, other) == end]
        met = [
            other
            for other in self.egos
            if dynamics.egos_touch((start, end), (other.cell, other_end(dynamics, other)))
        ]
        return sorted(met, key=lambda other: other_end(dynamics, other) != end)

    def _ego_verdict(self, start: int, end: int, ahead: int, other: OtherEgo) -> StepVerdict:
        theirs = other_end(self.dynamics, other)
        if theirs == end:
            stays = ahead or other.move is Move.STAY
            return StepVerdict.EGO_STAYS if stays else StepVerdict.EGO_ENTERS
        swaps = other.cell == end and theirs == start
        return StepVerdict.EGO_SWAPS if swaps else StepVerdict.EGO_CROSSES

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
    "dynamics",
    "hazards",
    "slices",
    "egos",
)


_rolled_out = field_setter(Forecast, "slices")


def _union(boards: Iterable[Board]) -> Board:
    board = 0
    for each in boards:
        board |= each
    return board


def predict(percept: Percept, horizon: int) -> Forecast:
    """What to expect of the next `horizon` ticks (at least one)."""
    road, slices = percept.road, RollOut(percept, horizon)
    return _expected(
        road,
        percept.tick,
        percept.episode_tick,
        percept.ego,
        percept.ego_id,
        percept.boards,
        slices.disabled,
        dynamics_on(road, percept.dynamics, percept.swept),
        percept.hazards,
        slices,
        percept.egos,
    )
