"""Which sensor or which conditions would have avoided a failure, found by running the episode again.

Every alternative starts from the episode's own beginning, with one thing otherwise: perfect sensing, another
sensor, clear weather, or daylight. What people said meanwhile is said again at the same ticks, without
settings of what is varied. Movers that react draw as they did, so the runs differ by what is seen alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from sim import sensor_names
from sim.config import Config
from sim.explain.driven_again import NotAgainError, drive_again
from sim.perceive import NO_BELIEF, Belief, Percept, perceive
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Outcome, is_ego
from sim.world import World

PLAIN: Final = {"weather": "clear", "time_of_day": "day"}
"""Conditions under which nothing is hidden."""


@dataclass(frozen=True, slots=True)
class Rerun:
    """The episode driven again with settings otherwise."""

    outcome: Outcome | None
    """how the episode would have ended; None where something that was said could not be done there"""
    ticks: int
    """ticks it would have taken"""

    @property
    def avoids(self) -> bool:
        """Whether the vehicle would have arrived."""
        return self.outcome is Outcome.SUCCESS


@dataclass(frozen=True, slots=True)
class Alternative(Rerun):
    """The episode with one setting otherwise."""

    setting: str
    """`sensor`, `weather` or `time_of_day`"""
    value: str


@dataclass(frozen=True, slots=True)
class Attribution:
    """A failure, and what would have avoided it."""

    outcome: Outcome
    tick: int
    """the tick of the end"""
    alternatives: tuple[Alternative, ...]

    @property
    def avoided_by(self) -> tuple[Alternative, ...]:
        """The alternatives under which the vehicle would have arrived."""
        return tuple(each for each in self.alternatives if each.avoids)

    @property
    def by_sensing(self) -> bool:
        """Whether perfect sensing would have avoided it; if not, it was no matter of what was seen."""
        return any(each.value == sensor_names.DEFAULT_SENSOR for each in self.avoided_by)


def attribute(timeline: Timeline, tick: int | None = None) -> Attribution | None:
    """What would have avoided the failure that stands at a tick (by default now); None where none stands.

    Raises `IndexError` for a tick that is not in the past of the timeline.
    """
    state = timeline.state if tick is None else timeline.at(tick)
    world = state.world
    if world.outcome not in (Outcome.CRASH, Outcome.STUCK) or world.ended is None:
        return None
    start = timeline.at(world.episode_start)
    found = tuple(
        Alternative(again.outcome, again.ticks, setting, value)
        for setting, value in _changes(state.config)
        for again in [_rerun(timeline, start, world.ended, {setting: value})]
    )
    return Attribution(world.outcome, world.ended, found)


def rerun(timeline: Timeline, varied: Mapping[str, str], tick: int | None = None) -> Rerun | None:
    """The episode with these settings otherwise; None where no failure stands. Raises `ConfigError`."""
    state = timeline.state if tick is None else timeline.at(tick)
    world = state.world
    if world.outcome not in (Outcome.CRASH, Outcome.STUCK) or world.ended is None:
        return None
    return _rerun(timeline, timeline.at(world.episode_start), world.ended, varied)


def seen_since(timeline: Timeline, varied: Mapping[str, str], tick: int | None = None) -> int | None:
    """The tick since when what was crashed into would have been seen where it was, on the very same drive.

    None where it would not have been seen at the last decision, and where no crash stands.
    Raises `ConfigError`.
    """
    state = timeline.state if tick is None else timeline.at(tick)
    world = state.world
    if world.outcome is not Outcome.CRASH or world.ended is None or world.cause is None:
        return None
    met = [name for name in world.cause.ids if not is_ego(name)]
    belief: Belief = NO_BELIEF
    since: int | None = None
    for before in timeline.between(world.episode_start, world.ended):
        there = before.world
        percept, belief = perceive(there, before.config.with_parts(**dict(varied)), 0, belief)
        if not met or any(_missed(there, percept, name) for name in met):
            since = None
        elif since is None:
            since = there.tick
    return since


def _missed(world: World, percept: Percept, name: str) -> bool:
    """Whether a thing is not seen, or in another cell than it is in."""
    there, seen = world.find(name), percept.find(name)
    return there is None or seen is None or seen.cell != there.cell


def _changes(config: Config) -> Iterator[tuple[str, str]]:
    """What is varied: every other built-in sensor, and conditions that are not plain."""
    for sensor in sensor_names.BUILT_IN:
        if sensor != config.sensor:
            yield "sensor", sensor
    for setting, plain in PLAIN.items():
        if getattr(config, setting) != plain:
            yield setting, plain


def _rerun(timeline: Timeline, start: SimState, end: int, varied: Mapping[str, str]) -> Rerun:
    first = start.world.tick
    last = start
    try:
        for _, tick in drive_again(timeline, start, end, varied):
            last = tick.state
    except NotAgainError:
        return Rerun(None, last.world.tick - first)
    return Rerun(last.world.outcome, last.world.tick - first)
