"""Sensors by name: those built in, and those a program registers."""

from __future__ import annotations

from sim import sensor_names
from sim.config import Config
from sim.perceive.percept import Percept
from sim.perceive.perfect import PerfectSensor
from sim.perceive.sensor import NO_BELIEF, Belief, Sensor
from sim.world import World

_sensors: dict[str, Sensor] = {}


def register_sensor(sensor: Sensor) -> None:
    """Make a sensor available by its name. Raises `ValueError` if the name is taken."""
    sensor_names.claim(sensor.name)
    _sensors[sensor.name] = sensor


def unregister_sensor(name: str) -> None:
    """Forget a sensor that a program registered. Raises `ValueError` for any other name."""
    sensor_names.release(name)
    del _sensors[name]


def sensor_named(name: str) -> Sensor:
    """The sensor of that name. Raises `KeyError` if there is none; a configuration has no such name."""
    return _sensors[name]


def perceive(
    world: World, config: Config, ego: int = 0, belief: Belief = NO_BELIEF
) -> tuple[Percept, Belief]:
    """What the configured sensor shows the vehicle number `ego`, and the belief for the next tick."""
    return _sensors[config.sensor].perceive(world, config, ego, belief)


for sensor in (PerfectSensor(),):
    register_sensor(sensor)
