"""One thing that a change of the road or of the wishes changes."""

from __future__ import annotations

from dataclasses import dataclass, field

from sim.actions import Add, Prefer, WorldAction
from sim.explain.factors import is_factor
from sim.types import Cell


@dataclass(frozen=True, slots=True)
class Edit:
    """One thing that is changed: `gone` is taken away, or `actions` are done."""

    gone: str = ""
    actions: tuple[WorldAction, ...] = ()
    of_wishes: bool = field(init=False, compare=False, repr=False)
    """whether it changes wishes or settings, and nothing on the road"""
    _hash: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        wished = is_factor(self.gone) or any(isinstance(action, Prefer) for action in self.actions)
        object.__setattr__(self, "of_wishes", wished)
        # Thousands of changes are looked up by their edits, and to hash an action takes long.
        object.__setattr__(self, "_hash", hash((self.gone, self.actions)))

    def __hash__(self) -> int:
        return self._hash

    @property
    def barred(self) -> tuple[Cell, ...]:
        """The cells that barriers are put into."""
        return tuple(
            action.where.cell
            for action in self.actions
            if isinstance(action, Add) and action.kind == "barrier" and action.where and action.where.cell
        )

    @property
    def filled(self) -> tuple[Cell, ...]:
        """The cells that anything is put into."""
        return tuple(
            action.where.cell
            for action in self.actions
            if isinstance(action, Add) and action.where and action.where.cell
        )


Edits = tuple[Edit, ...]
