"""What the service answers, as frozen dataclasses.

Made from the documented answers and held against them by a test. How they are read is in `reading`; what
is no JSON, pictures and films, is in `media`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from service.client import notebook_html as html
from service.client.reading import Json, Result

Cell = tuple[int, int]
"""Column and row; row 0 is at the goal."""


@dataclass(frozen=True)
class Vehicle:
    """An autonomous vehicle."""

    id: str
    cell: Cell
    kind: str = "av"


@dataclass(frozen=True)
class Mover:
    """An obstacle vehicle or a pedestrian."""

    id: str
    kind: str
    cell: Cell
    heading: str
    disabled: bool


@dataclass(frozen=True)
class Hazard:
    """A pothole or a barrier."""

    id: str
    kind: str
    cell: Cell


@dataclass(frozen=True)
class CrashCause:
    """What a crash was with."""

    kind: str
    how: str
    ids: tuple[str, ...]
    cell: Cell


@dataclass(frozen=True)
class Metrics:
    """Figures over a session's episodes."""

    episodes: int
    successes: int
    crashes: int
    stuck: int
    success_rate: float | None
    steps: int
    moves: Mapping[str, int]
    distance_m: float
    last_episode_ticks: int | None


@dataclass(frozen=True, kw_only=True)
class State(Result):
    """The world at a tick."""

    session: str
    tick: int
    time_s: float
    episode: int
    episode_tick: int
    status: str
    cause: CrashCause | None
    columns: int
    rows: int
    visible_rows: int
    step_seconds: float
    paused: bool
    playback_speed: float | str = 1.0
    mode: str
    planner: str
    vehicles: tuple[Vehicle, ...]
    movers: tuple[Mover, ...]
    hazards: tuple[Hazard, ...]
    metrics: Metrics
    digest: str
    sequence: int
    undo: int = 0
    redo: int = 0

    def things(self) -> list[Vehicle | Mover | Hazard]:
        """Everything on the road, the autonomous vehicles last."""
        return [*self.hazards, *self.movers, *self.vehicles]

    def count(self, kind: str) -> int:
        """How many things of a kind are on the road: `state.count("pothole")`."""
        return sum(thing.kind == kind for thing in self.things())

    def _repr_html_(self) -> str:
        """The road near the vehicle, for notebooks."""
        return html.road(self)


@dataclass(frozen=True)
class Option:
    """One move as the planner saw it."""

    move: str
    cell: Cell | None
    verdict: str
    cost: float | None
    reason: str
    causes: tuple[str, ...]
    text: str = ""


@dataclass(frozen=True, kw_only=True)
class Decision(Result):
    """What was decided in the world of a tick; it leads to the next."""

    tick: int
    planner: str
    move: str
    asked: str | None
    options: tuple[Option, ...]
    narration: str
    weight: int

    def _repr_html_(self) -> str:
        """Every move and what spoke for or against it, for notebooks."""
        rows = [(option.move, option.verdict, option.cost, option.reason) for option in self.options]
        return html.table(self.narration, ("move", "verdict", "cost", "reason"), rows)


@dataclass(frozen=True)
class BlockedMove:
    """A move that could not be made, and why."""

    move: str
    reason: str
    causes: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class BriefDecision(Result):
    """A decision as a tick message tells it: of its options, only those that could not be taken."""

    tick: int
    planner: str
    move: str
    reason: str
    causes: tuple[str, ...]
    weight: int
    blocked: tuple[BlockedMove, ...] = ()


@dataclass(frozen=True)
class LogEvent:
    """One line of the log."""

    number: int
    tick: int
    type: str
    text: str
    ids: tuple[str, ...]
    cell: Cell | None


@dataclass(frozen=True)
class Parent:
    """Where a fork was taken; the session it was taken from may be deleted since."""

    id: str
    tick: int


@dataclass(frozen=True, kw_only=True)
class SessionInfo(Result):
    """A session as it stands."""

    id: str
    name: str | None
    created_at: str
    paused: bool
    playback_speed: float | str = 1.0
    mode: str
    tick: int
    episode: int
    status: str
    sequence: int
    seed: int
    config: Json
    language: str = "en"
    rules: int = 1
    rules_note: str | None = None
    sentence: str | None
    parent: Parent | None = None
    links: Mapping[str, str]


@dataclass(frozen=True, kw_only=True)
class SessionSummary(Result):
    """A session in a list."""

    id: str
    name: str | None
    created_at: str
    seed: int
    live: bool
    tick: int
    parent: Parent | None = None
    links: Mapping[str, str]


@dataclass(frozen=True)
class Change:
    """One figure that differs."""

    path: str
    before: Any
    after: Any


@dataclass(frozen=True)
class Correction:
    """A word that was read as another."""

    wrote: str = field(metadata={"key": "from"})
    read: str = field(metadata={"key": "to"})


@dataclass(frozen=True, kw_only=True)
class Answer(Result):
    """The answer to a question. What else there is depends on the question, and stands in `raw`."""

    question: str
    about: str
    tick: int
    text: str


@dataclass(frozen=True, kw_only=True)
class CommandResult(Result):
    """What was done."""

    text: str | None
    actions: tuple[Json, ...]
    changes: tuple[Change, ...]
    reply: str
    answer: Answer | None
    source: str
    sequence: int
    corrections: tuple[Correction, ...]
    dry_run: bool

    def _repr_html_(self) -> str:
        """The reply and what differs, for notebooks."""
        rows = [(change.path, change.before, change.after) for change in self.changes]
        return html.table(self.reply, ("what", "before", "after"), rows)


@dataclass(frozen=True, kw_only=True)
class ConfigChanged(Result):
    """What new settings did."""

    changes: tuple[Change, ...]
    reply: str
    sequence: int


@dataclass(frozen=True, kw_only=True)
class StepResult(Result):
    """Ticks that were run."""

    ticks: int
    decisions: tuple[Decision, ...]
    state: State

    def _repr_html_(self) -> str:
        """The road afterwards, for notebooks."""
        return html.road(self.state)


@dataclass(frozen=True, kw_only=True)
class Parsed(Result):
    """What a sentence means."""

    text: str
    actions: tuple[Json, ...]
    source: str
    corrections: tuple[Correction, ...]


@dataclass(frozen=True)
class SavedMoment:
    """A moment that was given a name."""

    name: str
    sequence: int
    tick: int


@dataclass(frozen=True, kw_only=True)
class SavedMoments(Result):
    """Moments with a name, by name."""

    items: tuple[SavedMoment, ...]

    def __iter__(self) -> Iterator[SavedMoment]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)

    def _repr_html_(self) -> str:
        """A table, for notebooks."""
        rows = [(each.name, each.tick) for each in self.items]
        return html.table(f"{len(rows)} saved", ("name", "tick"), rows)


@dataclass(frozen=True)
class SessionMoment(SavedMoment):
    """A moment that was given a name, and the session it is in."""

    session: str
    session_name: str | None
    links: Mapping[str, str]


@dataclass(frozen=True, kw_only=True)
class Link(Result):
    """A session at a tick as a piece of a URL; `carries`: whole, so that no service need keep it."""

    link: str
    tick: int
    carries: bool


@dataclass(frozen=True, kw_only=True)
class Ticket(Result):
    """Lets one socket in: its first message is `{"type": "auth", "ticket": ...}`."""

    ticket: str = field(repr=False)
    good_for_s: int


@dataclass(frozen=True, kw_only=True)
class Health(Result):
    """How the service does."""

    status: str
    version: str
    sessions: int
    watchers: int


@dataclass(frozen=True, kw_only=True)
class Ready(Result):
    """That the service's store answers."""

    status: str


@dataclass(frozen=True, kw_only=True)
class Recording(Result):
    """A session as one small file; `raw` is the file."""

    format: str
    version: int
    name: str | None
    tick: int
    digest: str
    entries: tuple[Json, ...]

    def save(self, path: str | Path) -> Path:
        """Write it; `roadtalk replay` and `Client.create(recording=...)` take it again."""
        written = Path(path)
        written.write_text(json.dumps(self.raw, ensure_ascii=False) + "\n", encoding="utf-8")
        return written
