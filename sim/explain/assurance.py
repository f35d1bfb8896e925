"""How sure it is that the ego keeps clear: whatever the others do, likely, or merely possible.

`WHATEVER` is proved by a search among all cells where others may be (`sim.search.robust_reachability`).
`LIKELY` rests on the futures of confidence, in which the others keep to their rules; `POSSIBLE` on one way
that is open if they do as expected. All three are of the ground truth, whatever the sensors show.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from sim.forecast import Forecast
from sim.search.reachability import steps_left
from sim.search.robust_reachability import Guarantee, guarantee, movers_that_may_hit
from sim.state import SimState
from sim.types import Move

LIKELY_FROM: Final = 0.5
"""The share of futures without a crash from which it is likely that there is none."""


class Level(StrEnum):
    """How sure it is that the ego keeps clear."""

    WHATEVER = "whatever_they_do"
    """some way keeps clear to the end of the episode, whatever the others do"""
    LIKELY = "likely"
    """at least half of the futures end without a crash"""
    POSSIBLE = "possible"
    """a way leads to the goal if the others do as expected"""
    NONE = "none"
    """no way is known that keeps clear"""


@dataclass(frozen=True, slots=True)
class Assurance:
    """How sure it is, in facts."""

    level: Level
    sure: Guarantee
    """for how long a way keeps clear, whatever the others do"""
    may_hit: tuple[str, ...]
    """movers that may hit the ego in the coming move if they do as they like; none without a `move`"""


def assurance(
    state: SimState,
    crashes: float,
    leads_on: Callable[[], bool | None],
    *,
    move: Move | None = None,
    ego: str | None = None,
) -> Assurance:
    """How sure it is that an ego (the first by default) keeps clear of everything from this state on.

    `crashes`: share of its futures that end in a crash; `leads_on`: whether a way leads to the goal, asked
    only where that decides; `move`: what it begins with (None: any).
    """
    world, config = state.world, state.config
    forecast = Forecast.of_truth(world, config, 1, state.number(ego))
    limit = steps_left(config, world.episode_tick)
    sure = guarantee(forecast, limit, first=move, slips=config.slips > 0.0)
    if sure.to_the_end:
        level = Level.WHATEVER
    elif 1.0 - crashes >= LIKELY_FROM:
        level = Level.LIKELY
    else:
        level = Level.POSSIBLE if leads_on() else Level.NONE
    return Assurance(level, sure, () if move is None else movers_that_may_hit(forecast, move))
