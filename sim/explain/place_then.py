"""Where the first ego is at a coming tick if its planner drives, with the chance of that; or where it was."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

from sim.explain.episode_rollout import EpisodeRollout, rollout, summarize
from sim.explain.foresight import driving, running_state
from sim.explain.futures import Futures
from sim.explain.moments import state_at
from sim.explain.question_error import QuestionError
from sim.session.timeline import Timeline
from sim.state import FIRST, SimState
from sim.types import Cell


@dataclass(frozen=True, slots=True)
class PlaceThen:
    """Where it is, in facts."""

    state: SimState
    """now"""
    tick: int
    """the tick that was asked about"""
    cell: Cell | None
    """lane from 0 at the left, and row, 0 being the goal's; None where the drive is over by then"""
    story: EpisodeRollout | None
    """one run of as many ticks; None for a tick of the past"""
    share: float
    """the share of futures in which it is there, or in which it is over by then"""
    futures: int | None
    """how many were drawn; None where the share is exact"""

    @property
    def past(self) -> bool:
        """Whether that tick has been."""
        return self.story is None


MOST_AHEAD = 200
"""Ticks that are driven on at most."""


def place_then(timeline: Timeline, tick: int) -> PlaceThen:
    """Where the ego is at a tick: read off the record, or driven on to it.

    Raises `QuestionError`: `nothing_ahead`, `no_answer`, `too_far_ahead`.
    """
    if tick <= timeline.tick:
        before = state_at(timeline, tick)
        return PlaceThen(before, tick, before.world.road.cell(before.world.av), None, 1.0, None)
    state = driving(running_state(timeline, None))
    ticks = tick - timeline.tick
    if ticks > MOST_AHEAD:
        raise QuestionError("too_far_ahead", ticks=ticks, most=MOST_AHEAD)
    taken = list(islice(rollout(state), ticks))
    story = summarize(state, taken)
    if story.silent is not None:
        raise QuestionError("no_answer", planner=state.config_of(None).planner, fault=story.silent)
    last = taken[-1][1].state.world
    there = last.av if last.tick == tick and last.ended is None else None
    share, futures = 1.0, None
    if not state.config.certain:
        try:
            shares, futures = Futures(state, FIRST).places(ticks)
        except QuestionError as error:
            raise QuestionError("no_answer", **error.facts) from None
        share = shares.get(there, 0.0)
    cell = None if there is None else last.road.cell(there)
    return PlaceThen(state, tick, cell, story, share, futures)
