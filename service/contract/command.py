"""What comes of a command, typed actions, a question, a step or a patch of the configuration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field

from service.actions import Action
from service.contract import notebook_html as html
from service.contract.decision import Decision
from service.contract.evaluation import StartedEvaluation
from service.contract.model import Answered, DocumentedAs, Model, Tick
from service.contract.state import State

ActionJson = Annotated[Mapping[str, Any], DocumentedAs(Action)]
Interpreter = Annotated[str, DocumentedAs(Literal["grammar", "matched", "llm"])]


@dataclass(frozen=True, slots=True)
class Change(Model):
    """One value that differs."""

    path: str
    before: Any
    after: Any


@dataclass(frozen=True, slots=True)
class Correction(Model):
    """A word that was read as another."""

    wrote: Annotated[str, Field(alias="from")]
    read: Annotated[str, Field(alias="to")]


@dataclass(frozen=True, slots=True)
class ChoiceModel(Model):
    """One reading of an ambiguous sentence."""

    text: str
    actions: tuple[ActionJson, ...]


@dataclass(frozen=True, slots=True)
class PendingQuestion(Model):
    """A question of the service that the next sentence may answer."""

    text: str
    """What was said."""
    question: str
    choices: tuple[ChoiceModel, ...]
    """To answer, say the number of one or some of its words; "never mind" drops the question."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer(Answered):
    """The answer to a question; the facts it was made from depend on the question."""

    __pydantic_config__ = ConfigDict(extra="allow", use_attribute_docstrings=True, defer_build=True)

    question: str
    about: str
    tick: Tick
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandResult(Answered):
    """What was done."""

    text: str | None
    """What was said; null for typed actions."""
    actions: tuple[ActionJson, ...]
    changes: tuple[Change, ...]
    reply: str
    """What was done, in a sentence or two."""
    answer: Answer | None
    """The answer, if something was asked."""
    source: Annotated[str, DocumentedAs(Literal["grammar", "matched", "llm", "typed"])]
    """What understood it: the grammar, or a language model, which interprets."""
    sequence: int
    corrections: tuple[Correction, ...]
    dry_run: bool
    evaluations: tuple[StartedEvaluation, ...] = ()
    """Evaluations that it started, which go on in the background."""

    def _repr_html_(self) -> str:
        """The reply and what differs, for notebooks."""
        rows = [(change.path, change.before, change.after) for change in self.changes]
        return html.table(self.reply, ("what", "before", "after"), rows)


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfigChanged(Answered):
    """What a patch of the configuration did."""

    changes: tuple[Change, ...]
    reply: str
    """What was done, in a sentence or two."""
    sequence: int


@dataclass(frozen=True, slots=True, kw_only=True)
class StepResult(Answered):
    """Ticks that were run."""

    ticks: int
    decisions: tuple[Decision, ...]
    state: State

    def _repr_html_(self) -> str:
        """The road afterwards, for notebooks."""
        return html.road(self.state)


@dataclass(frozen=True, slots=True, kw_only=True)
class Parsed(Answered):
    """What a sentence means."""

    text: str
    actions: tuple[ActionJson, ...]
    source: Interpreter
    corrections: tuple[Correction, ...]
