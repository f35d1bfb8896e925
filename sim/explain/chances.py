"""How likely each end is after a move or a change, where it is left to chance how others react.

From the same futures as confidence (`sim.explain.futures`), with a part of their work, since two sides are
compared.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.explain.futures import Ends, find_ends
from sim.explain.question_error import QuestionError
from sim.plan import traits_of
from sim.state import FIRST, SimState
from sim.types import Mode, Outcome

PART: Final = 3
"""The work of one side is the work of a confidence divided by this."""


@dataclass(frozen=True, slots=True)
class Chances:
    """Shares of the futures of a moment by how they end."""

    arrives: float
    crashes: float
    stuck: float
    """still on the way when time is up, or proved to have no way left"""
    futures: int | None
    """how many were drawn; None where every future was run, and the shares are exact"""
    settled: bool
    """whether all futures end alike, at the same tick"""


def chances(
    state: SimState, ego: str | None = None, *, seen: bool, part: int = PART, even_certain: bool = False
) -> Chances | None:
    """The chances of an ego, the first by default; `seen`: whether it sees who reacts in the coming tick.

    The work is that of a confidence divided by `part`. None where nothing is left to chance (`even_certain`:
    the one end is found then), where a person drives, and where a planner does not answer.
    """
    if (state.config.certain and not even_certain) or (
        state.ego(ego).mode is Mode.MANUAL and state.world.outcome is Outcome.RUNNING
    ):
        return None
    most = traits_of(state.config_of(ego).planner).decisions_per_answer // part
    try:
        ends, drawn, _, _ = find_ends(state, ego or FIRST, most=most, seen=seen)
    except QuestionError:
        return None
    return shares(ends, drawn)


def shares(ends: Ends, drawn: int | None) -> Chances:
    """The chances of the ends of futures; `drawn`: how many were drawn, None where every one was run."""
    mass = dict.fromkeys((*Outcome, None), 0.0)
    for (outcome, _), chance in ends.items():
        mass[outcome] += chance
    total = sum(mass.values())
    return Chances(
        arrives=mass[Outcome.SUCCESS] / total,
        crashes=mass[Outcome.CRASH] / total,
        stuck=(mass[Outcome.STUCK] + mass[None]) / total,
        futures=drawn,
        settled=len(ends) == 1 and drawn is None,
    )
