"""The ways that a planner searched in the ticks of a drive, and what of each was left in the next tick.

Each tick is decided anew, as it was then, by the planner that drove. Of ways that cost the same, the one is
planned whose moves come first in the order of `Move`, tick by tick, as the planners choose. A way is kept as
long as what is left of it is still free, still as good as any, and begins with the move that is decided.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Final, Literal

from sim.decide import decide, sense
from sim.explain.foresight import driving
from sim.explain.moments import state_at
from sim.explain.past import MOST_TICKS
from sim.explain.planners import planner_of
from sim.explain.question_error import QuestionError
from sim.forecast import Forecast, predict
from sim.plan import Decision
from sim.plan.safe_planning import is_foreign
from sim.search.astar import AdaptiveHeuristic, cheapest
from sim.search.costs import TICKS_ALONE, Weights, weights
from sim.search.reachability import steps_left
from sim.search.time_expanded import TimeExpandedGraph
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import MOVES, Cell, Move, Outcome

Why = Literal["blocked", "dearer", "better", "as_good", "by_person", "elsewhere", "planner", "no_way", "way"]
"""Why a way was given up.

`blocked`: something is expected in it; `dearer`: it costs more than it did; `better`: another one has come to
cost less; `as_good`: another one costs the same and begins with the move that is preferred; `by_person`: a
person made another move; `elsewhere`: the ego is not where the move should have led; `planner`: another
planner, or the same with other settings; `no_way`: none leads on any more; `way`: one leads on again.
"""

COSTS: Final = ("astar", "dijkstra")
"""The planners that weigh charges; `bfs` counts ticks alone."""
SEARCHING: Final = (*COSTS, "bfs")
"""The planners that search whole ways; the others of the project plan the coming move alone."""


@dataclass(frozen=True, slots=True)
class Way:
    """The way that was planned at a tick, or what is left of it."""

    tick: int
    start: Cell
    moves: tuple[Move, ...]
    cells: tuple[Cell, ...]
    """where each move leads"""
    costs: tuple[int, ...]
    """what each move costs; empty of a planner that searches no ways"""

    @property
    def cost(self) -> int:
        """To the goal."""
        return sum(self.costs)

    @property
    def rest(self) -> Way:
        """What is left after its first move."""
        return Way(self.tick + 1, self.cells[0], self.moves[1:], self.cells[1:], self.costs[1:])


@dataclass(frozen=True, slots=True)
class PlanChange:
    """A tick in which what was left of the way of the tick before was given up."""

    state: SimState
    why: Why
    by: str | None
    """id of what is expected in the way, where `why` is `blocked` and one thing is"""
    cells: int
    """cells of the coming ticks that differ from those planned before"""
    lanes: int
    """how many lanes the two are apart at most, at one tick"""
    later: int
    """ticks that the goal is reached later than planned before; 0 where no way leads there"""

    @property
    def tick(self) -> int:
        """When."""
        return self.state.world.tick


@dataclass(frozen=True, slots=True)
class PlanCourse:
    """The ways of a drive."""

    planner: str
    """of the latest decision"""
    searching: bool
    """whether that searches ways; if not, there are no changes"""
    first: int
    """the tick from which on it did"""
    decisions: int
    """how many were looked at"""
    changes: tuple[PlanChange, ...]
    turns: int
    """moves that were made other than the one before"""

    @property
    def biggest(self) -> PlanChange | None:
        """The change with the most other cells; of equals the earliest."""
        return max(self.changes, key=lambda each: (each.cells, each.lanes), default=None)


@dataclass(frozen=True, slots=True)
class WayThen:
    """The way that was planned at a tick, and how long it was held on to."""

    state: SimState
    planner: str
    searching: bool
    way: Way | None
    """None where none leads to the goal"""
    kept: int
    """how many of its moves were made, in their order, from then on"""
    left: bool
    """whether the next move was another one"""
    ended: bool
    """whether the drive ended before all of them were made"""


def way_then(timeline: Timeline, tick: int | None = None) -> WayThen:
    """The way that was planned at a tick, by default at the latest at which anything is decided.

    Raises `QuestionError`: `no_such_tick`; `result_stood` where nothing was decided; `no_answer`.
    """
    world = timeline.state.world
    if tick is None and world.outcome is not Outcome.RUNNING and world.ended is not None:
        tick = max(world.episode_start, world.ended - 1)
    state = state_at(timeline, tick)
    if state.world.outcome is not Outcome.RUNNING:
        raise QuestionError("result_stood", tick=state.world.tick, outcome=state.world.outcome)
    name, at = planner_of(state), state.world.tick
    if name in SEARCHING:
        way = _Tick(state, _decided(state)).way()
    else:
        decision = timeline.decided(state) if is_foreign(name) else _decided(state)
        assert decision is not None
        cell = decision.chosen.cell
        way = Way(
            at, state.world.road.cell(state.world.av), (decision.move,), () if cell is None else (cell,), ()
        )
    made = []
    for each in timeline.between(at, timeline.tick):
        if each.world.outcome is not Outcome.RUNNING or each.world.episode_start != state.world.episode_start:
            break
        known = timeline.decided(each)
        if known is not None:
            made.append(known.move)
    planned = () if way is None else way.moves
    pairs = zip(planned, made, strict=False)
    left = next((count for count, (one, other) in enumerate(pairs) if one is not other), None)
    most = min(len(planned), len(made))
    over = at + len(made) < timeline.tick or world.outcome is not Outcome.RUNNING
    ended = left is None and most < len(planned) and over
    kept = most if left is None else left
    return WayThen(state, name, name in SEARCHING, way, kept, left is not None, ended)


def plan_course(timeline: Timeline) -> PlanCourse:
    """The ways of the present drive, and when they were changed. Raises `QuestionError`.

    `too_long`; `nothing_yet` before the first move; `no_answer` where a planner fails.
    """
    world = timeline.state.world
    first, last = world.episode_start, timeline.tick if world.ended is None else world.ended
    if last - first > MOST_TICKS:
        raise QuestionError("too_long", ticks=last - first, most=MOST_TICKS)
    states = [each for each in timeline.between(first, last + 1) if each.world.outcome is Outcome.RUNNING]
    if last == first:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    decided = [timeline.decided(each) for each in states]
    made = [each.move for each in decided[: last - first] if each is not None]
    turns = sum(one is not other for one, other in pairwise(made))
    names = [planner_of(each) for each in states]
    since = next((at + 1 for at in range(len(names) - 1, -1, -1) if names[at] not in SEARCHING), 0)
    if since == len(names):
        return PlanCourse(names[-1], False, first, len(made), (), turns)
    changes = tuple(_changes(states[since:], decided[since:]))
    return PlanCourse(names[-1], True, first + since, len(names) - since, changes, turns)


def _changes(states: Sequence[SimState], decided: Sequence[Decision | None]) -> Iterator[PlanChange]:
    """Tick by tick: what was left of the way, and the new one where that was given up."""
    way: Way | None = None
    before: tuple[str, bool] | None = None
    for state, decision in zip(states, decided, strict=True):
        here, name = _Tick(state, _decided(state)), planner_of(state)
        rest = None if way is None or len(way.moves) < 2 else way.rest
        if before is None:
            way = here.way()
        elif rest is None:
            had, way = way, here.way()
            if had is None and way is not None:
                yield _change(state, "way", None, None, way)
        else:
            why, by = here.judge(rest, by_person=before[1])
            new = here.kept(rest) if why is None else here.way()
            if why is not None:
                other = "planner" if name != before[0] and why not in ("blocked", "by_person") else why
                yield _change(state, "no_way" if new is None else other, by, rest, new)
            way = new
        before = name, decision is not None and decision.asked is not None


def _change(state: SimState, why: Why, by: str | None, rest: Way | None, new: Way | None) -> PlanChange:
    old, now = () if rest is None else rest.cells, () if new is None else new.cells
    apart = [abs(one[0] - other[0]) for one, other in zip(old, now, strict=False)]
    cells = sum(one != other for one, other in zip(old, now, strict=False)) + abs(len(old) - len(now))
    later = len(now) - len(old) if rest is not None and new is not None else 0
    return PlanChange(state, why, by, cells, max(apart, default=0), later)


def _decided(state: SimState) -> Decision:
    """What the planner decides by itself in a state. Raises `QuestionError`: `no_answer`."""
    decision = decide(driving(state))
    assert decision is not None
    if decision.fault is not None:
        raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
    return decision


@dataclass(slots=True)
class _Tick:
    """A state, and what the planner that searches ways decides in it."""

    state: SimState
    decision: Decision
    _terrains: list[TimeExpandedGraph] = field(init=False, default_factory=list)
    _forecast: Forecast = field(init=False)

    def __post_init__(self) -> None:
        config, percept = self.state.config_of(None), sense(self.state)[0]
        forecast, limit = predict(percept, config.max_ticks + 1), steps_left(config, percept.episode_tick)
        charges: Weights = weights(config) if planner_of(self.state) in COSTS else TICKS_ALONE
        self._terrains.append(TimeExpandedGraph(forecast, charges, limit))
        self._forecast = forecast
        # Where the ego may stay only because somebody brakes for it, the way on is another forecast's.
        standing = forecast.standing
        if standing is not None:
            self._terrains.append(TimeExpandedGraph(standing, charges, limit))

    def way(self) -> Way | None:
        """The move that is decided, and the cheapest way on whose moves come first."""
        if self.decision.chosen.cost is None:
            return None
        terrain = self._terrain(self.decision.move)
        at, left = terrain.start, round(self.decision.chosen.cost)
        lessons, found = AdaptiveHeuristic(), []
        wanted: Move | None = self.decision.move
        while left > 0 and not terrain.at_goal(at):
            step = self._next(terrain, at, left, lessons, wanted)
            assert step is not None
            found.append(step)
            at, left, wanted = step[1], left - step[2], None
        return self._way(
            [each[0] for each in found], [each[1] for each in found], [each[2] for each in found]
        )

    def judge(self, rest: Way, *, by_person: bool) -> tuple[Why | None, str | None]:
        """Why what is left of a way is given up, and for what; None where it is held on to."""
        if self.state.world.road.cell(self.state.world.av) != rest.start:
            return "by_person" if by_person else "elsewhere", None
        costs = self._costs(rest)
        if len(costs) < len(rest.moves):
            return "blocked", self._in_the_way(len(costs), rest.cells[len(costs)])
        best = self.decision.chosen.cost
        if best is None or sum(costs) > best:
            return "dearer" if sum(costs) > rest.cost else "better", None
        return (None if self.decision.move is rest.moves[0] else "as_good"), None

    def kept(self, rest: Way) -> Way:
        """The same way with what it costs now."""
        return Way(rest.tick, rest.start, rest.moves, rest.cells, tuple(self._costs(rest)))

    def _costs(self, rest: Way) -> list[int]:
        """What the moves of a way cost now, up to the first that meets anything."""
        terrain = self._terrain(rest.moves[0])
        at, costs = terrain.start, []
        for move in rest.moves:
            step = next((each for each in terrain.steps(at) if MOVES[each[0]] is move), None)
            if step is None:
                break
            at = step[1]
            costs.append(step[2])
        return costs

    def _terrain(self, first: Move) -> TimeExpandedGraph:
        terrain = self._terrains[0]
        if first is not Move.STAY or len(self._terrains) == 1:
            return terrain
        stays = any(MOVES[each[0]] is Move.STAY for each in terrain.steps(terrain.start))
        return terrain if stays else self._terrains[1]

    @staticmethod
    def _next(
        terrain: TimeExpandedGraph, at: int, left: int, lessons: AdaptiveHeuristic, wanted: Move | None
    ) -> tuple[Move, int, int] | None:
        """The first move in their order that leads to the goal at what is left of the cost."""
        for index, there, cost in terrain.steps(at):
            move, rest = MOVES[index], left - cost
            if wanted not in (None, move) or rest < 0 or there in lessons.dead_ends:
                continue
            if not terrain.at_goal(there):
                known = lessons.exact.get(there)
                if known is None:
                    if max(lessons.bounds.get(there, 0), terrain.heuristic(there)) > rest:
                        continue
                    way = cheapest(terrain, there, lessons=lessons)
                    known = None if way is None else way.cost
                if known != rest:
                    continue
            elif rest:
                continue
            return move, there, cost
        return None

    def _way(self, moves: list[Move], states: list[int], costs: list[int]) -> Way:
        road = self.state.world.road
        cells = tuple(road.cell(each % (road.columns * road.rows)) for each in states)
        return Way(self.state.world.tick, road.cell(self.state.world.av), tuple(moves), cells, tuple(costs))

    def _in_the_way(self, ahead: int, cell: Cell) -> str | None:
        """What is expected in a cell at the end of the step `ahead` ticks from now."""
        index = self.state.world.road.index(cell)
        fixed = self._forecast.percept.hazards.get(index)
        return fixed or self._forecast.slices.movers(ahead).get(index)
