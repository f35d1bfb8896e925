"""The riskiest moment of a stretch: where fewest of the ego's moves would have met nothing, then least room.

Each move of each tick is made and judged (`next_world`), with what the others did in that tick. A tick that
ended in a crash comes first.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Final

from sim.explain.closest_call import ClosestCall, closest_call
from sim.explain.pattern import move_between
from sim.state import SimState
from sim.transition import next_world
from sim.types import Move, Outcome

MOST_TICKS: Final = 600
"""Ticks of a stretch that are judged; of a longer one the last."""


@dataclass(frozen=True, slots=True)
class Risk:
    """How risky a tick was."""

    before: SimState
    """the state at the tick"""
    made: Move
    crashed: bool
    free: tuple[Move, ...]
    """moves that would have met nothing"""
    tried: tuple[Move, ...]
    """all moves that lead to a cell of the road"""
    call: ClosestCall | None
    """the nearest that something which moves came in it"""

    @property
    def tick(self) -> int:
        """The tick that it was decided at."""
        return self.before.world.tick

    @property
    def rank(self) -> tuple[bool, int, float]:
        """Lower is riskier."""
        return not self.crashed, len(self.free), inf if self.call is None else self.call.gap_m


def riskiest(states: Iterable[SimState]) -> Risk | None:
    """The riskiest of states one tick apart, the earliest of equals; None where nothing was driven."""
    found: Risk | None = None
    for before, after in pairwise(states):
        made = move_between(before, after)
        if made is None:
            continue
        risk = risk_of(before, after, made)
        if found is None or risk.rank < found.rank:
            found = risk
    return found


def risk_of(before: SimState, after: SimState, made: Move) -> Risk:
    """How risky the tick from one state to the next was, in which the first ego made this move."""
    world, config = before.world, before.config
    dynamics = config.ego_dynamics(world.road)
    others = tuple(
        next((move for move in Move if dynamics.target(was, move) == now), Move.STAY)
        for was, now in zip(world.avs[1:], after.world.avs[1:], strict=False)
    )
    tried = tuple(move for move in Move if dynamics.target(world.av, move) is not None)
    free = tuple(
        move
        for move in tried
        if next_world(world, (move, *others), config, before.parked).outcome is not Outcome.CRASH
    )
    crashed = after.world.outcome is Outcome.CRASH
    return Risk(before, made, crashed, free, tried, closest_call((before, after)))
