"""Changes of one decision, tried many at once by compiled words: only the move after each is asked for.

Each change is said by what is seen otherwise, as boards, and by the settings it leaves; nothing is done on the
road. So it is the same move as after the actions of a person, which the tests compare; a change that cannot be
said so is left out, and a change that is found is done by its actions before it is told.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sim.actions import Add, Prefer
from sim.config import Config
from sim.explain.edit import Edit, Edits
from sim.explain.effort import WorkSpentError, work_among_many
from sim.explain.factors import is_factor, without
from sim.explain.intervention import Intervention
from sim.search.compiled_costs import Unlike
from sim.session.edits import apply
from sim.types import Move


class TogetherTried:
    """Tries changes of one decision, many at once. Precondition: `Intervention.tried_together`."""

    def __init__(self, rerun: Intervention) -> None:
        """`rerun`: the decision."""
        self._rerun = rerun
        self._config = rerun.state.config_of(rerun.ego)
        percept = rerun.percept
        self._movers = {name: 1 << cell for cell, name in percept.movers.items()}
        self._fixed = {name: 1 << cell for cell, name in percept.hazards.items()}
        self._unlike: dict[Edit, Unlike | None] = {}
        self._wished: dict[Edit, Config] = {}
        self._unit = work_among_many(percept.road.columns, percept.ego // percept.road.columns)

    def made(self, changes: Iterable[Edits]) -> dict[frozenset[Edit], Move]:
        """The move after each of these changes, of those that can be said as boards.

        Raises `WorkSpentError` where not all of them may be tried any more.
        """
        said = [(frozenset(edits), self._said(edits)) for edits in changes]
        known = [(key, unlike) for key, unlike in said if unlike is not None]
        left = self._rerun.work_left
        if left is not None and left < self._unit * len(known):
            raise WorkSpentError
        if not known:
            return {}
        moves = self._rerun.made_after([unlike for _, unlike in known])
        return {} if moves is None else dict(zip((key for key, _ in known), moves, strict=True))

    def _said(self, edits: Edits) -> tuple[Unlike, Config] | None:
        """A change as boards, with the settings after it; None where it cannot be said so."""
        movers = fixed = barriers = potholes = 0
        config = self._config
        for edit in edits:
            if edit.of_wishes:
                config = self._with_wish(edit)
                continue
            if edit not in self._unlike:
                self._unlike[edit] = self._of_edit(edit)
            unlike = self._unlike[edit]
            if unlike is None:
                return None
            movers |= unlike.movers
            fixed |= unlike.fixed
            barriers |= unlike.barriers
            potholes |= unlike.potholes
        return Unlike(movers, fixed, barriers, potholes), config

    def _of_edit(self, edit: Edit) -> Unlike | None:
        if edit.gone:
            movers, fixed = self._movers.get(edit.gone, 0), self._fixed.get(edit.gone, 0)
            return Unlike(movers, fixed) if movers or fixed else None
        return self._added(edit.actions)

    def _added(self, actions: Sequence[object]) -> Unlike | None:
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

    def _with_wish(self, edit: Edit) -> Config:
        if edit not in self._wished:
            if is_factor(edit.gone):
                self._wished[edit] = without(self._config, (edit.gone,))
            else:
                state = self._rerun.state
                for action in edit.actions:
                    assert isinstance(action, Prefer)
                    state = apply(state, action).state
                self._wished[edit] = state.config_of(self._rerun.ego)
        return self._wished[edit]
