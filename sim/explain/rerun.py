"""Running one decision again on a changed road, remembering what was run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from sim.actions import Add, Remove, Where
from sim.edit import apply
from sim.kinds import Cell, Move, kind_of
from sim.plan import Decision
from sim.run import Run, decide
from sim.world import World


def removal(ids: Iterable[str]) -> tuple[Remove, ...]:
    """The actions that take these things away."""
    return tuple(Remove(kind=kind_of(name).value, count=1, where=Where(id=name)) for name in ids)


def wall(world: World, cell: Cell) -> Add:
    """What blocks a cell: a barrier, or where a mover is just leaving it, a pothole that holds it there."""
    held = world.moving >> world.road.index(cell) & 1
    return Add(kind="pothole" if held else "barrier", count=1, where=Where(cell=cell))


class Rerun:
    """Decisions of one moment on roads that differ from its own by what is on them."""

    def __init__(self, run: Run) -> None:
        """A moment in which a decision is taken (not while a result stands)."""
        self.run = run
        self.count = 0
        self._known: dict[tuple[str, frozenset[str]], Move] = {}

    def without(self, ids: Iterable[str]) -> Move:
        """The move had these things never been there."""
        return self._remembered("without", frozenset(ids), self.run.world.without)

    def keeping(self, ids: Iterable[str]) -> Move:
        """The move had nothing but these things been there."""
        return self._remembered("keeping", frozenset(ids), self.run.world.keeping)

    def decision_without(self, ids: Iterable[str]) -> Decision:
        """The whole decision had these things never been there."""
        return self._decide(self.run.world.without(frozenset(ids)))

    def after(self, change: Iterable[Remove | Add]) -> Move:
        """The move had a person made this change first."""
        run = self.run
        for action in change:
            run = apply(run, action).run
        return self._decide(run.world).move

    def _remembered(self, how: str, ids: frozenset[str], change: Callable[[frozenset[str]], World]) -> Move:
        move = self._known.get((how, ids))
        if move is None:
            move = self._known[how, ids] = self._decide(change(ids)).move
        return move

    def _decide(self, world: World) -> Decision:
        self.count += 1
        decision = decide(replace(self.run, world=world))
        if decision is None:
            raise ValueError("no decision is taken while a result stands")
        return decision
