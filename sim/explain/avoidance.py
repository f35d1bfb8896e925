"""Whether a crash could have been avoided, wherever the goal is: by keeping clear to the end of the episode.

Looked for backwards along the way that was driven. Where nobody brakes or gives way, the cells that keep
clear are exact (`sim.search.reachability`), so that "nothing could have avoided it" is proved. Where others
brake, a way found without their braking holds all the same, and staying is driven through by the rules.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from sim.explain.alternatives import after_move
from sim.forecast import Forecast
from sim.plan import Decision
from sim.search.reachability import reachability, steps_left, survival_by_move
from sim.state import SimState
from sim.transition import next_world
from sim.types import MOVES, Move, Outcome

STANDING_TICKS: Final = 8
"""Ticks before the crash in which it is driven through how staying for good would have gone."""


@dataclass(frozen=True, slots=True)
class Avoidance:
    """The last tick at which another move would have kept clear of any crash to the end of the episode."""

    tick: int
    made: Move
    instead: Move
    stays: bool
    """whether staying from then on is enough"""


@dataclass(frozen=True, slots=True)
class Avoidable:
    """Whether a crash could have been avoided; `last` is None and `proved` False where that is not known."""

    last: Avoidance | None
    proved: bool


UNKNOWN: Final = Avoidable(None, proved=False)


def find_avoidance(driven: Iterable[tuple[SimState, Decision]], *, whole: bool) -> Avoidable:
    """The last move instead of which another would have avoided the crash.

    `driven`: the states of one ego alone on its road, with its decisions, the last first. `whole`: whether
    they begin with the episode, so that nothing more could be found before them.
    """
    exact = True
    for back, (state, decision) in enumerate(driven):
        config = state.config
        if len(state.world.avs) > 1 or not config.free_ways_hold:
            return UNKNOWN
        exact = exact and not config.reacting
        if (
            found := _kept_clear(state, decision, standing=config.reacting and back < STANDING_TICKS)
        ) is not None:
            return Avoidable(found, proved=True)
    return Avoidable(None, proved=exact and whole)


def _kept_clear(state: SimState, decision: Decision, *, standing: bool) -> Avoidance | None:
    """Another move after which a way keeps clear; staying for good comes first, being the simplest."""
    limit = steps_left(state.config, state.world.episode_tick)
    if limit <= 0:
        return None
    made, tick = decision.move, state.world.tick
    forecast = Forecast.of_truth(state.world, state.config, limit)
    lasting = survival_by_move(forecast, limit)
    moves = [move for move, ticks in zip(MOVES, lasting, strict=True) if move is not made and ticks >= limit]
    moves += [move for move in _arriving(forecast, limit) if move is not made and move not in moves]
    if (Move.STAY in moves or standing) and made is not Move.STAY and _stands(state, limit):
        return Avoidance(tick, made, Move.STAY, stays=True)
    return Avoidance(tick, made, moves[0], stays=False) if moves else None


def _arriving(forecast: Forecast, limit: int) -> list[Move]:
    """The moves after which a way leads to the goal: who arrives has no need to keep clear any longer."""
    steps = forecast.own_steps()
    return [
        move
        for move, there in zip(MOVES, steps, strict=True)
        if there and reachability(forecast.after(move), there, limit - 1, after=1).ticks is not None
    ]


def _stands(state: SimState, limit: int) -> bool:
    """Whether an ego that only stays from here on is never met, driven through as others really react."""
    world = after_move(state, Move.STAY).world
    for _ in range(limit):
        if world.outcome is not Outcome.RUNNING:
            break
        world = next_world(world, (Move.STAY,), state.config)
    return world.outcome is not Outcome.CRASH
