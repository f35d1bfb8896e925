"""Actions that steer the clock, the history and the views of a session; they hold no other action."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from annotated_types import Ge, Le, MaxLen, MinLen

from sim.actions import Pause as Pause

STRICT = {"extra": "forbid"}
"""Pydantic's setting for every action: unknown keys are refused."""

Ticks = Annotated[int, Ge(1), Le(10_000)]
Steps = Annotated[int, Ge(1), Le(10_000)] | Literal["all"]
"""How many changes to undo or to redo."""

Name = Annotated[str, MinLen(1), MaxLen(80)]
ViewName = Literal["road", "schematic", "occupancy", "plan", "log", "potholes", "sensors", "path", "metrics"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Resume:
    """Start the clock."""

    do: Literal["resume"] = "resume"

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Undo:
    """Take back the latest changes (`steps`, by default one), as if they had never been said."""

    do: Literal["undo"] = "undo"
    steps: Steps | None = None

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Redo:
    """Say again what was undone last (`steps` changes, by default one)."""

    do: Literal["redo"] = "redo"
    steps: Steps | None = None

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """Run some ticks at once, and stay paused after them."""

    do: Literal["step"] = "step"
    ticks: Ticks

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Rewind:
    """Go back some ticks, or to a tick, the latest crash, the start of the episode or of the session."""

    do: Literal["rewind"] = "rewind"
    ticks: Ticks | None = None
    to: Annotated[int, Ge(0)] | Literal["crash", "episode", "start"] | None = None

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        if (self.ticks is None) == (self.to is None):
            raise ValueError("say either 'ticks' or 'to'")


@dataclass(frozen=True, slots=True, kw_only=True)
class Show:
    """Show a view."""

    do: Literal["show"] = "show"
    view: ViewName

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Hide:
    """Hide a view."""

    do: Literal["hide"] = "hide"
    view: ViewName

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Save:
    """Keep the session under a name."""

    do: Literal["save"] = "save"
    name: Name

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Load:
    """Go on from what was saved under a name."""

    do: Literal["load"] = "load"
    name: Name

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Drop:
    """Drop the question that is pending, so that nothing answers it any more."""

    do: Literal["drop"] = "drop"

    __pydantic_config__ = STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """Start or stop recording."""

    do: Literal["record"] = "record"
    on: bool

    __pydantic_config__ = STRICT


ChatKind = Literal[
    "greeting",
    "farewell",
    "thanks",
    "praise",
    "apology",
    "okay",
    "complaint",
    "identity",
    "joke",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Chat:
    """Small talk: one short line in return, and nothing else."""

    do: Literal["chat"] = "chat"
    kind: ChatKind

    __pydantic_config__ = STRICT
