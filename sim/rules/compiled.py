"""What the compiled batch (`sim.batch`) knows; a leaf, so that it can be asked without loading a compiler."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from sim.rules.behaviour import DEFAULT_BEHAVIOUR
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.sensor_names import DEFAULT_SENSOR
from sim.types import Kind

if TYPE_CHECKING:
    from sim.config import Config

COMPILED_KINDS: Final = (Kind.POTHOLE, Kind.BARRIER, Kind.VEHICLE, Kind.PEDESTRIAN)
"""The kinds of things that the kernels know."""
COMPILED_VALUES: Final = {
    "dynamics": DEFAULT_DYNAMICS,
    "behaviour": DEFAULT_BEHAVIOUR,
    "sensor": DEFAULT_SENSOR,
    "weather": "clear",
    "time_of_day": "day",
}
"""The one value of these settings that a batch is compiled for."""


def compiled_rules(config: Config) -> bool:
    """Whether a batch goes by the motion, the behaviour, the sensor and the conditions of a configuration."""
    return all(getattr(config, name) == value for name, value in COMPILED_VALUES.items())
