"""An episode driven again from its own beginning, as it was or with some settings otherwise.

What people said meanwhile is said again at the same ticks, without settings of what is varied. All that is
drawn is drawn from the seed, so the same episode comes again where nothing is varied.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from sim.actions import Set
from sim.perceive import NO_BELIEF
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.session.timeline import Timeline
from sim.session.triggers import fire
from sim.state import SimState, StepResult
from sim.transition import step
from sim.types import Outcome


class NotAgainError(Exception):
    """Something that was said cannot be done in the other run, or began another road."""


@dataclass(frozen=True, slots=True)
class Replayed:
    """The present episode, driven again from its beginning with nothing varied."""

    seed: int
    ticks: int
    """how many ticks were driven again"""
    same: bool
    """whether every world on the way was the same one"""
    possible: bool
    """False where a road was begun on the way, so that there is nothing to compare"""


def drive_again(
    timeline: Timeline,
    start: SimState,
    end: int,
    varied: Mapping[str, Any] | None = None,
    unsaid: tuple[type, ...] = (),
) -> Iterator[tuple[SimState, StepResult]]:
    """Each tick to the end of the episode that goes on in `start`, with the state before it.

    `end`: the last tick whose words are said again; `varied`: settings and their other values; `unsaid`:
    kinds of actions that are not said again. Raises `NotAgainError`, and `ConfigError` for values that
    cannot be.
    """
    state = start
    varied = varied or {}
    if varied:
        state = replace(start, config=start.config.with_parts(**varied)).with_each_ego(belief=NO_BELIEF)
    first, episode = start.world.tick, start.world.episode
    said = [
        entry
        for entry in timeline.entries
        if first < entry.tick <= end and not isinstance(entry.action, unsaid)
    ]
    while state.world.outcome is Outcome.RUNNING:
        now = state.world.tick
        for entry in said:
            is_varied = isinstance(entry.action, Set) and entry.action.parameter in varied
            if entry.tick != now or is_varied:
                continue
            try:
                state = apply(state, entry.action).state
            except EditError as error:
                raise NotAgainError from error
        if state.world.episode != episode or state.world.outcome is not Outcome.RUNNING:
            raise NotAgainError
        result = step(state)
        after = fire(state, result.state)[0] if result.state.triggers else result.state
        yield state, replace(result, state=after)
        state = after


def replayed(timeline: Timeline) -> Replayed:
    """The present episode beside itself, driven again up to now."""
    world = timeline.state.world
    end = timeline.tick if world.ended is None else world.ended
    start = timeline.at(world.episode_start)
    ticks, same, last = 0, True, start
    real = timeline.between(world.episode_start, end + 1)
    try:
        for before, tick in drive_again(timeline, start, end):
            there = next(real)
            same = same and there.world.digest() == before.world.digest()
            if before.world.tick >= end:
                break
            ticks, last = ticks + 1, tick.state
        else:  # it has ended, here as there
            same = same and last.world.digest() == timeline.at(end).world.digest()
    except NotAgainError:
        return Replayed(timeline.state.config.seed, ticks, same, possible=False)
    return Replayed(timeline.state.config.seed, ticks, same, possible=True)
