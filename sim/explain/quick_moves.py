"""The moves of one decision where other things are seen, many at once, by compiled words.

What is seen otherwise is said as boards, with the settings beside it. It is the move that the planner makes
of such a percept, which the tests compare; where that cannot be had, `QuickMoves.answers` says so.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

from sim.config import Config
from sim.explain.effort import work_among_many
from sim.explain.factors import factors, is_factor, without
from sim.perceive import Percept
from sim.plan import Decision, Measure
from sim.rules.compiled import compiled_rules
from sim.search.compiled_costs import Unlike, are_loaded, compiled_moves
from sim.search.costs import TICKS_ALONE, Weights, weights
from sim.search.reachability import steps_left
from sim.state import SimState
from sim.types import Move


class SeenOtherwise(NamedTuple):
    """A change of what is seen, and of the settings."""

    unlike: Unlike
    charges: Weights


class QuickMoves:
    """The moves of one decision after changes of what is seen."""

    @staticmethod
    def answers(state: SimState, decision: Decision, percept: Percept) -> bool:
        """Whether this can be had, by the planner, the road and what is loaded."""
        return (
            decision.measure in (Measure.COST, Measure.TICKS)
            and decision.asked is None
            and decision.fault is None
            and are_loaded()
            and len(state.egos) == 1
            and not percept.egos
            and compiled_rules(state.config)
            and percept.boards.others == percept.pedestrians
            and steps_left(state.config, percept.episode_tick) > 1
        )

    def __init__(self, config: Config, percept: Percept, fact: Move, by: Measure) -> None:
        """Precondition: `answers`. `fact`: the move of the decision, `by`: what it weighs."""
        road = percept.road
        row = percept.ego // road.columns
        self.work = work_among_many(road.columns, row)
        """of one move"""
        self._config, self._percept, self._fact = config, percept, fact
        self._ticks = by is Measure.TICKS
        self._charges = TICKS_ALONE if self._ticks else weights(config)
        self._limit = steps_left(config, percept.episode_tick)
        self._movers = {name: 1 << cell for cell, name in percept.movers.items()}
        self._fixed = {name: 1 << cell for cell, name in percept.hazards.items()}
        self._factors = factors(config)
        # What lies further behind than anything is kept clear of takes no part.
        rows = row + 1 + max(1, self._charges.buffer)
        self._near = (1 << min(rows, road.rows) * road.columns) - 1

    def moves(self, changes: Sequence[SeenOtherwise]) -> list[Move]:
        """The move after each of these changes."""
        asked = [place for place, change in enumerate(changes) if self._matters(change)]
        found = [self._fact] * len(changes)
        if asked:
            moves = compiled_moves(
                self._percept,
                [changes[place].unlike for place in asked],
                [changes[place].charges for place in asked],
                self._limit,
            )
            for place, move in zip(asked, moves, strict=True):
                found[place] = move
        return found

    def _matters(self, change: SeenOtherwise) -> bool:
        """Whether anything is otherwise where it can have a part."""
        return change.charges is not self._charges or any(board & self._near for board in change.unlike)

    def without(self, names: Collection[str]) -> SeenOtherwise | None:
        """What is seen without these; None where one of them is not known."""
        movers = fixed = 0
        for name in names:
            if name in self._movers:
                movers |= self._movers[name]
            elif name in self._fixed:
                fixed |= self._fixed[name]
            elif not is_factor(name):
                return None
        return SeenOtherwise(Unlike(movers, fixed), self.charges_without(names))

    def keeping(self, names: Collection[str]) -> SeenOtherwise:
        """What is seen with nothing but these."""
        movers = fixed = 0
        for name, bit in self._movers.items():
            movers |= 0 if name in names else bit
        for name, bit in self._fixed.items():
            fixed |= 0 if name in names else bit
        gone = [name for name in self._factors if name not in names]
        return SeenOtherwise(Unlike(movers, fixed), self.charges_without(gone))

    def charges_without(self, names: Collection[str]) -> Weights:
        """The charges without those of these names that are wishes or settings."""
        config = without(self._config, names)
        return self._charges if self._ticks or config is self._config else weights(config)
