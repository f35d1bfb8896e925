"""Whether the weather made a difference to this drive: the same in clear weather, run from its beginning."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.actions import Weather
from sim.explain.driven_again import NotAgainError, drive_again
from sim.explain.episode_rollout import MAX_WORK
from sim.explain.question_error import QuestionError
from sim.plan import traits_of
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome

CLEAR: Final[Weather] = "clear"


@dataclass(frozen=True, slots=True)
class OtherMove:
    """The first move that is another one in clear weather."""

    tick: int
    made: Move
    would: Move


@dataclass(frozen=True, slots=True)
class WeatherEffect:
    """What the weather did to a drive, in facts."""

    weather: Weather
    outcome: Outcome
    """how the drive stands, or how it ended"""
    differs: OtherMove | None
    """None where all moves up to now are the same in clear weather"""
    clear_outcome: Outcome | None
    """how it would have ended in clear weather; None where the drive goes on"""
    clear_ticks: int
    """ticks that were driven again"""

    @property
    def caused(self) -> bool:
        """Of a failure, whether clear weather would have led to the goal; else whether a move differs."""
        if self.outcome in (Outcome.CRASH, Outcome.STUCK):
            return self.clear_outcome is Outcome.SUCCESS
        return self.differs is not None


def weather_effect(timeline: Timeline) -> WeatherEffect:
    """What the weather did to the present episode, for the first ego.

    Raises `QuestionError`: `nothing_yet` before the first move, `too_long_again` where driving it again would
    take too long, `not_again` where a new road was begun on the way. In clear weather nothing is run.
    """
    state = timeline.state
    world, config = state.world, state.config
    end = timeline.tick if world.ended is None else world.ended
    if config.weather == CLEAR:
        return WeatherEffect(CLEAR, world.outcome, None, None, 0)
    if end == world.episode_start:
        raise QuestionError("nothing_yet", tick=timeline.tick)
    if _work(state, end - world.episode_start) > MAX_WORK:
        raise QuestionError("too_long_again")
    differs: OtherMove | None = None
    ended, ticks = None, 0
    real = timeline.between(world.episode_start, end)
    try:
        for before, tick in drive_again(timeline, timeline.at(world.episode_start), end, {"weather": CLEAR}):
            there = next(real, None)
            ticks, ended = ticks + 1, tick.state.world.outcome
            if there is None and world.ended is None:
                break  # as far as the real drive has come
            if differs is None and there is not None:
                made, would = timeline.decided(there), tick.decision
                if made is not None and would is not None and made.move is not would.move:
                    differs = OtherMove(before.world.tick, made.move, would.move)
            if differs is not None and world.ended is None:
                break
    except NotAgainError:
        raise QuestionError("not_again") from None
    return WeatherEffect(
        config.weather, world.outcome, differs, None if world.ended is None else ended, ticks
    )


def _work(state: SimState, ticks: int) -> int:
    """How much is looked through where a planner searches: cells times rows, every tick."""
    if traits_of(state.config.planner).quick:
        return 0
    road = state.world.road
    return road.columns * road.rows * road.rows * ticks
