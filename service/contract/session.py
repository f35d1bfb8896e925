"""Sessions, the moments saved in them and the links that lead to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Field

from service.contract import notebook_html as html
from service.contract.command import PendingQuestion
from service.contract.model import Answered, Items, Model, ModeName, OutcomeName, Page, Tick, TickNumber
from service.contract.state import PlaybackSpeed


@dataclass(frozen=True, slots=True)
class Parent(Model):
    """Where a fork was taken; the session it was taken from may be deleted since."""

    id: str
    tick: Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class Session(Answered):
    """A session as it stands."""

    id: str
    name: str | None
    created_at: str
    paused: bool
    playback_speed: PlaybackSpeed
    mode: ModeName
    tick: Tick
    episode: int
    status: OutcomeName
    sequence: int
    """Changes the session has accepted."""
    seed: int
    config: Mapping[str, Any]
    language: str = "en"
    """The code of the language that its log and narration are in."""
    rules: Annotated[int, Field(examples=[2])]
    """The version of the rules that it runs under."""
    rules_note: Annotated[str | None, Field(examples=["Made under rules 1: it replays as it did then."])]
    """What to tell whoever opens it, where these are not the rules of today."""
    sentence: str | None
    """What to say for a road like this one; null where no sentence describes it."""
    pending: PendingQuestion | None = None
    """The question that the session asked last, while nobody has answered it."""
    parent: Parent | None
    """Of a fork, or a session that a link opened; else null."""
    watchers: int = 0
    """Open streams of it, sockets and events alike."""
    links: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionSummary(Answered):
    """A session in a list. One that is not live is restored when it is asked for."""

    id: str
    name: str | None
    created_at: str
    seed: int
    live: bool
    tick: TickNumber
    """The session's tick, or where it was last stored."""
    parent: Parent | None
    """Of a fork, or a session that a link opened; else null."""
    links: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class SessionPage(Page[SessionSummary]):
    """Sessions, newest first."""

    items: tuple[SessionSummary, ...]
    after: str | None
    """Send as `after` for what follows."""
    more: bool


@dataclass(frozen=True, slots=True)
class SavedMoment(Model):
    """A moment of a session that was given a name."""

    name: str
    sequence: int
    """The change that named it."""
    tick: Tick


@dataclass(frozen=True, slots=True)
class SavedMoments(Items[SavedMoment]):
    """The named moments of a session, by name."""

    items: tuple[SavedMoment, ...]

    def _repr_html_(self) -> str:
        """A table, for notebooks."""
        rows = [(each.name, each.tick) for each in self.items]
        return html.table(f"{len(rows)} saved", ("name", "tick"), rows)


@dataclass(frozen=True, slots=True)
class SessionMoment(SavedMoment):
    """A named moment, and the session it is in."""

    session: str
    session_name: str | None
    links: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class MomentPage(Page[SessionMoment]):
    """Named moments of all sessions, those named last first."""

    items: tuple[SessionMoment, ...]
    after: str | None
    """Send as `after` for what follows."""
    more: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Link(Answered):
    """A session at a tick as a piece of a URL."""

    link: str
    """`#/r/...` carries the session, `#/s/...` names it."""
    tick: Tick
    carries: bool
    """Whether the link holds the whole session, so that no service need keep it."""
