"""What can be said: intents with examples, taught phrases, completions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from service.contract import notebook_html as html
from service.contract.command import ActionJson, Change
from service.contract.model import Answered, DocumentedAs, Model


@dataclass(frozen=True, slots=True)
class Saying(Model):
    """A sentence and what it means."""

    text: str
    actions: tuple[ActionJson, ...]


@dataclass(frozen=True, slots=True)
class IntentGuide(Model):
    """One kind of thing that can be said."""

    intent: str
    """The action's `do`; for a question also what it is about."""
    available: bool
    """Whether this version does it."""
    why_not: str | None
    examples: tuple[Saying, ...]


@dataclass(frozen=True, slots=True)
class TaughtPhrase(Model):
    """A phrase that was taught, and what it means."""

    phrase: str
    meaning: tuple[ActionJson, ...]
    sentence: str
    """The sentence that says the same."""
    parameters: tuple[str, ...] = ()
    """The words of the phrase in whose place a number is said."""


@dataclass(frozen=True, slots=True)
class Preview(Model):
    """What a sentence would do if it were sent as it stands."""

    standing: Annotated[str, DocumentedAs(Literal["does", "asks", "ambiguous", "not_understood", "refused"])]
    actions: tuple[ActionJson, ...]
    changes: tuple[Change, ...]
    """Empty also where finding out would take long."""
    detail: str | None
    """What it would be refused or asked about with."""
    unparsed: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class LanguageGuide(Answered):
    """What can be said, or how a sentence that was begun could go on."""

    language: str
    languages: tuple[str, ...]
    prefix: str | None
    intents: tuple[IntentGuide, ...]
    """Empty when a prefix was given."""
    taught: tuple[TaughtPhrase, ...]
    """Empty when a prefix was given."""
    completions: tuple[str, ...]
    """Whole sentences that begin with the prefix."""
    preview: Preview | None
    """With a prefix and a session; none for an empty prefix."""

    def _repr_html_(self) -> str:
        """A sentence for each intent, or the completions, for notebooks."""
        if self.completions:
            return html.table("It could go on like this.", ("say",), [(each,) for each in self.completions])
        rows = [(each.examples[0].text, each.intent) for each in self.intents if each.examples]
        return html.table("This can be said.", ("say", "intent"), rows)
