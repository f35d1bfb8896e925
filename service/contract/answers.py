"""The documented shape of everything answered. Answers are not encoded through these.

A test holds real answers against them, so that they cannot drift from `service.contract.encode`. What a
road is made of is in `parts`, an advice in `advice`.
"""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from service.actions import Action
from service.contract.parts import Answered, LogEvent, PlaybackSpeed
from service.contract.parts import Decision as Decision
from service.contract.parts import State as State
from service.contract.requests import Tick
from sim.types import Mode, Outcome


class Parent(Answered):
    """Where a fork was taken; the session it was taken from may be deleted since."""

    id: str
    tick: Tick


class Session(Answered):
    """A session as it stands."""

    id: str
    name: str | None
    created_at: str
    paused: bool
    playback_speed: PlaybackSpeed
    mode: Mode
    tick: Tick
    episode: int
    status: Outcome
    sequence: int
    seed: int
    config: dict[str, Any]
    language: str = Field(description="The code of the language that its log and narration are in.")
    rules: int = Field(description="The version of the rules that it runs under.", examples=[2])
    rules_note: str | None = Field(
        description="What to tell whoever opens it, where these are not the rules of today.",
        examples=["Made under rules 1: it replays as it did then."],
    )
    sentence: str | None = Field(description="What to say for a road like this one; null where nothing does.")
    parent: Parent | None = Field(description="Of a fork, or a session that a link opened; else null.")
    links: dict[str, str]


class SavedMoment(Answered):
    """A moment of a session that was given a name."""

    name: str
    sequence: int = Field(description="The change that named it.")
    tick: Tick


class SavedMoments(Answered):
    """Moments with a name, by name."""

    items: list[SavedMoment]


class SessionMoment(SavedMoment):
    """A moment with a name, and the session it is in."""

    session: str
    session_name: str | None
    links: dict[str, str]


class MomentPage(Answered):
    """Moments with a name, of all sessions, those named last first."""

    items: list[SessionMoment]
    after: str | None = Field(description="Send as `after` for what follows.")
    more: bool


class Link(Answered):
    """A session at a tick as a piece of a URL."""

    link: str = Field(description="`#/r/...` carries the session, `#/s/...` names it.")
    tick: Tick
    carries: bool = Field(description="Whether all is in the link, so that it needs no session kept.")


class SessionSummary(Answered):
    """A session in a list. One that is not live is brought back when it is asked for."""

    id: str
    name: str | None
    created_at: str
    seed: int
    live: bool
    tick: Tick = Field(description="Where it stands, or stood when last stored.")
    parent: Parent | None = Field(description="Of a fork.")
    links: dict[str, str]


class SessionPage(Answered):
    """Sessions, newest first."""

    items: list[SessionSummary]
    after: str | None = Field(description="Send as `after` for what follows.")
    more: bool


class DecisionPage(Answered):
    """Decisions, oldest first. Ticks at which a result stood have none."""

    items: list[Decision]
    after: int = Field(description="Send as `after` for what follows.")
    more: bool


class EventPage(Answered):
    """Lines of the log, oldest first."""

    items: list[LogEvent]
    after: int = Field(description="Send as `after` for what follows.")
    more: bool
    first_kept: int = Field(description="Lines before this number are no longer kept.")


class Change(Answered):
    """One figure that differs."""

    path: str
    before: Any
    after: Any


class Correction(Answered):
    """A word that was read as another."""

    model_config = ConfigDict(extra="forbid", populate_by_name=True)

    wrote: str = Field(alias="from")
    read: str = Field(alias="to")


class CommandResult(Answered):
    """What was done."""

    text: str | None = Field(description="What was said; null for typed actions.")
    actions: list[Action]
    changes: list[Change]
    reply: str = Field(description="What was done, in a sentence or two.")
    answer: dict[str, Any] | None = Field(description="The answer, if something was asked.")
    source: Literal["grammar", "llm", "typed"] = Field(
        description="What understood it: the grammar, or a language model, which interprets."
    )
    sequence: int
    corrections: list[Correction]
    dry_run: bool


class ConfigChanged(Answered):
    """What a patch of the configuration did."""

    changes: list[Change]
    reply: str = Field(description="What was done, in a sentence or two.")
    sequence: int


class Saying(Answered):
    """A sentence and what it means."""

    text: str
    actions: list[Action]


class IntentGuide(Answered):
    """One kind of thing that can be said."""

    intent: str = Field(description="The action's `do`; for a question also what it is about.")
    available: bool = Field(description="Whether this version does it.")
    why_not: str | None
    examples: list[Saying]


class TaughtPhrase(Answered):
    """A phrase that was taught, and what it means."""

    phrase: str
    meaning: list[Action]
    sentence: str = Field(description="The sentence that says the same.")


class Preview(Answered):
    """What a sentence would do if it were sent as it stands."""

    standing: Literal["does", "asks", "ambiguous", "not_understood", "refused"]
    actions: list[Action]
    changes: list[Change] = Field(description="Empty also where finding out would take long.")
    detail: str | None = Field(description="What it would be refused or asked about with.")
    unparsed: list[str]


class LanguageGuide(Answered):
    """What can be said."""

    language: str
    languages: list[str]
    prefix: str | None
    intents: list[IntentGuide] = Field(description="Empty when a prefix was given.")
    taught: list[TaughtPhrase] = Field(description="Empty when a prefix was given.")
    completions: list[str] = Field(description="Whole sentences that begin with the prefix.")
    preview: Preview | None = Field(description="With a prefix and a session; none for an empty prefix.")


class StepResult(Answered):
    """Ticks that were run."""

    ticks: int
    decisions: list[Decision]
    state: State


class Parsed(Answered):
    """What a sentence means."""

    text: str
    actions: list[Action]
    source: Literal["grammar", "llm"]
    corrections: list[Correction]


class Verified(Answered):
    """What re-running the decision has shown of the causes; null where nothing is claimed."""

    necessary: bool | None
    sufficient: bool | None
    minimal: bool | None


class Answer(BaseModel):
    """The answer to a question: facts first, then words made from nothing else."""

    model_config = ConfigDict(extra="allow", defer_build=True)

    question: str
    about: str
    tick: Tick
    text: str


class Lateness(Answered):
    """How long after their time the latest ticks began."""

    ticks: int
    p50_ms: float
    p99_ms: float
    max_ms: float


class Health(Answered):
    """How the service does."""

    status: Literal["ok"]
    version: str
    sessions: int
    watchers: int
    tick_lateness: Lateness


class Ready(Answered):
    """The store answers."""

    status: Literal["ready"]


class FieldProblemModel(Answered):
    """What is wrong with one field."""

    field: str
    message: str


class ChoiceModel(Answered):
    """One reading of an ambiguous sentence."""

    text: str
    actions: list[Action]


class ProblemDocument(Answered):
    """An error, as in RFC 9457."""

    type: str
    title: str
    status: int
    detail: str
    errors: list[FieldProblemModel]
    reason: Literal["not_understood", "negation", "empty", "impossible"] | None = Field(
        None, description="Why a sentence was refused."
    )
    source: Literal["grammar", "llm"] | None = Field(None, description="Whose question it is.")
    unparsed: list[str] | None = None
    understood: list[str] | None = None
    suggestions: list[str] | None = None
    choices: list[ChoiceModel] | None = None
    sequence: int | None = Field(None, description="Where the session stands, if it was changed meanwhile.")
