"""A counterfactual run beside the real one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from service.contract.decision import BriefDecision
from service.contract.model import Answered, Cell, Model, MoveName, OutcomeName, Tick
from service.contract.model import Side as Direction
from service.contract.state import CrashCause, State


@dataclass(frozen=True, slots=True, kw_only=True)
class PlayedTick(Model):
    """What one tick changed: what moved, or the whole state where a road begins."""

    tick: Tick
    episode: int
    status: OutcomeName
    vehicles: Mapping[str, Cell] | None = None
    """Cells of the egos, by id."""
    moved: Mapping[str, Cell] | None = None
    """Cells of the movers that changed theirs, by id."""
    turned: Mapping[str, Direction] | None = None
    """Headings of the movers that changed theirs, by id."""
    state: State | None = None
    decision: BriefDecision | None
    cause: CrashCause | None


@dataclass(frozen=True, slots=True)
class End(Model):
    """How a run ends, if nothing more is said."""

    outcome: OutcomeName
    """`running` where it is not told to its end."""
    tick: Tick
    driven: int
    """Ticks on the road, without those waited for it."""
    waited: int
    by_hand: bool
    """Whether a person drives, who asked for nothing."""
    cause: CrashCause | None
    digest: str
    text: str = ""
    """The end in a few words."""


@dataclass(frozen=True, slots=True)
class Side(Model):
    """One of the two runs."""

    state: State
    """Where it begins."""
    ticks: tuple[PlayedTick, ...]
    end: End


@dataclass(frozen=True, slots=True)
class PartingMove(Model):
    """What one of the two does where they part."""

    move: MoveName
    text: str
    """The move and its reason in a sentence."""


@dataclass(frozen=True, slots=True)
class Parting(Model):
    """The first tick at which the two decide differently."""

    tick: Tick
    real: PartingMove
    changed: PartingMove


@dataclass(frozen=True, slots=True, kw_only=True)
class Counterfactual(Answered):
    """The real run from a tick on, and the other."""

    at_tick: Tick
    instead_of: MoveName | None
    """The move that was made, where another is asked about."""
    said_since: int
    """How many actions were said after that tick. Neither run includes them."""
    real: Side
    changed: Side
    text: str = ""
    """What differs, in a sentence or two."""
    parting: Parting | None = None
    """Where they first decide differently; null where they never do."""
