"""A stretch of a run: its log, its moves at a glance, its changes, its worlds in a row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field

from service.contract.decision import Decision
from service.contract.model import Answered, Cell, DocumentedAs, Items, Model, Page, Tick, TickNumber
from service.contract.state import State

Now = Annotated[TickNumber, Field(description="The session's present tick.")]


@dataclass(frozen=True, slots=True)
class LogEvent(Model):
    """One line of the log."""

    number: int
    tick: Tick
    type: str
    text: str
    ids: tuple[str, ...]
    cell: Cell | None


@dataclass(frozen=True, slots=True)
class EventPage(Page[LogEvent]):
    """Lines of the log, oldest first."""

    items: tuple[LogEvent, ...]
    after: int
    """Send as `after` for what follows."""
    more: bool
    first_kept: int
    """Lines before this number are no longer kept."""


@dataclass(frozen=True, slots=True)
class TimelineMark(Model):
    """A tick that matters."""

    tick: Tick
    kind: Annotated[str, DocumentedAs(Literal["crash", "success", "stuck", "near_miss", "episode"])]
    """`near_miss`: a mover came into the cell that the ego had just left, and would have hit it had it
    stayed. `episode`: one begins."""
    ids: tuple[str, ...]
    cell: Cell | None


@dataclass(frozen=True, slots=True, kw_only=True)
class TimelinePage(Answered):
    """A stretch of a run."""

    first: Annotated[Tick, Field(alias="from")]
    now: Now
    moves: str
    """A letter for each tick from `from` on: F forward, L left, R right, l forward left, r forward right,
    s stay, - where the result of an episode stood."""
    marks: tuple[TimelineMark, ...]
    more: bool


@dataclass(frozen=True, slots=True)
class RoadChange(Model):
    """Something said or done that changed the road, and still stands."""

    tick: Tick
    sequence: int
    text: str
    """As it was said; of typed actions, the sentence that says the same."""
    said: bool
    """Whether it was said, rather than done by typed actions."""


@dataclass(frozen=True, slots=True)
class RoadChanges(Items[RoadChange]):
    """The newest changes that stand, oldest first."""

    items: tuple[RoadChange, ...]
    more: bool
    """Whether older ones are left out."""


@dataclass(frozen=True, slots=True)
class Moment(Model):
    """A world, with the decision that led to it."""

    state: State
    decision: Decision | None


@dataclass(frozen=True, slots=True)
class Moments(Items[Moment]):
    """Several ticks in a row."""

    items: tuple[Moment, ...]
    now: Now
