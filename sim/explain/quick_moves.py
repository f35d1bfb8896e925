"""The moves of one decision where other things are seen, many at once, by compiled words.

What is seen otherwise is said as boards, with the settings beside it. It is the move that the planner makes
of such a percept, which the tests compare; where that cannot be had, `QuickMoves.answers` says so.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sim.config import Config
from sim.explain.effort import work_among_many
from sim.explain.factors import factors, is_factor, without
from sim.perceive import Percept
from sim.plan import Decision, Measure
from sim.rules.compiled import compiled_rules
from sim.search.compiled_costs import Unlike, are_loaded, move_kernel
from sim.search.compiled_rows import BY_RANK, MOST_COLUMNS, compiled_moves_by_rank
from sim.search.costs import TICKS_ALONE, Weights, weights
from sim.search.reachability import steps_left
from sim.state import SimState
from sim.types import Move
from sim.world.grid import union

if TYPE_CHECKING:
    from sim.batch.move_kernel import Parts


class SeenOtherwise(NamedTuple):
    """A change of what is seen, and of the settings."""

    unlike: Unlike
    charges: Weights


class ChangeParts(NamedTuple):
    """Parts of changes, as `QuickMoves.parts` prepares them."""

    unlike: Sequence[Unlike]
    words: Parts | None
    """None for planners that decide from the next rows alone"""

    def together(self, chosen: Sequence[int]) -> Unlike:
        """The change that some of them make up."""
        return Unlike(
            *(union(boards) for boards in zip(*(self.unlike[part] for part in chosen), strict=True))
        )


class QuickMoves:
    """The moves of one decision after changes of what is seen."""

    @staticmethod
    def answers(state: SimState, decision: Decision, percept: Percept) -> bool:
        """Whether this can be had, by the planner, the road and what is loaded."""
        if decision.measure is Measure.RANK:
            known = decision.planner in BY_RANK and percept.road.columns <= MOST_COLUMNS
        else:
            known = decision.measure in (Measure.COST, Measure.TICKS)
            known = known and steps_left(state.config, percept.episode_tick) > 1
        return (
            known
            and decision.asked is None
            and decision.fault is None
            and are_loaded()
            and len(state.egos) == 1
            and not percept.egos
            and compiled_rules(state.config)
            and percept.boards.others == percept.pedestrians
        )

    def __init__(self, config: Config, percept: Percept, decision: Decision) -> None:
        """Precondition: `answers`."""
        road = percept.road
        row = percept.ego // road.columns
        self._ranked = decision.planner if decision.measure is Measure.RANK else None
        self.work = 1 if self._ranked else work_among_many(road.columns, row)
        """of one move"""
        self._config, self._percept, self._fact = config, percept, decision.move
        self._by_cost = decision.measure is Measure.COST
        self._charges = weights(config) if self._by_cost else TICKS_ALONE
        if self._ranked is None:
            self._kernel = move_kernel(percept, steps_left(config, percept.episode_tick))
        self._movers = {name: 1 << cell for cell, name in percept.movers.items()}
        self._fixed = {name: 1 << cell for cell, name in percept.hazards.items()}
        self._all_movers, self._all_fixed = union(self._movers.values()), union(self._fixed.values())
        self._factors = factors(config)
        # What lies further behind than anything is kept clear of takes no part.
        rows = row + 1 + max(1, self._charges.buffer)
        self._near = (1 << min(rows, road.rows) * road.columns) - 1

    def moves(self, changes: Sequence[SeenOtherwise]) -> list[Move]:
        """The move after each of these changes."""
        found = [self._fact] * len(changes)
        usual: list[int] = []
        others: dict[Weights, list[int]] = {}
        for place, change in enumerate(changes):
            if change.charges is not self._charges:
                others.setdefault(change.charges, []).append(place)
            elif self._matters(change.unlike):
                usual.append(place)
        if usual:
            others[self._charges] = [*others.get(self._charges, ()), *usual]
        for charges, places in others.items():
            unlike = [changes[place].unlike for place in places]
            if self._ranked:
                moves = compiled_moves_by_rank(self._percept, self._ranked, unlike)
            else:
                moves = self._kernel.moves(unlike, charges)
            for place, move in zip(places, moves, strict=True):
                found[place] = move
        return found

    def parts(self, unlike: Sequence[Unlike]) -> ChangeParts:
        """Changes of which others are made up (`moves_of`)."""
        return ChangeParts(unlike, None if self._ranked else self._kernel.parts(unlike))

    def moves_of(
        self, parts: ChangeParts, changes: Mapping[Weights, Sequence[Sequence[int]]]
    ) -> dict[Weights, list[Move]]:
        """The moves after changes, by the charges they leave; at least one of each.

        A change is said by the numbers of its parts, all of as many.
        """
        if parts.words is not None:
            return self._kernel.moves_of(parts.words, changes)
        return {
            charges: self.moves([SeenOtherwise(parts.together(each), charges) for each in chosen])
            for charges, chosen in changes.items()
        }

    def without_each(self, names: Sequence[str]) -> dict[str, Move]:
        """The move without each of these alone, of those that are known here."""
        changes = {}
        for name in names:
            unlike = self.unlike_without(name)
            if unlike is not None:
                changes[name] = SeenOtherwise(unlike, self._charges)
            elif is_factor(name):
                changes[name] = SeenOtherwise(Unlike(), self.charges_without((name,)))
        return dict(zip(changes, self.moves([*changes.values()]), strict=True))

    def unlike_without(self, name: str) -> Unlike | None:
        """What is seen without a thing; None if it is not known."""
        if name in self._movers:
            return Unlike(self._movers[name])
        return Unlike(0, self._fixed[name]) if name in self._fixed else None

    def _matters(self, unlike: Unlike) -> bool:
        """Whether anything is otherwise where it can have a part."""
        movers, fixed, barriers, potholes = unlike
        return bool((movers | fixed | barriers | potholes) & self._near)

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
        for name in names:
            movers |= self._movers.get(name, 0)
            fixed |= self._fixed.get(name, 0)
        gone = [name for name in self._factors if name not in names]
        unlike = Unlike(self._all_movers & ~movers, self._all_fixed & ~fixed)
        return SeenOtherwise(unlike, self.charges_without(gone))

    def charges_without(self, names: Collection[str]) -> Weights:
        """The charges without those of these names that are wishes or settings."""
        if not any(name in names for name in self._factors):
            return self._charges
        return weights(without(self._config, names))
