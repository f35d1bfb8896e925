"""The documented shape of a road's parts: what is on it, what was decided, what its log tells.

`schemas` makes the answers of these.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field

from service.contract.requests import Tick
from service.sessions.scheduler.playback_speed import FASTEST, SLOWEST
from sim.types import HAZARDS, MOVERS, Kind, Mode, Move, Outcome

CellPair = Annotated[
    list[int], Field(min_length=2, max_length=2, description="[column, row], row 0 at the goal")
]

PlaybackSpeed = Annotated[
    Annotated[float, Field(ge=SLOWEST, le=FASTEST)] | Literal["max"],
    Field(description="How fast the clock plays it; `max` is as fast as possible. No world knows of it."),
]


class Answered(BaseModel):
    """What callers are answered."""

    model_config = ConfigDict(extra="forbid", defer_build=True)


if TYPE_CHECKING:
    MoverKind: TypeAlias = Kind
    HazardKind: TypeAlias = Kind
else:
    MoverKind, HazardKind = Literal[MOVERS], Literal[HAZARDS]


class Vehicle(Answered):
    """An autonomous vehicle."""

    id: str
    kind: Literal[Kind.AV]
    cell: CellPair


class Mover(Answered):
    """An obstacle vehicle or a pedestrian."""

    id: str
    kind: MoverKind
    cell: CellPair
    heading: Literal["left", "right"]
    disabled: bool = Field(description="Held by a pothole.")


class Hazard(Answered):
    """A pothole or a barrier."""

    id: str
    kind: HazardKind
    cell: CellPair


class CrashCause(Answered):
    """What a crash was with.

    Met in one cell (`hit`), passing through one another (`swap`), or cut off on a diagonal (`cross`).
    """

    kind: Kind
    how: Literal["hit", "swap", "cross"]
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
    undo: int = Field(description="How many changes can be taken back, one after the other.")
    redo: int = Field(description="How many that were taken back can be made again.")


class Option(Answered):
    """One move as the planner saw it."""

    move: Move
    cell: CellPair | None
    verdict: Literal["free", "blocked", "off_road"]
    cost: float | None
    reason: str
    causes: list[str]
    text: str = Field(description="What spoke for or against it, in a few words.")


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
