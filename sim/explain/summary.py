"""What an episode has come to, at its end: detours, waits, for whose sake, and what the best would have been.

Read off the course that the run carries (`sim.episode_record`), so nothing is driven again. What cannot be
known for certain is left out: the best, and until when a way was open, are for roads that nobody changed on
the way and on which nothing hung on who gives way or brakes. Where movers react, ways are searched with their
reactions (`sim.oracle.lower_bounds`), and what takes too long to find out is left out as well.
"""

from __future__ import annotations

from bisect import bisect_left
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Final

from sim.commit import moves_with
from sim.episode_record import EpisodeRecord, Sake
from sim.forecast import Forecast, predict
from sim.oracle.lower_bounds import can_arrive, least_ticks
from sim.oracle.other_egos import others_standing
from sim.perceive import perceive_truth
from sim.rules.dynamics import Dynamics
from sim.search.reachability import steps_left
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.transition import next_world
from sim.types import Mode, Move, Outcome
from sim.world import Cause, World

STATES: Final = 3_000
"""States that each search of reactions may look at; two tenths of a second."""

QUICK_STATES: Final = 150
"""The same where it is summed up within a tick; a few milliseconds, and mostly none are needed."""

QUICK_CELLS = 512
"""On roads up to this size an arrival or a crash is summed up in a fraction of a millisecond."""


@dataclass(frozen=True, slots=True)
class Summary:
    """An episode that has ended, in facts."""

    outcome: Outcome
    ticks: int
    sakes: tuple[tuple[Sake, int], ...]
    """detours and waits by whose sake, in the order they first came"""
    waits: int
    """those of them in which the vehicle stood"""
    best: int | None
    """least ticks from the beginning; None where there is no way, or where it is not certain, or not found"""
    cause: Cause | None
    """of a crash"""
    free: bool | None
    """of a crash: whether some move of the last tick would have met nothing"""
    open_before: bool | None
    """of a crash: whether a way to the goal was open a tick before; None where it is not certain"""
    open_until: int | None
    """of STUCK: the last tick of the episode at which a way was open; None as for `best`"""
    open_known: bool
    """of STUCK: whether `open_until` was found out, so that None means never"""
    repeated: bool
    """of STUCK: whether a situation repeated; else the ticks ran out"""
    certain: bool
    """whether nobody changed the road on the way, and nothing hung on who gives way or brakes"""

    @property
    def detours(self) -> int:
        """Moves to another lane."""
        return sum(count for _, count in self.sakes) - self.waits

    @property
    def above(self) -> int | None:
        """Ticks more than the best possible, for an arrival."""
        if self.outcome is not Outcome.SUCCESS or self.best is None:
            return None
        return self.ticks - self.best


def summary(state: SimState, *, ego: str | None = None) -> Summary:
    """How the episode went that has ended in this run, for an ego, the first by default.

    Where other egos have moved, nothing is claimed of what would have been. Raises `ValueError` while it goes
    on.
    """
    world, course = state.world, state.ego(ego).record
    if world.outcome is Outcome.RUNNING:
        raise ValueError("the episode goes on")
    whole = course.start is not None and course.start.tick == world.episode_start
    stayed = course.start is not None and _others_stayed(course.start, world, state.number(ego))
    certain = course.certain and whole and not course.changed and stayed
    if stayed:
        state = _with_others_parked(state, ego)
    free = open_before = best = open_until = None
    open_known = False
    states = STATES if long_to_tell(state) else QUICK_STATES
    if course.start is not None and certain:
        with suppress(ImpatientError):
            best = least_ticks(_at_first(state, course), states, ego)
    if world.outcome is Outcome.CRASH and course.last is not None:
        before = replace(state.with_ego(queue=()), world=course.last)
        free = any(_last_forecast(before.world, world, state, ego).own_steps())
        with suppress(ImpatientError):
            open_before = can_arrive(before, states, ego) if course.certain and stayed else None
    if world.outcome is Outcome.STUCK and certain:
        with suppress(ImpatientError):
            open_until = (
                _open_until_reacting(state, course, ego)
                if state.config.reacting or len(world.avs) > 1
                else _open_until(state, course)
            )
            open_known = True
    ticks = (world.tick if world.ended is None else world.ended) - world.episode_start
    return Summary(
        outcome=world.outcome,
        ticks=ticks,
        sakes=course.sakes,
        waits=course.waits,
        best=best,
        cause=world.cause,
        free=free,
        open_before=open_before,
        open_until=open_until,
        open_known=open_known,
        repeated=world.outcome is Outcome.STUCK and ticks <= state.config.max_ticks,
        certain=certain,
    )


def _others_stayed(start: World, end: World, number: int) -> bool:
    """Whether all egos but one are where they were when the episode began."""
    return len(start.avs) == len(end.avs) and all(
        was == now for other, (was, now) in enumerate(zip(start.avs, end.avs, strict=True)) if other != number
    )


def _with_others_parked(state: SimState, ego: str | None) -> SimState:
    """The state in which all egos but one are to stay, as they have."""
    for id in others_standing(state, ego):
        if id in state.egos:
            state = state.with_ego(id, mode=Mode.MANUAL, queue=())
    return state


def _last_forecast(before: World, after: World, state: SimState, ego: str | None) -> Forecast:
    """What followed from what was in the last tick, with the moves that the other egos made."""
    number = state.number(ego)
    made = {
        other: next(move for move in Move if before.road.moved(cell, move) == after.avs[other])
        for other, cell in enumerate(before.avs)
        if other != number
    }
    return predict(perceive_truth(before, state.config, number, made), 1)


def long_to_tell(state: SimState) -> bool:
    """Whether this is an end, and its summary takes longer than a tick of many sessions may."""
    world = state.world
    if world.outcome is Outcome.RUNNING:
        return False
    return world.outcome is Outcome.STUCK or world.road.columns * world.road.rows > QUICK_CELLS


def _at_first(state: SimState, course: EpisodeRecord) -> SimState:
    """The run as the episode began, with the present configuration."""
    assert course.start is not None
    return replace(state.with_ego(queue=()), world=course.start)


def _open_until(state: SimState, course: EpisodeRecord) -> int | None:
    """The last tick of the episode at which a way still led to the goal; None: at none.

    One sweep backwards: the cells from which row 0 can be met in the ticks that are left, until the
    vehicle's own is among them.
    """
    world = _at_first(state, course).world
    road, limit = world.road, steps_left(state.config, 0)
    forecast = Forecast.of_truth(world, state.config, limit)
    cells = _cells(world.av, course.move_list(), state.config.ego_dynamics(road))
    goal = road.row(0)
    reaching = goal
    for tick in range(limit - 1, -1, -1):
        free = reaching & ~forecast.blocked(tick)
        reaching = goal | forecast.spread_back(free, tick)
        if tick < len(cells) and reaching >> cells[tick] & 1:
            return tick
    return None


def _open_until_reacting(state: SimState, course: EpisodeRecord, ego: str | None) -> int | None:
    """The same where movers react: a way that is open at a tick of a drive was open at those before.

    Raises `ImpatientError`.
    """
    worlds = [_at_first(state, course).world]
    for move in course.move_list():
        moves = moves_with(worlds[-1], move, state.number(ego))
        worlds.append(next_world(worlds[-1], moves, state.config, state.parked))
    worlds.pop()  # nothing was decided in it
    first_closed = bisect_left(
        worlds,
        True,
        key=lambda world: not can_arrive(replace(state.with_ego(ego, queue=()), world=world), STATES, ego),
    )
    return first_closed - 1 if first_closed else None


def _cells(start: int, moves: tuple[Move, ...], dynamics: Dynamics) -> list[int]:
    """The ego's cell at every tick."""
    cells = [start]
    for move in moves:
        end = dynamics.target(cells[-1], move)
        cells.append(cells[-1] if end is None else end)
    return cells
