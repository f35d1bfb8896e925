"""What an explanation states, in data. Whatever is said of a decision is said from these values."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

from sim.actions import Add, WorldAction
from sim.explain.alternatives import Alternatives
from sim.explain.question_error import QuestionError
from sim.plan import Decision
from sim.plan.rule_based import Leads
from sim.state import SimState
from sim.types import Cell, Kind, Move

__all__ = ["Cause", "Counterfactual", "Explanation", "Link", "QuestionError", "Role", "Verified", "check_ego"]


def check_ego(state: SimState, ego: str | None) -> None:
    """Raises `QuestionError` for an ego that is not on the road."""
    if ego is not None and ego not in state.egos:
        raise QuestionError("no_such_ego", id=ego)


class Role(StrEnum):
    """What part a thing has in a decision."""

    BLOCKS = "blocks"
    """it would have been met by a move preferred to the one taken"""
    DRIVES = "drives"
    """it made another cause go or stay where it blocks, or it shuts a way on"""
    FOLLOWS = "follows"
    """it would stand in the way once the others were gone"""
    WEIGHS = "weighs"
    """a preference or setting: it made another way dearer"""


@dataclass(frozen=True, slots=True)
class Cause:
    """One thing, preference or setting a decision hangs on."""

    id: str
    """of a thing; `preference:cautious`, `setting:safety_buffer`"""
    kind: Kind | Literal["preference", "setting"]
    cell: Cell | None
    """where it was when the decision was taken; None for what is no thing"""
    role: Role
    moves: tuple[Move, ...]
    """the moves it stands in the way of, if its role is `blocks`"""
    necessary: bool
    """whether the decision flips when this thing alone is taken away"""
    group: tuple[str, ...]
    """what must go together for the decision to flip: this one, and its stand-ins if any; empty where there
    are so many that it was not looked for, or not every part of it can be tried"""
    each_enough: bool = False
    """whether each of a group of several would have been enough by itself"""
    real: bool = True
    """whether it was there, in the cell in which it was seen; False for what a sensor made up or misplaced"""
    rest_blocks: bool = False
    """whether, with this one alone gone, others of its group meet the move that is made without the group"""


@dataclass(frozen=True, slots=True)
class Link:
    """What another thing has to do with something that stood in the way of a move."""

    blocker: str
    by: str | None
    """without it the blocker is not in the way; if `behind`, it is in the way itself without the blocker, or
    closes the way on from there; None where the cell is free without the blocker, and yet not entered"""
    move: Move
    behind: bool = False
    leads: Leads | None = None
    """where the move leads if its cell is free without the blocker, of a planner that goes by that"""


@dataclass(frozen=True, slots=True)
class Counterfactual:
    """What was decided when the tick was run again on a changed road, or with something not detected."""

    change: tuple[WorldAction, ...]
    """made on the road; then the sensor looks again"""
    move: Move
    removed: tuple[str, ...] = ()
    """the names of what was taken away"""
    undetected: tuple[str, ...] = ()
    """of these, the ids that were taken out of what is seen: no change of the road does the same"""

    @property
    def added(self) -> tuple[tuple[str, Cell], ...]:
        """What was put in the way, and where: kinds and cells."""
        return tuple(
            (action.kind, action.where.cell)
            for action in self.change
            if isinstance(action, Add) and action.where is not None and action.where.cell is not None
        )


@dataclass(frozen=True, slots=True)
class Verified:
    """What re-running has shown of the causes; None where nothing is claimed."""

    necessary: bool | None
    """taking away any one of them changes the decision (for `why_not`: leaving any one keeps it)"""
    sufficient: bool | None
    """with nothing but them seen on the road it is the same (for `why_not`: without them the move is made)"""
    minimal: bool | None
    """no part of them would do"""


@dataclass(frozen=True, slots=True)
class Explanation:
    """The answer to why, or why not, in facts."""

    about: str
    """`why` or `why_not`"""
    moment: SimState
    """the state it was decided in"""
    decision: Decision
    foil: Move | None
    """the move asked about in `why_not`; for `why` the one it was taken instead of, if there is one"""
    causes: tuple[Cause, ...]
    """the most telling first"""
    verified: Verified
    counterfactuals: tuple[Counterfactual, ...]
    """one for each cause or group, in the order of the causes; without causes, the move's cell blocked"""
    stakes: Alternatives | None
    """what the foil would have led to; None without one, or where it leads off the road"""
    reruns: int
    """how often the decision was run again for this answer"""
    also: tuple[Cause, ...] = ()
    """of `why`: causes beside `causes`, with their groups: they flip the decision by themselves, or are told
    to be in the way"""
    chain: tuple[Link, ...] = ()
    """of `why`: what stood in the way because of something else"""
    untried: tuple[str, ...] = ()
    """of `why`: things seen that were not tried by themselves, and might flip the decision too"""
    searched: int = 0
    """of `why_not`: edits up to which every change was tried for one that leads to the foil"""
    tried: int = 0
    """of `why_not`: changes that were tried"""
