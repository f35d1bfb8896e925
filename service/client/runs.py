"""What is answered about a run as a whole: stretches of it, what is to come, what would have been."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from service.client import notebook_html as html
from service.client.reading import Result
from service.client.results import BriefDecision, Cell, CrashCause, Decision, State


@dataclass(frozen=True)
class TimelineMark:
    """A tick that matters: a `crash`, a `success`, `stuck`, a `near_miss`, or an `episode` that begins."""

    tick: int
    kind: str
    ids: tuple[str, ...]
    cell: Cell | None


@dataclass(frozen=True, kw_only=True)
class Timeline(Result):
    """A stretch of a run; `moves` has a letter for each tick from `first` on."""

    first: int = field(metadata={"key": "from"})
    now: int
    moves: str
    marks: tuple[TimelineMark, ...]
    more: bool


@dataclass(frozen=True)
class RoadChange:
    """Something said or done that changed the road, and still stands."""

    tick: int
    sequence: int
    text: str
    said: bool


@dataclass(frozen=True, kw_only=True)
class RoadChanges(Result):
    """The newest changes that stand, oldest first; `more`: older ones are left out."""

    items: tuple[RoadChange, ...]
    more: bool

    def __iter__(self) -> Iterator[RoadChange]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)


@dataclass(frozen=True)
class Moment:
    """A world, with the decision that led to it."""

    state: State
    decision: Decision | None


@dataclass(frozen=True, kw_only=True)
class Moments(Result):
    """Several ticks in a row."""

    items: tuple[Moment, ...]
    now: int

    def __iter__(self) -> Iterator[Moment]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)


@dataclass(frozen=True)
class ExpectedTick:
    """Where movers are expected to be at a tick to come, by id."""

    tick: int
    movers: Mapping[str, Cell]


@dataclass(frozen=True, kw_only=True)
class Expected(Result):
    """What the vehicle is about to do, and where the movers will be; `exact`: no chance is in it."""

    tick: int
    decision: Decision | None
    exact: bool
    ahead: tuple[ExpectedTick, ...]


@dataclass(frozen=True)
class JudgedDecision:
    """A decision against the best that could have been done; None where the goal was out of reach."""

    tick: int
    move: str
    blocked: int
    ticks: int | None
    cost: int | None
    lost: bool


@dataclass(frozen=True, kw_only=True)
class Judged(Result):
    """Decisions in a row, each with its regret."""

    first: int = field(metadata={"key": "from"})
    now: int
    items: tuple[JudgedDecision, ...]
    more: bool

    def __iter__(self) -> Iterator[JudgedDecision]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)

    def _repr_html_(self) -> str:
        """A table, for notebooks."""
        rows = [(each.tick, each.move, each.ticks, each.cost) for each in self.items]
        return html.table("Against the best", ("tick", "move", "ticks lost", "cost lost"), rows)


@dataclass(frozen=True)
class PlayedTick:
    """What one tick changed: what `moved`, or the whole `state` where a road begins."""

    tick: int
    episode: int
    status: str
    decision: BriefDecision | None
    cause: CrashCause | None
    vehicles: Mapping[str, Cell] | None = None
    moved: Mapping[str, Cell] | None = None
    turned: Mapping[str, str] | None = None
    state: State | None = None


@dataclass(frozen=True)
class End:
    """How a run ends, if nothing more is said."""

    outcome: str
    tick: int
    driven: int
    waited: int
    by_hand: bool
    cause: CrashCause | None
    digest: str
    text: str = ""


@dataclass(frozen=True)
class Side:
    """One of two runs: where it begins, its ticks, how it ends."""

    state: State
    ticks: tuple[PlayedTick, ...]
    end: End


@dataclass(frozen=True, kw_only=True)
class Counterfactual(Result):
    """The real run from a tick on, and the other."""

    at_tick: int
    instead_of: str | None
    said_since: int
    real: Side
    changed: Side
    text: str = ""
