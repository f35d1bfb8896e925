"""Running one decision again with something otherwise, remembering what was run.

There are two kinds of intervention. One is on what is *seen*: something had not been detected, all else as
it is. The other is on what *is*: something had never been there, or a person had changed the road first; then
the sensor looks again, with the belief it had. With perfect sight both come to the same.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sim.actions import Add, Where, WorldAction
from sim.config import Config
from sim.decide import decide_on, sense
from sim.explain.factors import factors, is_factor, removal, without
from sim.explain.facts import Counterfactual, QuestionError
from sim.perceive import Percept, sensor_named
from sim.plan import Decision
from sim.session.edits import apply
from sim.state import SimState
from sim.types import Cell, Move
from sim.world import Thing, World


def wall(world: World, cell: Cell) -> Add:
    """What blocks a cell: a barrier, or where a mover is just leaving it, a pothole that holds it there."""
    held = world.moving >> world.road.index(cell) & 1
    return Add(kind="pothole" if held else "barrier", count=1, where=Where(cell=cell))


class Intervention:
    """Decisions of one moment that differ from its own by what is seen, by what there is, or by wishes."""

    def __init__(self, state: SimState, decision: Decision) -> None:
        """A moment in which a decision is taken (not while a result stands), and that decision."""
        self.state = state
        self.decision = decision
        self.percept = sense(state)[0]
        """what was seen when it was taken"""
        self.faithful = sensor_named(state.config.sensor).faithful
        self.factors = factors(state.config)
        self.count = 0
        self._known: dict[tuple[str, frozenset[str]], Move] = {}

    def without(self, names: Iterable[str]) -> Move:
        """The move had these things not been detected, or these wishes never been said."""
        key = ("without", frozenset(names))
        if key not in self._known:
            self._known[key] = self.decision_without(key[1]).move
        return self._known[key]

    def keeping(self, names: Iterable[str]) -> Move:
        """The move had nothing but these been detected."""
        key = ("keeping", frozenset(names))
        if key not in self._known:
            gone = [name for name in self.factors if name not in key[1]]
            config = without(self.state.config, gone) if gone else self.state.config
            self._known[key] = self._decide(self._with(config), self.percept.keeping(_things(key[1]))).move
        return self._known[key]

    def decision_without(self, names: Iterable[str]) -> Decision:
        """The whole decision had these not been detected."""
        names = frozenset(names)
        state = self._with(without(self.state.config, names))
        return self._decide(state, self.percept.without(_things(names)))

    def never_there(self, names: Iterable[str]) -> Move:
        """The move had these never been there: neither on the road nor in what is seen or remembered."""
        if self.faithful:
            return self.without(names)
        key = ("never_there", frozenset(names))
        if key not in self._known:
            gone = _things(key[1])
            state = self._with(without(self.state.config, key[1]), self.state.world.without(gone))
            self._known[key] = self._decide(state, sense(state)[0].without(gone)).move
        return self._known[key]

    def only_there(self, names: Iterable[str]) -> Move:
        """The move had nothing but these been there."""
        if self.faithful:
            return self.keeping(names)
        key = ("only_there", frozenset(names))
        if key not in self._known:
            kept = _things(key[1])
            gone = (name for name in self.factors if name not in key[1])
            state = self._with(without(self.state.config, gone), self.state.world.keeping(kept))
            self._known[key] = self._decide(state, sense(state)[0].keeping(kept)).move
        return self._known[key]

    def after(self, change: Iterable[WorldAction], undetected: Iterable[str] = ()) -> Move:
        """The move had a person made this change first, and had these not been detected then.

        Raises `EditError` for a change that cannot be made, such as on a cell with something not seen.
        """
        state = self.state
        for action in change:
            state = apply(state, action).state
        percept, gone = sense(state)[0], frozenset(undetected)
        return self._decide(state, percept.without(gone) if gone else percept).move

    def counterfactual(self, names: Iterable[str], move: Move) -> Counterfactual:
        """The least intervention that takes these away and leads to `move`, as taking them away does.

        It is a change of the road where one does the same; what is not there can only not be detected.
        """
        names = tuple(names)
        change = removal(names, self.state.config)
        if self.faithful:
            return Counterfactual(change, move, names)
        things = [name for name in names if not is_factor(name)]
        phantoms = [name for name in things if self.state.world.index_of(name) is None]
        change = self.removal(names)
        for undetected in (phantoms, things):
            if self.after(change, undetected) is move:
                return Counterfactual(change, move, names, tuple(undetected))
        change = removal([name for name in names if is_factor(name)], self.state.config)
        return Counterfactual(change, move, names, tuple(things))

    def removal(self, names: Iterable[str]) -> tuple[WorldAction, ...]:
        """The actions that take these away, as far as they are there."""
        world = self.state.world
        there = (name for name in names if is_factor(name) or world.index_of(name) is not None)
        return removal(there, self.state.config)

    def phantoms(self, names: Iterable[str]) -> tuple[str, ...]:
        """Those of these things that are not there."""
        if self.faithful:
            return ()
        world = self.state.world
        return tuple(name for name in names if not is_factor(name) and world.index_of(name) is None)

    def seen(self, name: str) -> tuple[Thing, bool] | None:
        """A thing as it was seen, and whether it was there; a thing that was not seen, as it was."""
        seen = self.percept.find(name)
        if self.faithful and seen is not None:
            return seen, True
        there = self.state.world.find(name)
        if seen is None:
            return None if there is None else (there, True)
        return seen, there is not None and (there.kind, there.cell) == (seen.kind, seen.cell)

    def _with(self, config: Config, world: World | None = None) -> SimState:
        state = self.state
        if world is None:
            return state if config is state.config else replace(state, config=config)
        return replace(state, world=world, config=config)

    def _decide(self, state: SimState, percept: Percept) -> Decision:
        self.count += 1
        decision = decide_on(state, percept)
        if decision.timed_out:  # nothing is proved by an answer that did not come
            raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
        return decision


def _things(names: Iterable[str]) -> frozenset[str]:
    return frozenset(name for name in names if not is_factor(name))
