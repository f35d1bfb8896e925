"""One thing that a change of the road or of the wishes changes."""

from __future__ import annotations

from dataclasses import dataclass

from sim.actions import Add, Prefer, WorldAction
from sim.explain.factors import is_factor
from sim.types import Cell


@dataclass(frozen=True, slots=True)
class Edit:
    """One thing that is changed: `gone` is taken away, or `actions` are done."""

    gone: str = ""
    actions: tuple[WorldAction, ...] = ()

    @property
    def barred(self) -> tuple[Cell, ...]:
        """The cells that barriers are put into."""
        return tuple(
            action.where.cell
            for action in self.actions
            if isinstance(action, Add) and action.kind == "barrier" and action.where and action.where.cell
        )

    @property
    def of_wishes(self) -> bool:
        """Whether it changes wishes or settings; a change has at most one of these."""
        return is_factor(self.gone) or any(isinstance(action, Prefer) for action in self.actions)


Edits = tuple[Edit, ...]
