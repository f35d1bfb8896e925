"""The futures of a moment where it is left to chance who gives way or brakes: walked in full, or drawn.

The tree of all that may be drawn is walked while it is small, and then the chance of each end is exact; else
futures are drawn from it. Moments from which everything goes on alike are one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import count
from typing import Final, NamedTuple, TypeAlias

from sim.config import Config
from sim.decide import INTO_ANOTHER, decide_on, sense
from sim.explain.compiled_futures import compiled_futures, futures_are_compiled_for
from sim.explain.effort import prepare
from sim.explain.question_error import QuestionError
from sim.forecast import Forecast
from sim.perceive import Belief, sensor_named
from sim.plan import Traits, traits_of
from sim.randomness import Stream
from sim.search.costs import weights
from sim.search.dead_ends import cells_that_may_arrive
from sim.search.reachability import steps_left
from sim.state import FIRST, SimState, StepResult
from sim.transition import step
from sim.types import Mode, Outcome
from sim.world.grid import Board

WALK_SHARE: Final = 2 / 3
"""How much of the work goes into walking the whole tree before futures are drawn instead."""
PROOF_AFTER: Final = 40
"""Decisions of a quick planner after which futures are looked at for whether they are shut off; at once with
any other, whose decision costs as much as the look."""
MAX_FUTURES: Final = 200


End: TypeAlias = tuple[Outcome | None, int]
"""How and how many ticks from now a future ends; None where it is shut off from the goal."""
Ends: TypeAlias = dict[End, float]
"""The chance of each end, or how often it was met."""


class Found(NamedTuple):
    """The ends of the futures of a moment."""

    ends: Ends
    drawn: int | None
    """how many futures were drawn; None where every future was run, and the chances are exact"""
    work: int
    """decisions taken"""
    branched: bool
    """whether anything is left to chance on the way"""


def find_ends(state: SimState, ego: str = FIRST, *, most: int | None = None, seen: bool = True) -> Found:
    """The ends of the futures of an ego, by compiled words where they are loaded for them.

    `most` and `seen`: as in `Futures`. Raises `QuestionError` where a planner does not answer.
    """
    limit = traits_of(state.config_of(ego).planner).decisions_per_answer if most is None else most
    if futures_are_compiled_for(state, ego):
        compiled = compiled_futures(state, limit, PROOF_AFTER, MAX_FUTURES, seen=seen)
        drawn = round(sum(compiled.ends.values())) if compiled.drawn else None
        return Found(compiled.ends, drawn, compiled.work, compiled.branched > 0)
    futures = Futures(state, ego, most=most, seen=seen)
    ends = futures.walked()
    drawn = None
    if ends is None:
        ends = futures.drawn()
        drawn = round(sum(ends.values()))
    return Found(ends, drawn, futures.work, futures.branched > 0)


@dataclass(slots=True)
class Node:
    """A moment of a future; `after` is where it may go, with the chance of each, once that is known."""

    state: SimState
    after: list[tuple[float, Node]] | None = None


@dataclass(slots=True)
class Futures:
    """The tree of futures of a moment, grown where it is looked at."""

    start: SimState
    ego: str = FIRST
    most: int | None = None
    """decisions it may take; None for as many as the planner's traits allow one answer"""
    seen: bool = True
    """whether what is drawn in the first tick is known, as it is to an ego that sees it"""
    work: int = 0
    branched: int = 0
    _nodes: dict[tuple[int, ...], list[Node]] = field(default_factory=dict)
    _root: Node = field(init=False)
    _traits: Traits = field(init=False)
    _known: bool = field(init=False)
    """whether what is decided hangs only on the rows from the ego on"""
    _faithful: bool = field(init=False)
    _buffer: int = field(init=False)
    _number: int = field(init=False)
    """the ego's place in `World.avs`"""
    _several: bool = field(init=False)
    """whether there are other egos, so that what lies behind this one may matter to them"""
    _leading_on: list[Board] | None = None
    _unlike: Config = field(init=False)
    """the configuration for ticks that are drawn one unlike the other"""

    def __post_init__(self) -> None:
        prepare(self.start)
        config = self.start.config
        self._root = Node(self.start.with_ego(self.ego, mode=Mode.AUTO))
        self._number = self.start.number(self.ego)
        self._several = len(self.start.world.avs) > 1
        # Sensors may show anything, but for those that show the truth.
        self._traits = traits_of(self.start.config_of(self.ego).planner)
        self._faithful = sensor_named(config.sensor).faithful
        self._known = self._traits.forward_only and self._faithful and not self._several
        self._buffer = weights(config).buffer if self._traits.weighs_costs else 0
        # A tick that is drawn to be certain proves nothing about those that come again.
        self._unlike = config.with_parts(repetition=config.repetition and config.certain)

    def walked(self, within: int | None = None) -> Ends | None:
        """The chance of each end, by outcome and ticks from now; None if the tree is too large to walk.

        `within`: ticks after which a future is followed no further, and counts as running.
        """
        ends: Ends = {}
        layer: dict[int, tuple[Node, float]] = {id(self._root): (self._root, 1.0)}
        if (shut := self._end(self._root)) is not None:
            return {shut: 1.0}
        while layer:
            after: dict[int, tuple[Node, float]] = {}
            for node, mass in layer.values():
                if self.branched and self.work >= WALK_SHARE * self._limit:
                    return None
                for chance, then in self._after(node):
                    end = self._end(then, within)
                    if end is not None:
                        ends[end] = ends.get(end, 0.0) + mass * chance
                    else:
                        _, before = after.get(id(then), (then, 0.0))
                        after[id(then)] = then, before + mass * chance
            layer = after
        return ends

    def drawn(self, within: int | None = None) -> Ends:
        """How often each end was met, by outcome and ticks from now, in futures drawn by chance.

        Whether one more is drawn does not hang on how long it would be, so that short ones are not favoured.
        """
        world = self.start.world
        stream = Stream.of(self.start.config.seed, "confidence", world.episode, world.episode_tick)
        ends: Ends = {}
        limit = self.work + (1.0 - WALK_SHARE) * self._limit
        for number in range(MAX_FUTURES):
            if self.work >= limit:
                break
            node, draws, step = self._root, stream.narrow(number), count()
            while (end := self._end(node, within)) is None:
                node = _pick(self._after(node), draws.uniform(next(step)))
            ends[end] = ends.get(end, 0.0) + 1.0
        return ends

    def places(self, within: int) -> tuple[dict[int | None, float], int | None]:
        """The chance of each cell that the ego is in after so many ticks; None: it has ended before.

        Beside them how many futures were drawn, or None where all were walked and the chances are exact.
        """
        layer: dict[int, tuple[Node, float]] = {id(self._root): (self._root, 1.0)}
        found: dict[int | None, float] = {}
        for _ in range(within):
            after: dict[int, tuple[Node, float]] = {}
            for node, mass in layer.values():
                if self.branched and self.work >= WALK_SHARE * self._limit:
                    return self._places_drawn(within)
                for chance, then in self._after(node):
                    if then.state.world.outcome is not Outcome.RUNNING:
                        found[None] = found.get(None, 0.0) + mass * chance
                        continue
                    _, before = after.get(id(then), (then, 0.0))
                    after[id(then)] = then, before + mass * chance
            layer = after
        for node, mass in layer.values():
            cell = node.state.world.avs[self._number]
            found[cell] = found.get(cell, 0.0) + mass
        return found, None

    def _places_drawn(self, within: int) -> tuple[dict[int | None, float], int]:
        world = self.start.world
        stream = Stream.of(self.start.config.seed, "confidence", world.episode, world.episode_tick)
        counts: dict[int | None, int] = {}
        limit = self.work + (1.0 - WALK_SHARE) * self._limit
        for number in range(MAX_FUTURES):
            if self.work >= limit and counts:
                break
            node, draws = self._root, stream.narrow(number)
            cell: int | None = world.avs[self._number]
            for draw in range(within):
                node = _pick(self._after(node), draws.uniform(draw))
                cell = node.state.world.avs[self._number]
                if node.state.world.outcome is not Outcome.RUNNING:
                    cell = None
                    break
            counts[cell] = counts.get(cell, 0) + 1
        total = sum(counts.values())
        return {each: count / total for each, count in counts.items()}, total

    @property
    def _limit(self) -> int:
        return self._traits.decisions_per_answer if self.most is None else self.most

    def _end(self, node: Node, within: int | None = None) -> End | None:
        world = node.state.world
        ticks = world.tick - self.start.world.tick
        if within is not None and ticks >= within and world.outcome is Outcome.RUNNING:
            return Outcome.RUNNING, ticks
        if self._several and world.avs[self._number] < world.road.columns:
            return (Outcome.CRASH if world.outcome is Outcome.CRASH else Outcome.SUCCESS), ticks
        if world.outcome is not Outcome.RUNNING:
            # Where others have arrived the episode is over, and this ego has not.
            return (
                Outcome.STUCK if world.outcome is Outcome.SUCCESS and self._several else world.outcome
            ), ticks
        if self._several:
            return None  # what is shut off depends on the other egos
        if self._traits.quick and self.work < PROOF_AFTER:
            return None  # most are done by now, and the proof would cost more than they did
        if self._leading_on is None:
            self._leading_on = _hopeful(self.start)
        return None if self._leading_on[ticks] >> world.av & 1 else (None, ticks)

    def _after(self, node: Node) -> list[tuple[float, Node]]:
        if node.after is None:
            known = self.seen and node is self._root
            ways = [(1.0, self.start.config)] if known else list(self._ways(node.state))
            if share := self.start.config.slips:
                # Whether a move slips is seen by nobody; what it is drawn to be, these draw for sure.
                ways = [
                    (chance * part, config.with_parts(slip_probability=float(slips)))
                    for chance, config in ways
                    for slips, part in ((False, 1.0 - share), (True, share))
                    if part
                ]
            self.branched += len(ways) > 1
            node.after = [(chance, self._step(node.state, config)) for chance, config in ways]
        return node.after

    def _ways(self, state: SimState) -> Iterator[tuple[float, Config]]:
        """What may be drawn in the coming tick: the chance of it, and a configuration that draws it.

        What makes no difference to where anything goes is one way. The tick that comes next is seen already,
        which is why the root has no ways to choose from.
        """
        world, config = state.world, state.config
        behaviour = config.mover_behaviour
        possible = behaviour.possible_reactions(world, config)
        if len(possible) == 1:
            yield 1.0, config
            return
        ways: dict[object, tuple[float, Config]] = {}
        for drawn, chance in possible:
            drawing = behaviour.drawing(world, self._unlike, drawn)
            if self._known:
                forecast = Forecast.of_truth(world, drawing, 1)
                standing = forecast.standing
                key: object = forecast.slices[0], None if standing is None else standing.slices[0]
            else:
                key = drawn
            before, first = ways.get(key, (0.0, drawing))
            ways[key] = before + chance, first
        yield from (way for way in ways.values() if way[0] > 0.0)

    def _step(self, state: SimState, config: Config) -> Node:
        self.work += 1
        tick, belief = self._taken(state, config)
        for each in tick.steps.values():
            if each.decision.fault not in (None, INTO_ANOTHER):
                # It may answer the next time, or cost a new process each time: neither is to be built upon.
                raise QuestionError(
                    "confidence_fault", planner=each.decision.planner, fault=each.decision.fault
                )
        after = replace(tick.state, config=self.start.config)
        if belief != after.belief:
            after = after.with_ego(belief=belief)
        alike = self._nodes.setdefault(self._key(after), [])
        beliefs = [each.belief for each in after.egos.values()]
        for node in alike:
            if [each.belief for each in node.state.egos.values()] == beliefs:
                return node
        alike.append(Node(after))
        return alike[-1]

    def _taken(self, state: SimState, config: Config) -> tuple[StepResult, Belief]:
        """A tick in which movers react as this configuration draws it, and the belief after it.

        The draws of a sensor are the session's own, not those of the seed that has these movers react; but of
        several egos each looks anew.
        """
        drawn = replace(state, config=config)
        if self._faithful or self._several or config is self.start.config:
            tick = step(drawn)
            return tick, tick.state.belief
        percept, belief = sense(state)
        moving = percept.right | percept.left
        drawing = config.mover_behaviour.reactions(state.world, config)
        seen = replace(percept, yielding=drawing.yielding & moving, attentive=drawing.attentive & moving)
        return step(drawn, {FIRST: decide_on(drawn, seen)}), belief

    def _key(self, state: SimState) -> tuple[int, ...]:
        """Equal for moments from which everything goes on alike, where their beliefs are equal too."""
        world = state.world
        ahead = world.road.all
        if self._known:
            rows = world.road.cell(world.av)[1] + 1 + self._buffer
            ahead = (1 << min(rows, world.road.rows) * world.road.columns) - 1
        boards = (world.right, world.left, *world.boards.marked)
        return (
            world.tick,
            tuple(Outcome).index(world.outcome),
            *world.avs,
            *(board & ahead for board in boards),
        )


def _hopeful(state: SimState) -> list[Board]:
    """The cells from which the goal may still be reached in time, by ticks from now."""
    limit = steps_left(state.config, state.world.episode_tick)
    return cells_that_may_arrive(Forecast.of_truth(state.world, state.config, max(1, limit)), limit)


def _pick(ways: list[tuple[float, Node]], draw: float) -> Node:
    """The way on which a draw from [0, 1) falls."""
    for chance, node in ways:
        if draw < chance:
            return node
        draw -= chance
    return ways[-1][1]
