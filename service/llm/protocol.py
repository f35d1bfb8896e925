"""What a language model may do for the service: read a sentence, put an explanation in other words.

A leaf, so that whoever asks one needs no library for it. A model can cause nothing by itself: what it
reads becomes contract actions, which go the way of all others. Whether to ask it, and whether to show
what it understood before doing it, is the caller's to decide.
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
    """What a model made of a sentence: actions, or one sentence on why there are none."""

    actions: tuple[Action, ...] = ()
    explanation: str = ""
    failure: ModelFailure | None = field(default=None, compare=False)
    """what went wrong, to be told in another language"""


class LanguageModel(Protocol):
    """A language model behind the typed door. Nothing that a server answers makes it raise."""

    @property
    def name(self) -> str:
        """Which model, and which versions of the prompts: for showing, never a key or an address."""
        ...

    async def interpret(self, text: str) -> Interpretation:
        """What someone may have meant whom the grammar did not understand."""
        ...

    async def rephrase(self, text: str, facts: Facts) -> str:
        """An explanation in other words, or as it was given where the model's words are not fit."""
        ...

    async def aclose(self) -> None:
        """Let go of connections."""
        ...
