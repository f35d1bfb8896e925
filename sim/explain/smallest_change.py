"""The smallest change of the road, or of the wishes, after which a move is made: by size, within a bound.

A change is made of edits: a thing taken away, a cell beside the vehicle blocked, another wish. All changes of
one edit are tried, then of two, then of three, the most telling first; `SmallestChange.searched` says up to
which size all were tried. A larger change that is known to work is cut down to a part of which nothing can be
spared.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice
from typing import Final, get_args

from sim.actions import Prefer, Wish, WorldAction
from sim.explain.edit import Edit, Edits
from sim.explain.effort import RESERVE, Effort, WorkSpentError
from sim.explain.intervention import Intervention, wall
from sim.explain.relevance import having_part
from sim.explain.tried_together import TogetherTried
from sim.oracle.ddmin import ddmin
from sim.plan import Measure, traits_of
from sim.session.errors import EditError
from sim.types import Move

MOST_EDITS: Final = 3
"""Edits of the largest change that is looked for."""
MOST_TRIES: Final = 400
"""Changes that are tried for an answer; where decisions search to the goal, their work ends it sooner."""
FIRST_TOGETHER: Final = 16
MOST_TOGETHER: Final = 128
"""Changes that are tried at once, at first and later, where that can be."""
MOST_CUT: Final = 7
"""Edits of a change of which every part is tried."""


@dataclass(frozen=True, slots=True)
class SmallestChange:
    """What was found."""

    edits: Edits | None
    """None where no change was found"""
    searched: int
    """edits up to which every change was tried, those found not counted"""
    tried: int
    """changes that were tried"""


class ChangeSearch:
    """Changes that lead to one move, of one decision."""

    def __init__(
        self, rerun: Intervention, foil: Move, names: Sequence[str], effort: Effort = Effort.USUAL
    ) -> None:
        """`names`: everything that was seen and wished, the most telling first."""
        self._effort = effort
        self._rerun = rerun
        self._foil = foil
        traits = traits_of(rerun.decision.planner)
        self._most = effort.of(MOST_TRIES)
        self._edits = list(self._single_edits(having_part(rerun.percept, traits, list(names))))
        self._numbers = {edit: number for number, edit in enumerate(self._edits)}
        self._known: dict[tuple[int, ...], Move | None] = {}
        self._together: TogetherTried | None = None
        if rerun.quick is not None:
            self._together = TogetherTried(rerun, rerun.quick, self._edits)

    @property
    def tried(self) -> int:
        """Changes tried so far."""
        return len(self._known)

    def reaches(self, edits: Iterable[Edit]) -> bool:
        """Whether the move is made after these edits."""
        return self.made(edits) is self._foil

    def made(self, edits: Iterable[Edit]) -> Move | None:
        """The move after these edits; None where they cannot be made."""
        edits = tuple(edits)
        key = tuple(sorted({self._numbers.setdefault(edit, len(self._numbers)) for edit in edits}))
        if key not in self._known:
            self._known[key] = self._made(edits)
        return self._known[key]

    def _made(self, edits: Edits) -> Move | None:
        if self._is_refused(edits):
            return None
        if not any(isinstance(action, Prefer) for edit in edits for action in edit.actions):
            road = self._rerun.state.world.road
            cells = [road.index(cell) for edit in edits for cell in edit.barred]
            if len(cells) == sum(len(edit.actions) for edit in edits):
                made = self._rerun.behind_barriers([edit.gone for edit in edits if edit.gone], cells)
                if made is not None:
                    return made
        return self._done(edits)

    def _is_refused(self, edits: Edits) -> bool:
        """Whether it is known without trying that something is put where another thing stands for good."""
        if not self._rerun.faithful:
            return False
        percept, gone = self._rerun.percept, {edit.gone for edit in edits}
        filled = (percept.road.index(cell) for edit in edits for cell in edit.filled)
        return any(cell in percept.hazards and percept.hazards[cell] not in gone for cell in filled)

    def _done(self, edits: Edits) -> Move | None:
        """The move after the actions themselves."""
        change, undetected = self.change(edits)
        try:
            return self._rerun.after(change, undetected)
        except EditError:  # something is there that was not seen
            return None

    def change(self, edits: Iterable[Edit]) -> tuple[tuple[WorldAction, ...], tuple[str, ...]]:
        """The actions of these edits, and what must go undetected since no action takes it away."""
        edits = tuple(edits)
        gone = [edit.gone for edit in edits if edit.gone]
        done = sorted(
            (action for edit in edits for action in edit.actions),
            key=lambda action: not isinstance(action, Prefer),
        )
        return (*self._rerun.removal(gone), *done), self._rerun.phantoms(gone)

    def smallest(self, fallback: Iterator[Edits]) -> SmallestChange:
        """The smallest change that is found; `fallback`: larger ones to cut down where the tries run out."""
        searched = 0
        try:
            for size in range(1, MOST_EDITS + 1):
                for edits in self._of_size(size):
                    if edits is None:
                        return self._cut_down(fallback, searched)
                    if self.reaches(edits) and self._done(edits) is self._foil:
                        return SmallestChange(edits, searched, self.tried)
                searched = size
        except WorkSpentError:
            pass
        return self._cut_down(fallback, searched)

    def _of_size(self, size: int) -> Iterator[Edits | None]:
        """The changes of so many edits that may reach the move, the most telling first.

        None where no more may be tried.
        """
        changes = combinations(range(len(self._edits)), size)
        if self._together is None:
            for change in changes:
                yield self._edits_of(change) if self.tried < self._most else None
            return
        most = FIRST_TOGETHER
        while some := list(islice(changes, most)):
            made = self._together.made(some)
            self._known.update(
                (change, move) for change, move in zip(some, made, strict=True) if move is not None
            )
            if None in made or self._foil in made:
                for change, move in zip(some, made, strict=True):
                    if move is None or move is self._foil:
                        yield self._edits_of(change)
            most = min(MOST_TOGETHER, 2 * most)

    def _edits_of(self, change: Iterable[int]) -> Edits:
        return tuple(self._edits[number] for number in change)

    def _cut_down(self, fallback: Iterator[Edits], searched: int) -> SmallestChange:
        """A part of a larger change, of which nothing can be spared."""
        self._rerun.allow(self._effort.of(RESERVE))
        try:
            for edits in fallback:
                if self.reaches(edits):
                    found = self._without_spare(edits)
                    self._rerun.allow(self._effort.of(RESERVE))
                    if self._done(found) is self._foil:
                        return SmallestChange(found, searched, self.tried)
        except WorkSpentError:
            pass
        return SmallestChange(None, searched, self.tried)

    def _without_spare(self, edits: Edits) -> Edits:
        """A smallest part that still reaches the move; of many edits, one of which none can be spared."""
        if len(edits) > MOST_CUT:
            edits = tuple(ddmin(edits, self.reaches))
        if len(edits) > MOST_CUT:
            return edits
        parts = (part for size in range(1, len(edits)) for part in combinations(edits, size))
        return next(filter(self.reaches, parts), edits)

    def _single_edits(self, names: list[str]) -> Iterator[Edit]:
        """What is in the move's way first, then the cells that come before it, wishes, all other things."""
        rerun, decision = self._rerun, self._rerun.decision
        option = decision.option(self._foil)
        first = [name for name in names if name in option.causes]
        yield from (Edit(gone=name) for name in first)
        world = rerun.state.world
        own = world.road.cell(rerun.percept.ego)
        for each in decision.options:
            if each.cell not in (None, own, option.cell) and each.verdict == "free":
                assert each.cell is not None
                yield Edit(actions=(wall(world, each.cell),))
        if decision.measure is Measure.COST:
            yield from (Edit(actions=(Prefer(preference=wish),)) for wish in get_args(Wish))
        yield from (Edit(gone=name) for name in names if name not in first)
        for each in decision.options:  # what is blocked there may hold a mover, or turn one round
            if each.cell not in (None, own, option.cell) and each.verdict != "free":
                assert each.cell is not None
                yield Edit(actions=(wall(world, each.cell),))
