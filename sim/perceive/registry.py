"""Sensors by name: those built in, and those a program registers."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from sim import sensor_names
from sim.config import Config
from sim.perceive.devices import GRID_SENSORS
from sim.perceive.percept import Percept
from sim.perceive.perfect import PerfectSensor, other_egos
from sim.perceive.sensor import NO_BELIEF, Belief, Sensor
from sim.types import Move
from sim.world import World

_sensors: dict[str, Sensor] = {}
_NOTHING: dict[int, Move] = {}


def register_sensor(sensor: Sensor) -> None:
    """Make a sensor available by its name. Raises `ValueError` if the name is taken."""
    sensor_names.claim(sensor.name)
    _sensors[sensor.name] = sensor


def unregister_sensor(name: str) -> None:
    """Forget a sensor that a program registered. Raises `ValueError` for any other name."""
    sensor_names.release(name)
    del _sensors[name]


def sensor_named(name: str) -> Sensor:
    """The sensor of that name. Raises `KeyError` if there is none, which a valid `Config` rules out."""
    return _sensors[name]


def perceive(
    world: World,
    config: Config,
    ego: int = 0,
    belief: Belief = NO_BELIEF,
    announced: Mapping[int, Move] = _NOTHING,
    parked: Collection[int] = (),
) -> tuple[Percept, Belief]:
    """What the configured sensor shows ego number `ego` (from 0), and the belief for the next tick.

    Other egos tell where they are and which moves they have `announced`. `parked`: the egos that stay.
    Both by number.
    """
    seen = _sensors[config.sensor].perceive(world, config, ego, belief)
    if len(world.avs) == 1:
        return seen
    return replace(seen[0], egos=other_egos(world, ego, announced, parked)), seen[1]


_BUILT_IN: tuple[Sensor, ...] = (PerfectSensor(), *GRID_SENSORS)
for sensor in _BUILT_IN:
    register_sensor(sensor)
