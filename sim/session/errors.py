"""A change that cannot be made, as a code and facts (`sim.codes`)."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from sim.codes import EDITS, check_facts, plain_text


class EditError(ValueError):
    """A change that cannot be made. `str` is a line for developers; people are told in sentences."""

    def __init__(self, code: str, field: str, **facts: Any) -> None:
        """`field`: the key of the action that is the trouble."""
        category, expected = EDITS.get(code, ("", None))
        check_facts(code, facts, expected)
        super().__init__(plain_text(code, facts))
        self.code = code
        self.category = category
        """what kind of refusal it is, for programs; several codes share one"""
        self.field = field
        self.facts = MappingProxyType(facts)
