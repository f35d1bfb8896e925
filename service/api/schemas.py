"""The documented shape of everything answered. Answers are not encoded through these.

A test holds real answers against them, so that they cannot drift from `service.wire`.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from service.actions import Action
from service.api.bodies import Tick
from service.sessions.pace import FASTEST, SLOWEST
from sim.actions import Weather
from sim.advice import Choice, Ending
from sim.kinds import Kind, Mode, Move, Outcome

CellPair = Annotated[
    list[int], Field(min_length=2, max_length=2, description="[column, row], row 0 at the goal")
]

PlaybackSpeed = Annotated[
    Annotated[float, Field(ge=SLOWEST, le=FASTEST)] | Literal["max"],
    Field(description="How fast the clock plays it; `max` is as fast as possible. No world knows of it."),
]


class Answered(BaseModel):
    """What callers are answered."""

    model_config = ConfigDict(extra="forbid")


class Vehicle(Answered):
    """An autonomous vehicle."""

    id: str
    kind: Literal[Kind.AV]
    cell: CellPair


class Mover(Answered):
    """An obstacle vehicle or a pedestrian."""

    id: str
    kind: Literal[Kind.VEHICLE, Kind.PEDESTRIAN]
    cell: CellPair
    heading: Literal["left", "right"]
    disabled: bool = Field(description="Held by a pothole.")


class Hazard(Answered):
    """A pothole or a barrier."""

    id: str
    kind: Literal[Kind.POTHOLE, Kind.BARRIER]
    cell: CellPair


class CrashCause(Answered):
    """What a crash was with: met in one cell (`hit`), or passing through one another (`swap`)."""

    kind: Kind
    how: Literal["hit", "swap"]
    ids: list[str]
    cell: CellPair


class MoveCounts(Answered):
    """How often each sort of move was made."""

    forward: int
    lateral: int
    diagonal: int
    stay: int


class Metrics(Answered):
    """Figures over the session's episodes."""

    episodes: int = Field(description="Episodes that have ended.")
    successes: int
    crashes: int
    stuck: int
    success_rate: float | None
    steps: int
    moves: MoveCounts
    distance_m: float
    last_episode_ticks: int | None


class State(Answered):
    """The world at a tick."""

    session: str
    tick: Tick
    time_s: float = Field(description="Simulated seconds since the session began.")
    episode: int
    episode_tick: int
    status: Outcome
    cause: CrashCause | None
    columns: int
    rows: int
    visible_rows: int
    step_seconds: float
    paused: bool
    playback_speed: PlaybackSpeed
    mode: Mode
    planner: str
    vehicles: list[Vehicle]
    movers: list[Mover]
    hazards: list[Hazard]
    metrics: Metrics
    digest: str = Field(description="Equal exactly when two worlds are.")
    sequence: int = Field(description="Changes the session has accepted.")


class Option(Answered):
    """One move as the planner saw it."""

    move: Move
    cell: CellPair | None
    verdict: Literal["free", "blocked", "off_road"]
    cost: float | None
    reason: str
    causes: list[str]


class Decision(Answered):
    """What was decided in the world of a tick; it leads to the next."""

    tick: Tick
    planner: str
    move: Move
    asked: Move | None = Field(description="What a person driving asked for.")
    options: list[Option]
    narration: str
    weight: Literal[0, 1, 2] = Field(
        description="How much there is to say: 0 nothing was in the way, 1 a way round, 2 a wait or worse."
    )


class LogEvent(Answered):
    """One line of the log."""

    number: int
    tick: Tick
    type: str
    text: str
    ids: list[str]
    cell: CellPair | None


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
    sentence: str | None = Field(description="What to say for a road like this one; null where nothing does.")
    links: dict[str, str]


class SavedMoment(Answered):
    """A moment of a session that was given a name."""

    name: str
    sequence: int = Field(description="The change that named it.")
    tick: Tick


class SavedMoments(Answered):
    """Moments with a name, by name."""

    items: list[SavedMoment]


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


class LanguageGuide(Answered):
    """What can be said."""

    language: str
    languages: list[str]
    prefix: str | None
    intents: list[IntentGuide] = Field(description="Empty when a prefix was given.")
    taught: list[TaughtPhrase] = Field(description="Empty when a prefix was given.")
    completions: list[str] = Field(description="Whole sentences that begin with the prefix.")


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


class AnswerCause(Answered):
    """One thing a decision hangs on."""

    id: str
    kind: Kind
    cell: CellPair
    role: str


class Verified(Answered):
    """What re-running the decision has shown of the causes; null where nothing is claimed."""

    necessary: bool | None
    sufficient: bool | None
    minimal: bool | None


class Answer(BaseModel):
    """The answer to a question: facts first, then words made from nothing else."""

    model_config = ConfigDict(extra="allow")

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


Share = Annotated[float, Field(ge=0, le=1)]
Interval = Annotated[list[Share], Field(min_length=2, max_length=2, description="95 % interval")]


class AdviceOption(Answered):
    """What one choice leads to."""

    option: Choice
    chance: Share = Field(description="Of never reaching the hazard, or too slowly to be harmed.")
    interval: Interval
    ending: Ending = Field(description="With every quantity in the middle of its range.")
    needs_m: float = Field(description="The distance in which it avoids the hazard.")
    meets_kmh: float = Field(description="Speed at the hazard; 0: not reached.")
    harm_kmh: float = Field(description="Mean speed at which harm is done; 0 counts where none is.")


class AdvicePhysics(Answered):
    """The physics, with every quantity in the middle of its range."""

    speed_ms: float
    time_s: float = Field(description="Until the hazard is reached if nothing is done.")
    reaction_s: float
    friction: float
    deceleration_ms2: float
    reaction_m: float
    braking_m: float
    stopping_m: float = Field(description="Reaction and braking: v·t + v²/(2·μ·g).")
    stopping_most_m: float = Field(description="Enough to stop in 95 % of cases.")
    offset_m: float = Field(description="How far to move aside.")
    lateral_ms2: float
    steering_s: float = Field(description="To move that far aside: sqrt(2·y/a).")
    steering_m: float = Field(description="Driven meanwhile, reaction included.")
    unharmed_kmh: float = Field(description="Up to this speed the hazard can be driven over.")


class AdviceQuantity(Answered):
    """A number that the advice rests on, and where it is from."""

    name: str
    law: Literal["lognormal", "normal", "fixed"]
    middle: float = Field(description="Median, or mean of a normal quantity.")
    spread: float = Field(description="Standard deviation; of the logarithm, where lognormal.")
    unit: str
    source: str


class Advice(Answered):
    """What to do about a hazard ahead, how sure that is, and the physics behind it."""

    question: str
    text: str
    source: Literal["typed", "grammar", "llm"]
    hazard: Kind
    distance_m: float
    speed_kmh: float
    weather: Weather
    recommendation: Choice
    confidence: Share = Field(description="The chance of coming away unharmed by doing so.")
    interval: Interval
    options: list[AdviceOption]
    physics: AdvicePhysics
    parameters: list[AdviceQuantity]
    samples: int
    seed: int
