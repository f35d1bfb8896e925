"""A language model without a model: answers written down beforehand, for tests and for trials."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from service.llm.failures import ModelFailure
from service.llm.protocol import Facts, Interpretation
from service.refusals import refusals


@dataclass
class FakeModel:
    """Interprets and rephrases what it was given, and nothing else; remembers what it was asked."""

    interpretations: Mapping[str, Interpretation] = field(default_factory=dict)
    words: Mapping[str, str] = field(default_factory=dict)
    name: str = "fake"
    asked: list[str] = field(default_factory=list)
    closed: bool = False

    async def interpret(self, text: str) -> Interpretation:
        """What was written down for the sentence."""
        self.asked.append(text)
        nothing = ModelFailure("nothing")
        told = refusals().model(nothing.reason, nothing.parts)
        return self.interpretations.get(text, Interpretation(explanation=told, failure=nothing))

    async def rephrase(self, text: str, facts: Facts) -> str:  # noqa: ARG002 -- the interface has it
        """What was written down for the text."""
        self.asked.append(text)
        return self.words.get(text, text)

    async def aclose(self) -> None:
        """Remember that it was closed."""
        self.closed = True
