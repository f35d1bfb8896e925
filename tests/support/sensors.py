"""Sensors that err in a known way, for as long as a test runs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

from sim.config import Config
from sim.perceive import (
    NO_BELIEF,
    Belief,
    Percept,
    Sensor,
    perceive_truth,
    register_sensor,
    unregister_sensor,
)
from sim.randomness import Stream
from sim.types import Cell, Kind, phantom_id
from sim.world import World

NAMES = ("phantom", "haunted", "missing", "delayed", "dropping", "noisy")


@contextmanager
def registered(*sensors: Sensor) -> Iterator[None]:
    """These sensors by their names."""
    for sensor in sensors:
        register_sensor(sensor)
    try:
        yield
    finally:
        for sensor in sensors:
            unregister_sensor(sensor.name)


def with_pothole(percept: Percept, index: int, number: int = 1) -> Percept:
    """The percept with a pothole that is not there, unless something is seen in the cell already."""
    bit = 1 << index
    if (percept.potholes | percept.barriers | percept.right | percept.left | percept.vehicles) & bit:
        return percept
    hazards = {**percept.hazards, index: phantom_id(Kind.POTHOLE, number)}
    boards = percept.boards.with_kind(Kind.POTHOLE, percept.potholes | bit)
    return replace(percept, boards=boards, hazards=hazards)


@dataclass(frozen=True)
class Phantom:
    """Sees a pothole in one cell that is not there, in one tick or in all."""

    cell: Cell
    tick: int | None = None
    name: str = "phantom"
    stateless = True
    faithful = False

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """See `Sensor.perceive`."""
        del belief
        percept = perceive_truth(world, config, ego)
        if self.tick in (None, world.tick):
            percept = with_pothole(percept, world.road.index(self.cell))
        return percept, NO_BELIEF


class Haunted:
    """Sees a pothole right ahead in every third tick, and a car beside it in every fourth."""

    name = "haunted"
    stateless = True
    faithful = False

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """See `Sensor.perceive`."""
        del belief
        percept, ahead = perceive_truth(world, config, ego), world.avs[ego] - world.road.columns
        if world.tick % 3 == 0 and ahead >= 0:
            percept = with_pothole(percept, ahead, world.tick + 1)
        if world.tick % 4 == 0 and ahead >= 0 and ahead % world.road.columns:
            percept = _with_car(percept, ahead - 1, world.tick + 1)
        return percept, NO_BELIEF


def _with_car(percept: Percept, index: int, number: int) -> Percept:
    bit = 1 << index
    if (percept.potholes | percept.barriers | percept.right | percept.left | percept.vehicles) & bit:
        return percept
    movers = {**percept.movers, index: phantom_id(Kind.VEHICLE, number)}
    return replace(percept, right=percept.right | bit, movers=movers)


@dataclass(frozen=True)
class Missing:
    """Never sees these things."""

    ids: frozenset[str]
    name: str = "missing"
    stateless = True
    faithful = False

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """See `Sensor.perceive`."""
        del belief
        return perceive_truth(world, config, ego).without(self.ids), NO_BELIEF


@dataclass(frozen=True)
class Delayed:
    """Reports what it saw some ticks ago, with its own place as it is now."""

    ticks: int = 2
    name: str = "delayed"
    stateless = False
    faithful = False

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """See `Sensor.perceive`."""
        now = perceive_truth(world, config, ego)
        kept = (*(belief if isinstance(belief, tuple) else ()), now)[-1 - self.ticks :]
        then = kept[0].without({kept[0].movers.get(now.ego, ""), kept[0].hazards.get(now.ego, "")})
        shown = replace(
            then,
            tick=now.tick,
            episode_tick=now.episode_tick,
            ego=now.ego,
            vehicles=now.vehicles,
            yielding=0,
            attentive=0,
        )
        return shown, kept


class Dropping:
    """Leaves out every fifth of all that it has seen since the episode began."""

    name = "dropping"
    stateless = False
    faithful = False

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """See `Sensor.perceive`."""
        seen = belief if isinstance(belief, int) else 0
        percept = perceive_truth(world, config, ego)
        names = [thing.id for thing in percept.things()]
        gone = {name for number, name in enumerate(names, seen + 1) if number % 5 == 0}
        return percept.without(gone), seen + len(names)


class Noisy:
    """Misses each thing with a chance of a fifth, and sees a pothole in one cell in twenty; drawn by tick."""

    name = "noisy"
    stateless = True
    faithful = False

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """See `Sensor.perceive`."""
        del belief
        draws = Stream.of(config.seed, "noisy", world.episode, world.episode_tick)
        percept = perceive_truth(world, config, ego)
        cells = {world.road.index(thing.cell): thing.id for thing in percept.things()}
        percept = percept.without({name for cell, name in cells.items() if draws.uniform(cell) < 0.2})
        for index in range(world.road.columns, world.road.columns * (world.road.rows - 1)):
            if draws.narrow(1).uniform(index) < 0.05:
                percept = with_pothole(percept, index, 1 + index + 1_000 * world.tick)
        return percept, NO_BELIEF
