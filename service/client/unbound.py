"""What is answered without a session: an advice, and what can be said."""

from __future__ import annotations

from dataclasses import dataclass

from service.client import notebook_html as html
from service.client.reading import Json, Result


@dataclass(frozen=True)
class AdviceOption:
    """What one choice leads to; `chance` is that of coming away unharmed."""

    option: str
    chance: float
    interval: tuple[float, float]
    ending: str


@dataclass(frozen=True, kw_only=True)
class Advice(Result):
    """What to do about a hazard ahead, and how sure that is; the physics behind it are in `raw`."""

    question: str
    text: str
    source: str
    hazard: str
    distance_m: float
    speed_kmh: float
    weather: str
    recommendation: str
    confidence: float
    options: tuple[AdviceOption, ...]

    def _repr_html_(self) -> str:
        """The advice and every choice, for notebooks."""
        rows = [(each.option, f"{each.chance:.0%}", each.ending) for each in self.options]
        return html.table(self.text, ("choice", "unharmed", "in the middle of the range"), rows)


@dataclass(frozen=True)
class Intent:
    """One kind of thing that can be said."""

    intent: str
    available: bool
    why_not: str | None
    examples: tuple[Json, ...]


@dataclass(frozen=True, kw_only=True)
class Guide(Result):
    """What can be said, or how a sentence that was begun could go on."""

    language: str
    languages: tuple[str, ...]
    intents: tuple[Intent, ...]
    completions: tuple[str, ...]

    def _repr_html_(self) -> str:
        """A sentence for each intent, or the completions, for notebooks."""
        if self.completions:
            return html.table("It could go on like this.", ("say",), [(each,) for each in self.completions])
        rows = [(each.examples[0].get("text"), each.intent) for each in self.intents if each.examples]
        return html.table("This can be said.", ("say", "intent"), rows)
