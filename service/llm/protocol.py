"""The interface of a language model: read a sentence, rephrase an explanation.

This module imports no model library. A model cannot do anything by itself: what it reads becomes actions,
which are handled like all others. Whether to ask it, and whether to confirm what it read, is up to the
caller.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeAlias

from service.actions import Action
from service.llm.failures import ModelFailure

Facts: TypeAlias = Mapping[str, Any]
"""The structured part of an explanation, as JSON values: `service.contract.encode.explanation`."""


@dataclass(frozen=True, slots=True)
class Interpretation:
    """What a model read in a sentence: actions, or one sentence on why there are none."""

    actions: tuple[Action, ...] = ()
    explanation: str = ""
    failure: ModelFailure | None = field(default=None, compare=False)
    """what went wrong, to be told in another language"""


class LanguageModel(Protocol):
    """A language model. It never raises, whatever its server answers."""

    @property
    def name(self) -> str:
        """The model and the versions of the prompts, for display; never a key or an address."""
        ...

    async def interpret(self, text: str) -> Interpretation:
        """The likely meaning of a sentence that the grammar refused."""
        ...

    async def rephrase(self, text: str, facts: Facts) -> str:
        """An explanation in other words, or unchanged if the model's words are unfit."""
        ...

    async def aclose(self) -> None:
        """Close connections."""
        ...
