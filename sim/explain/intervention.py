"""Running one decision again on a changed road or with other wishes, remembering what was run."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sim.actions import Add, Where, WorldAction
from sim.config import Config
from sim.decide import decide
from sim.explain.factors import factors, is_factor, without
from sim.explain.facts import QuestionError
from sim.plan import Decision
from sim.session.edits import apply
from sim.state import SimState
from sim.types import Cell, Move
from sim.world import World


def wall(world: World, cell: Cell) -> Add:
    """What blocks a cell: a barrier, or where a mover is just leaving it, a pothole that holds it there."""
    held = world.moving >> world.road.index(cell) & 1
    return Add(kind="pothole" if held else "barrier", count=1, where=Where(cell=cell))


class Intervention:
    """Decisions of one moment on roads that differ from its own by what is on them, or with other wishes."""

    def __init__(self, state: SimState, decision: Decision) -> None:
        """A moment in which a decision is taken (not while a result stands), and that decision."""
        self.state = state
        self.decision = decision
        self.factors = factors(decision, state.config)
        self.count = 0
        self._known: dict[tuple[str, frozenset[str]], Move] = {}

    def without(self, names: Iterable[str]) -> Move:
        """The move had these things never been there, or these wishes never been said."""
        key = ("without", frozenset(names))
        if key not in self._known:
            self._known[key] = self.decision_without(key[1]).move
        return self._known[key]

    def keeping(self, names: Iterable[str]) -> Move:
        """The move had nothing but these been there."""
        key = ("keeping", frozenset(names))
        if key not in self._known:
            gone = (name for name in self.factors if name not in key[1])
            world = self.state.world.keeping(frozenset(name for name in key[1] if not is_factor(name)))
            self._known[key] = self._decide(world, without(self.state.config, gone)).move
        return self._known[key]

    def decision_without(self, names: Iterable[str]) -> Decision:
        """The whole decision had these never been there."""
        names = frozenset(names)
        world = self.state.world.without(frozenset(name for name in names if not is_factor(name)))
        return self._decide(world, without(self.state.config, names))

    def after(self, change: Iterable[WorldAction]) -> Move:
        """The move had a person made this change first."""
        state = self.state
        for action in change:
            state = apply(state, action).state
        return self._decide(state.world, state.config).move

    def _decide(self, world: World, config: Config) -> Decision:
        self.count += 1
        decision = decide(replace(self.state, world=world, config=config))
        if decision is None:
            raise ValueError("no decision is taken while a result stands")
        if decision.timed_out:  # nothing is proved by an answer that did not come
            raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
        return decision
