"""The world at a tick: what is on the road, and the figures beside it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import Field

from service.contract import notebook_html as html
from service.contract.model import (
    Answered,
    Cell,
    DocumentedAs,
    EgoKind,
    HazardKind,
    KindName,
    Model,
    ModeName,
    MoverKind,
    OutcomeName,
    Side,
    Tick,
)
from service.sessions.scheduler.playback_speed import FASTEST, SLOWEST
from sim.actions import TimeOfDay, Weather

PlaybackSpeed = Annotated[
    float | Literal["max"],
    DocumentedAs(Annotated[float, Field(ge=SLOWEST, le=FASTEST)] | Literal["max"]),
    Field(description="How fast the clock plays the session; `max`: as fast as possible. Affects no world."),
]


@dataclass(frozen=True, slots=True)
class Vehicle(Model):
    """An ego: a vehicle that a planner or a person drives. Other vehicles are movers."""

    id: str
    kind: EgoKind
    cell: Cell


@dataclass(frozen=True, slots=True)
class Mover(Model):
    """An obstacle vehicle or a pedestrian."""

    id: str
    kind: MoverKind
    cell: Cell
    heading: Side
    disabled: bool
    """Whether a pothole holds it."""


@dataclass(frozen=True, slots=True)
class Hazard(Model):
    """A pothole or a barrier."""

    id: str
    kind: HazardKind
    cell: Cell


@dataclass(frozen=True, slots=True)
class CrashCause(Model):
    """What an ego crashed with.

    Met in one cell (`hit`), passing through one another (`swap`), or cut off on a diagonal (`cross`).
    """

    kind: KindName
    how: Annotated[str, DocumentedAs(Literal["hit", "swap", "cross"])]
    ids: tuple[str, ...]
    cell: Cell


@dataclass(frozen=True, slots=True)
class MoveCounts(Model):
    """How often each sort of move was made."""

    forward: int
    lateral: int
    diagonal: int
    stay: int


@dataclass(frozen=True, slots=True)
class Metrics(Model):
    """Totals over the episodes of a session."""

    episodes: int
    """Episodes that have ended."""
    successes: int
    crashes: int
    stuck: int
    success_rate: float | None
    steps: int
    moves: MoveCounts
    distance_m: float
    last_episode_ticks: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule(Model):
    """A rule that stands: "every 10 ticks add a car"."""

    number: int
    """By which it is cancelled; never used again in the session."""
    text: str
    """The rule in the language of the session."""
    since: Tick
    """The tick at which it was made."""
    fired: int
    """How often it has been done."""
    action: dict[str, Any]
    """The action that made it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class State(Answered):
    """The world at a tick."""

    session: str
    tick: Tick
    time_s: float
    """Simulated seconds since the session began."""
    episode: int
    episode_tick: int
    status: OutcomeName
    cause: CrashCause | None
    columns: int
    rows: int
    visible_rows: int
    step_seconds: float
    paused: bool
    playback_speed: PlaybackSpeed
    mode: ModeName
    planner: str
    sensor: str
    """What the egos see with."""
    weather: Annotated[str, DocumentedAs(Weather)]
    time_of_day: Annotated[str, DocumentedAs(TimeOfDay)]
    vehicles: tuple[Vehicle, ...]
    """The egos, in order of their ids."""
    movers: tuple[Mover, ...]
    hazards: tuple[Hazard, ...]
    metrics: Metrics
    digest: str
    """Equal exactly when two worlds are equal."""
    sequence: int
    """Changes the session has accepted."""
    undo: int
    """How many changes can be undone, one after the other."""
    redo: int
    """How many undone changes can be made again."""
    rules: tuple[Rule, ...] = ()
    """The rules that stand, in the order of their numbers."""

    def things(self) -> list[Vehicle | Mover | Hazard]:
        """Everything on the road, the egos last."""
        return [*self.hazards, *self.movers, *self.vehicles]

    def count(self, kind: str) -> int:
        """How many things of a kind are on the road: `state.count("pothole")`."""
        return sum(thing.kind == kind for thing in self.things())

    def _repr_html_(self) -> str:
        """The road near the ego, for notebooks."""
        return html.road(self)
