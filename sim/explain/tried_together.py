"""Changes of one decision, tried many at once: only the move after each is asked for.

Each change is said by what is seen otherwise and by the charges it leaves; nothing is done on the road. So it
is the same move as after the actions of a person, which the tests compare. A change that cannot be said so is
left out, and one that is found is done by its actions before it is told.
"""

from __future__ import annotations

from collections.abc import Sequence

from sim.actions import Add, Prefer, Preference, WorldAction
from sim.explain.edit import Edit
from sim.explain.factors import without
from sim.explain.intervention import Intervention
from sim.explain.quick_moves import QuickMoves
from sim.search.compiled_costs import Unlike
from sim.search.costs import Weights, weights_of
from sim.session.settings import preferences_with
from sim.types import Move


class TogetherTried:
    """Tries changes of one decision, many at once; they are said by the numbers of their edits."""

    def __init__(self, rerun: Intervention, quick: QuickMoves, edits: Sequence[Edit]) -> None:
        """`rerun`: the decision; `quick`: its `Intervention.quick`."""
        self._rerun = rerun
        self._quick = quick
        self._edits = edits
        said = [Unlike() if edit.of_wishes else self._of_edit(edit) for edit in edits]
        self._unsaid = frozenset(number for number, unlike in enumerate(said) if unlike is None)
        self._wishes = frozenset(number for number, edit in enumerate(edits) if edit.of_wishes)
        self._parts = quick.parts([Unlike() if unlike is None else unlike for unlike in said])
        self._charges: dict[tuple[int, ...], Weights] = {(): quick.charges_without(())}

    def made(self, changes: Sequence[tuple[int, ...]]) -> list[Move | None]:
        """The move after each of these changes, all of as many edits; None of those that cannot be said so.

        Raises `WorkSpentError` where not all of them may be tried any more.
        """
        places: dict[tuple[int, ...], list[int]] = {}
        for place, change in enumerate(changes):
            if self._unsaid.isdisjoint(change):
                wishes = () if self._wishes.isdisjoint(change) else self._wishes_of(change)
                places.setdefault(wishes, []).append(place)
        self._rerun.spend(sum(map(len, places.values())))
        by_charges: dict[Weights, list[int]] = {}
        for wishes, at in places.items():
            by_charges.setdefault(self._charges_after(wishes), []).extend(at)
        moves = self._quick.moves_of(
            self._parts, {charges: [changes[place] for place in at] for charges, at in by_charges.items()}
        )
        found: list[Move | None] = [None] * len(changes)
        for charges, at in by_charges.items():
            for place, move in zip(at, moves[charges], strict=True):
                found[place] = move
        return found

    def _wishes_of(self, change: tuple[int, ...]) -> tuple[int, ...]:
        return tuple(number for number in change if number in self._wishes)

    def _charges_after(self, wishes: tuple[int, ...]) -> Weights:
        """The charges after these edits of wishes."""
        if wishes not in self._charges:
            self._charges[wishes] = self._with_wishes([self._edits[number] for number in wishes])
        return self._charges[wishes]

    def _of_edit(self, edit: Edit) -> Unlike | None:
        if edit.gone:
            return self._quick.unlike_without(edit.gone)
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
