"""The messages that clients send over a socket. Unknown keys and values of another type are refused."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field

from service.actions import Action
from service.contract.model import Tick
from service.contract.requests import AT_TICK, MAX_ACTIONS, Sent, Strictly
from service.contract.text import StorableText

Id = Annotated[str, Field(max_length=100, description="Chosen by the client, given back with the answer.")]

Key = Annotated[
    str | None,
    Field(
        pattern="^[!-~]+$",
        max_length=255,
        description="Chosen by the client: done once under this key, and answered the same for 24 hours.",
    ),
]


class Command(Sent):
    """Something said."""

    type: Literal["command"]
    id: Id
    text: StorableText
    dry_run: bool = False
    language: str | None = Field(None, max_length=16)
    at_tick: Tick | None = Field(None, description=AT_TICK)
    key: Key = None


class Actions(Sent):
    """Typed actions."""

    type: Literal["actions"]
    id: Id
    actions: Strictly[list[Action]] = Field(min_length=1, max_length=MAX_ACTIONS)
    dry_run: bool = False
    at_tick: Tick | None = Field(None, description=AT_TICK)
    key: Key = None


class Ping(Sent):
    """Asks for a `pong`."""

    type: Literal["ping"]


class Subscribe(Sent):
    """Asks for pictures as well; a second one takes the place of the first."""

    type: Literal["subscribe"]
    frames: Literal["jpeg", "webp"]
    view: Literal["road", "schematic"] = "road"
    fps: int = Field(30, ge=1, le=60)
    side: int = Field(480, ge=64, le=1080)
    theme: Literal["dark", "light"] = "dark"
    boxes: bool = Field(True, description="Bounding boxes around what moves.")
    figures: bool = Field(
        True, description="The strip of figures along the upper edge, and the result across the middle."
    )
    path: bool = Field(True, description="The way behind the vehicle, its move and the next one.")
    forecast: bool = Field(False, description="Where movers are expected in the next ticks.")


class Unsubscribe(Sent):
    """Asks for no more pictures."""

    type: Literal["unsubscribe"]


class Auth(Sent):
    """The first message of a socket where the service asks for a key: the key, or a ticket."""

    type: Literal["auth"]
    key: str | None = Field(default=None, max_length=1_000)
    ticket: str | None = Field(default=None, max_length=100)


StreamRequest: TypeAlias = Annotated[
    Command | Actions | Ping | Subscribe | Unsubscribe, Discriminator("type")
]
"""Every message that a client sends once it is let in."""
