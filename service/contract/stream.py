"""The messages of the stream, as the service sends them over sockets and server-sent events.

The service encodes the frequent ones by hand (`service.sessions.messages`); a test holds those bytes to these
models. `service.contract.stream_requests` has the messages that clients send.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator

from service.contract.command import Change, CommandResult
from service.contract.decision import BriefDecision, Decision
from service.contract.model import Answered, Cell, OutcomeName, Side, Tick
from service.contract.problem import ProblemDocument
from service.contract.session import Session
from service.contract.state import Metrics, State
from service.contract.timeline import LogEvent


@dataclass(frozen=True, slots=True, kw_only=True)
class Message(Answered):
    """Any message of the stream."""

    type: str


@dataclass(frozen=True, slots=True, kw_only=True)
class HelloMessage(Message):
    """The first message of a connection: everything to begin with."""

    type: Literal["hello"]
    protocol: int
    """Raised when a message changes its meaning; new keys do not raise it."""
    session: Session
    state: State
    log: tuple[LogEvent, ...]
    """The latest lines, oldest first."""
    decision: Decision | None
    """The latest decision."""
    sequence: int
    event: str
    """Id of the message, to resume after it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TickMessage(Message):
    """One tick: what moved, or the whole state where a new road begins."""

    type: Literal["tick"]
    tick: Tick
    sequence: int
    episode: int
    status: OutcomeName
    vehicles: Mapping[str, Cell] | None = None
    """Cells of the egos, by id; absent where `state` is there."""
    moved: Mapping[str, Cell] | None = None
    """Cells of the movers that changed theirs, by id; absent where `state` is there."""
    turned: Mapping[str, Side] | None = None
    """Headings of the movers that changed theirs, by id; absent where `state` is there."""
    state: State | None = None
    """The whole state where a new road begins; absent otherwise."""
    decision: BriefDecision | None
    narration: str | None
    events: tuple[LogEvent, ...]
    metrics: Metrics
    digest: str
    event: str
    """Id of the message, to resume after it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChangedMessage(Message):
    """A change that was accepted, whoever made it."""

    type: Literal["changed"]
    sequence: int
    text: str | None
    """What was said; null for typed actions."""
    reply: str
    changes: tuple[Change, ...]
    events: tuple[LogEvent, ...]
    state: State
    views: Mapping[str, bool] | None = None
    """Views to be shown (true) or hidden; absent where none is named."""
    event: str
    """Id of the message, to resume after it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateMessage(Message):
    """A full state for a reader that was too slow."""

    type: Literal["state"]
    missed: tuple[int, int] | None
    """The ticks it was not sent, first and last."""
    state: State
    event: str
    """Id of the message, to resume after it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GoneMessage(Message):
    """The session was deleted; the last message."""

    type: Literal["gone"]


@dataclass(frozen=True, slots=True, kw_only=True)
class StoppingMessage(Message):
    """The service stops: come back later. The last of the server-sent events; a socket is closed instead."""

    type: Literal["stopping"]
    code: Literal[1012]


@dataclass(frozen=True, slots=True, kw_only=True)
class ResultMessage(Message):
    """What came of a `command` or `actions`, under the id that was sent with it."""

    type: Literal["result"]
    id: str
    result: CommandResult
    replayed: bool | None = None
    """True where it was given before, under the same key."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ProblemMessage(Message):
    """Why a `command` or `actions` was refused, under the id that was sent with it."""

    type: Literal["problem"]
    id: str
    problem: ProblemDocument


@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorMessage(Message):
    """A message that could not be read, or a stream that cannot be opened."""

    type: Literal["error"]
    problem: ProblemDocument


@dataclass(frozen=True, slots=True, kw_only=True)
class PongMessage(Message):
    """The answer to `ping`."""

    type: Literal["pong"]


@dataclass(frozen=True, slots=True, kw_only=True)
class SubscribedMessage(Message):
    """The pictures that follow as binary messages."""

    type: Literal["subscribed"]
    frames: Literal["jpeg", "webp"]
    view: Literal["road", "schematic"]
    fps: int
    side: int
    """Pixels of the longer side."""
    theme: Literal["dark", "light"] = "dark"
    boxes: bool = True
    """Bounding boxes around what moves."""
    figures: bool = True
    """The strip of figures along the upper edge, and the result across the middle."""
    path: bool = True
    """The way behind the vehicle, its move and the next one."""
    forecast: bool = False
    """Where movers are expected in the next ticks."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnsubscribedMessage(Message):
    """No more pictures follow."""

    type: Literal["unsubscribed"]


StreamMessage: TypeAlias = Annotated[
    HelloMessage
    | TickMessage
    | ChangedMessage
    | StateMessage
    | GoneMessage
    | StoppingMessage
    | ResultMessage
    | ProblemMessage
    | ErrorMessage
    | PongMessage
    | SubscribedMessage
    | UnsubscribedMessage,
    Discriminator("type"),
]
"""Every message that the service sends."""
