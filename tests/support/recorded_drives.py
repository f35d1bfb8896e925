"""Drives of every sort, each with the states that it came through, as they were when it was driven.

What is asked about a drive is judged by this record, not by what the timeline finds when it is asked.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot

from sim.actions import Drive, SetMode
from sim.config import Config
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Cell, Mode, Move, Outcome

PLANNERS = ("rules", "priority", "astar", "dijkstra", "bfs")
SENSORS = ("perfect", "perfect", "camera", "lidar", "radar", "fusion")
WEATHERS = ("clear", "clear", "rain", "fog", "snow")
DENSITIES = ((2, 3, 0, 0), (6, 10, 2, 2), (10, 22, 3, 5), (16, 26, 4, 6))
"""Potholes, vehicles, pedestrians and barriers on a hundred cells."""
BY_HAND = 0.3
"""The share of drives in which a person drives now and then."""
GOES_ON = 0.15
"""The share of drives that go on into the episode after an end."""


@dataclass(frozen=True, eq=False)
class Record:
    """A drive, and what was recorded of it."""

    timeline: Timeline
    states: tuple[SimState, ...]
    """the state at each tick, with what was said at it, the present one last"""
    asked: frozenset[int]
    """the ticks at which a person asked for a move"""

    @property
    def state(self) -> SimState:
        """The present state."""
        return self.states[-1]

    @property
    def outcome(self) -> Outcome:
        """How the present episode stands."""
        return self.state.world.outcome

    @property
    def config(self) -> Config:
        """What it was driven with."""
        return self.state.config

    @property
    def first(self) -> int:
        """The tick at which the present episode began."""
        return self.state.world.episode_start

    @property
    def last(self) -> int:
        """Its latest tick of driving: now, or that of its end."""
        ended = self.state.world.ended
        return self.state.world.tick if ended is None else ended

    @property
    def driven(self) -> int:
        """Ticks of driving."""
        return self.last - self.first

    @property
    def episode(self) -> tuple[SimState, ...]:
        """The states of the present episode up to its end."""
        return self.states[self.first : self.last + 1]

    @property
    def cells(self) -> list[Cell]:
        """Where the ego was in each of them: lane from 0 and row."""
        return [state.world.road.cell(state.world.av) for state in self.episode]

    def seconds(self, ticks: float) -> float:
        """Ticks in seconds."""
        return ticks * self.config.step_seconds


def recorded(config: Config, draw: random.Random, ticks: int, *, by_hand: bool, goes_on: bool) -> Record:
    """One drive of so many ticks at most."""
    timeline = Timeline(config)
    states, asked = [], set()
    for tick in range(ticks):
        world = timeline.state.world
        if world.outcome is not Outcome.RUNNING and not goes_on:
            break
        if by_hand and world.outcome is Outcome.RUNNING and draw.random() < 0.4:
            if draw.random() < 0.2:
                timeline.apply(tick, [SetMode(mode=Mode.AUTO)])
            else:
                timeline.apply(tick, [SetMode(mode=Mode.MANUAL), Drive(move=draw.choice(list(Move)))])
                asked.add(tick)
        states.append(timeline.state)
        timeline.advance()
    return Record(timeline, (*states, timeline.state), frozenset(asked))


def any_record(draw: random.Random) -> Record:
    """A drive drawn of all sorts, up to a random tick."""
    columns, rows = draw.choice(((4, 10), (5, 14), (6, 20), (8, 12)))
    planner = draw.choice(PLANNERS)
    share = columns * rows / 100
    potholes, vehicles, pedestrians, barriers = (round(each * share) for each in draw.choice(DENSITIES))
    config = Config(
        seed=draw.randrange(2**32),
        columns=columns,
        rows=rows,
        potholes=potholes,
        vehicles=vehicles,
        pedestrians=pedestrians,
        barriers=barriers,
        planner=planner,
        sensor=draw.choice(SENSORS),
        weather=draw.choice(WEATHERS),
        time_of_day=draw.choice(("day", "day", "night")),
        courtesy=draw.choice((0.0, 0.5)),
        attentive=draw.choice((1.0, 1.0, 0.0)),
        reset_delay_s=1.0,
    )
    by_hand, goes_on = draw.random() < BY_HAND, draw.random() < GOES_ON
    ticks = draw.choice((0, 1, 3, 6, 10, 15, 25, 60, 60))
    return recorded(config, draw, ticks, by_hand=by_hand, goes_on=goes_on)


def any_records(seed: int) -> Iterator[Record]:
    """Drives without end."""
    draw = random.Random(f"answers {seed}")
    while True:
        yield any_record(draw)


def move_of(record: Record, tick: int) -> Move:
    """The step that was made in a tick."""
    one, other = record.states[tick].world, record.states[tick + 1].world
    (x, y), (u, v) = one.road.cell(one.av), other.road.cell(other.av)
    return next(move for move in Move if move.offset == (u - x, v - y))


def moves_of(record: Record) -> list[Move]:
    """The steps of the present episode."""
    return [move_of(record, tick) for tick in range(record.first, record.last)]


def metres(record: Record) -> float:
    """The length of the way."""
    return sum(hypot(*move.offset) * record.config.cell_m for move in moves_of(record))
