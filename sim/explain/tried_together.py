"""Changes of one decision, tried many at once: only the move after each is asked for.

Each change is said by what is seen otherwise and by the charges it leaves; nothing is done on the road. So it
is the same move as after the actions of a person, which the tests compare. A change that cannot be said so is
left out, and one that is found is done by its actions before it is told.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sim.actions import Add, Prefer, Preference, WorldAction
from sim.explain.edit import Edit, Edits
from sim.explain.factors import without
from sim.explain.intervention import Intervention
from sim.explain.quick_moves import QuickMoves, SeenOtherwise
from sim.search.compiled_costs import Unlike
from sim.search.costs import Weights, weights_of
from sim.session.settings import preferences_with
from sim.types import Move


class TogetherTried:
    """Tries changes of one decision, many at once."""

    def __init__(self, rerun: Intervention, quick: QuickMoves) -> None:
        """`rerun`: the decision; `quick`: its `Intervention.quick`."""
        self._rerun = rerun
        self._quick = quick
        self._unlike: dict[Edit, Unlike] = {}
        self._usual = quick.charges_without(())

    def made(self, changes: Iterable[Edits]) -> dict[frozenset[Edit], Move]:
        """The move after each of these changes, of those that can be said so.

        Raises `WorkSpentError` where not all of them may be tried any more.
        """
        said = [(frozenset(edits), self._said(edits)) for edits in changes]
        known = [(key, otherwise) for key, otherwise in said if otherwise is not None]
        moves = self._rerun.made_after([otherwise for _, otherwise in known])
        return dict(zip((key for key, _ in known), moves, strict=True))

    def _said(self, edits: Edits) -> SeenOtherwise | None:
        movers = fixed = barriers = potholes = 0
        wishes = []
        for edit in edits:
            if edit.of_wishes:
                wishes.append(edit)
                continue
            unlike = self._unlike.get(edit)
            if unlike is None:
                unlike = self._of_edit(edit)
                if unlike is None:
                    return None
                self._unlike[edit] = unlike
            gone, gone_fixed, barred, holed = unlike
            movers |= gone
            fixed |= gone_fixed
            barriers |= barred
            potholes |= holed
        charges = self._with_wishes(wishes) if wishes else self._usual
        return SeenOtherwise(Unlike(movers, fixed, barriers, potholes), charges)

    def _of_edit(self, edit: Edit) -> Unlike | None:
        if edit.gone:
            otherwise = self._quick.without((edit.gone,))
            return None if otherwise is None else otherwise.unlike
        return self._added(edit.actions)

    def _added(self, actions: Sequence[WorldAction]) -> Unlike | None:
        """A barrier in an empty cell, or a pothole under a mover."""
        percept = self._rerun.percept
        if len(actions) != 1:
            return None
        (action,) = actions
        if not isinstance(action, Add) or action.where is None or action.where.cell is None:
            return None
        cell = percept.road.index(action.where.cell)
        if cell == percept.ego or cell in percept.hazards:
            return None
        if action.kind == "barrier" and cell not in percept.movers:
            return Unlike(barriers=1 << cell)
        return Unlike(potholes=1 << cell) if action.kind == "pothole" and cell in percept.movers else None

    def _with_wishes(self, edits: Sequence[Edit]) -> Weights:
        """The charges once wishes were taken back, then others said."""
        config = self._rerun.state.config
        left = without(config, [edit.gone for edit in edits])
        said = [action for edit in edits for action in edit.actions if isinstance(action, Prefer)]
        again = left.preferences if left.preferences != config.preferences else ()
        preferences: tuple[Preference, ...] = () if again else left.preferences
        for wish in (*again, *(action.preference for action in said)):
            preferences = preferences_with(preferences, wish)
        return weights_of(config.rules, preferences, left.safety_buffer)
