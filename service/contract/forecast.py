"""What is expected of the ticks to come, and what decisions cost against the best."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from service.contract import notebook_html as html
from service.contract.decision import Decision
from service.contract.model import Answered, Cell, Items, Model, MoveName, Tick
from service.contract.timeline import Now


@dataclass(frozen=True, slots=True)
class ExpectedTick(Model):
    """Where movers are expected to be at a tick to come."""

    tick: Tick
    movers: Mapping[str, Cell]
    """Their cells, by id."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Expected(Answered):
    """What is expected at a tick: what the ego is about to do, and where the movers will be."""

    tick: Tick
    decision: Decision | None
    """The decision taken at it; null where a result stands."""
    exact: bool
    """Whether it is certain: false beyond the first tick where movers react to the ego."""
    ahead: tuple[ExpectedTick, ...]
    path: tuple[Cell, ...] = ()
    """The ego's own cells in the ticks to come, as many as were asked for, until its episode ends.

    It is driven on in the simulator, as if nobody said anything."""


@dataclass(frozen=True, slots=True)
class JudgedDecision(Model):
    """A decision against the best that could have been done at its moment."""

    tick: Tick
    move: MoveName
    blocked: int
    """How many of the six moves would have ended badly or off the road."""
    ticks: int | None
    """Ticks lost; null where the goal is, or was, out of reach."""
    cost: int | None
    """Cost lost, by the configuration's charges; null as for `ticks`."""
    lost: bool
    """Whether the goal could be reached before the move, and not after it."""
    clearance_m: float | None = None
    """From the vehicle to what is nearest on the road, centre to centre; null where nothing else is there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged(Items[JudgedDecision]):
    """Decisions in a row, each with its regret."""

    first: Annotated[Tick, Field(alias="from")]
    now: Now
    items: tuple[JudgedDecision, ...]
    """None for ticks at which a result stood."""
    more: bool

    def _repr_html_(self) -> str:
        """A table, for notebooks."""
        rows = [(each.tick, each.move, each.ticks, each.cost) for each in self.items]
        return html.table("Against the best", ("tick", "move", "ticks lost", "cost lost"), rows)
