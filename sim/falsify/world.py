"""Looks at one world: drives it with the planner and, where that fails, proves whether it can be driven."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Final

from sim.evaluate.spec import STATES
from sim.falsify.space import Point, config_at
from sim.falsify.spec import Falsification
from sim.generation import GenerationError
from sim.oracle.certificate import Drivable, certify
from sim.oracle.lower_bounds import can_arrive
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

FAILURE_SCORE: Final = 1.0
"""Score of a failure; that of an arrival is the share of the allowed ticks that it took, which is less."""


class Finding(StrEnum):
    """What a world came to."""

    ARRIVED = "arrived"
    CRASHED = "crashed"
    """though the world can be driven, as is proved"""
    STUCK = "stuck"
    """likewise"""
    UNSOLVABLE = "unsolvable"
    """the planner did not arrive, and it is proved that nobody can"""
    UNKNOWN = "unknown"
    """the planner did not arrive, and whether anybody can was not found out"""
    NO_ROAD = "no_road"
    """no road could be drawn at this point"""

    @property
    def failed(self) -> bool:
        """Whether this is a failure of the planner."""
        return self in (Finding.CRASHED, Finding.STUCK)


@dataclass(frozen=True, slots=True)
class Looked:
    """A world that was looked at."""

    index: int
    point: Point
    finding: Finding
    ticks: int
    things: int
    score: float


def world_at(spec: Falsification, index: int, point: Point) -> SimState | None:
    """How the episode in a world begins; None where there is no such road."""
    config = config_at(spec.config, point, spec.seed + index)
    if config is None:
        return None
    try:
        return SimState.start(config)
    except GenerationError:
        return None


def look(spec: Falsification, index: int, point: Point) -> Looked:
    """Drive one world."""
    start = world_at(spec, index, point)
    if start is None:
        return Looked(index, point, Finding.NO_ROAD, 0, 0, 0.0)
    end = drive(start)[-1]
    ticks, things = end.world.tick, len(start.world.movers) + len(start.world.hazards)
    if end.world.outcome is Outcome.SUCCESS:
        score = round(ticks / (start.config.max_ticks + 1), 4)
        return Looked(index, point, Finding.ARRIVED, ticks, things, score)
    way = solvable(start)
    if not way:
        finding = Finding.UNKNOWN if way is None else Finding.UNSOLVABLE
        return Looked(index, point, finding, ticks, things, 0.0)
    finding = Finding.CRASHED if end.world.outcome is Outcome.CRASH else Finding.STUCK
    return Looked(index, point, finding, ticks, things, FAILURE_SCORE)


def drive(start: SimState) -> list[SimState]:
    """All states of an episode, to its end."""
    states = [start]
    while states[-1].world.outcome is Outcome.RUNNING:
        states.append(step(states[-1]).state)
    return states


def outcome_of(start: SimState) -> Outcome:
    """How an episode ends."""
    while start.world.outcome is Outcome.RUNNING:
        start = step(start).state
    return start.world.outcome


def solvable(start: SimState) -> bool | None:
    """Whether a way leads to the goal, by search; None where that was not found out."""
    try:
        return can_arrive(start, STATES)
    except ImpatientError:
        return None


def way_through(start: SimState) -> tuple[Move, ...] | None:
    """The moves of a way that arrives, played before they are handed out; None where there is none."""
    found = certify(start)
    return found.plan if isinstance(found, Drivable) else None


def with_only(start: SimState, ids: frozenset[str] | tuple[str, ...]) -> SimState:
    """The same beginning with nothing on the road but these things."""
    return replace(start, world=start.world.keeping(ids))


Cancelled = Callable[[], bool]
