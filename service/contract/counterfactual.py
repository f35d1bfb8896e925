"""The documented shape of a counterfactual beside the real run."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from service.contract.parts import Answered, CellPair, CrashCause, State
from service.contract.requests import Tick
from sim.types import Move, Outcome


class BlockedMove(Answered):
    """A move that could not be made, and why."""

    move: Move
    reason: str
    causes: list[str]


class BriefDecision(Answered):
    """A decision in few words, as the stream tells it."""

    tick: Tick
    planner: str
    move: Move
    reason: str
    causes: list[str]
    weight: Literal[0, 1, 2]
    blocked: list[BlockedMove]


class PlayedTick(Answered):
    """What one tick changed: what moved, or the whole state where a road begins."""

    tick: Tick
    episode: int
    status: Outcome
    vehicles: dict[str, CellPair] | None = None
    moved: dict[str, CellPair] | None = None
    turned: dict[str, Literal["left", "right"]] | None = None
    state: State | None = None
    decision: BriefDecision | None
    cause: CrashCause | None


class End(Answered):
    """How a run ends, if nothing more is said."""

    outcome: Outcome = Field(description="`running` where it is not told to its end.")
    tick: Tick
    driven: int = Field(description="Ticks on the road, without those waited for it.")
    waited: int
    by_hand: bool = Field(description="Whether a person drives, who asked for nothing.")
    cause: CrashCause | None
    digest: str
    text: str = Field(description="The end in a few words.")


class Side(Answered):
    """One of the two runs."""

    state: State = Field(description="Where it begins.")
    ticks: list[PlayedTick]
    end: End


class Counterfactual(Answered):
    """The real run from a tick on, and the other."""

    at_tick: Tick
    instead_of: Move | None = Field(description="The move that was made, where another is asked about.")
    text: str = Field(description="What differs, in a sentence or two.")
    said_since: int = Field(description="Actions said after that tick, left out of both.")
    real: Side
    changed: Side
