"""Running one decision again on a changed road, remembering what was run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from sim.kinds import Cell, Move
from sim.plan import Decision
from sim.run import Run, decide
from sim.world import World


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

    def with_barriers(self, ids: Iterable[str], cells: Iterable[Cell]) -> Move:
        """The move had these things not been there and these empty cells held barriers."""
        world = self.run.world.without(frozenset(ids))
        indices = [world.road.index(cell) for cell in cells]
        board = sum(1 << index for index in indices)
        hazards = {**world.hazards, **{index: f"barrier-at-{index}" for index in indices}}
        return self._decide(replace(world, barriers=world.barriers | board, hazards=hazards)).move

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
