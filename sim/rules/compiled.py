"""What the compiled batch (`sim.batch`) knows; a leaf, so that it can be asked without loading a compiler."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from sim.rules.behaviour import DEFAULT_BEHAVIOUR
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.sensor_names import BUILT_IN, DEFAULT_SENSOR
from sim.types import Kind

if TYPE_CHECKING:
    from sim.config import Config

COMPILED_KINDS: Final = (Kind.POTHOLE, Kind.BARRIER, Kind.VEHICLE, Kind.PEDESTRIAN)
"""The kinds of things that the kernels know."""
SENSING_PLANNER: Final = "priority"
"""The planner that drives a batch with sensors that err."""
COMPILED_MOTION: Final = {"dynamics": DEFAULT_DYNAMICS, "behaviour": DEFAULT_BEHAVIOUR}
"""The one value of these settings that a batch is compiled for."""
COMPILED_VALUES: Final = COMPILED_MOTION | {
    "sensor": DEFAULT_SENSOR,
    "weather": "clear",
    "time_of_day": "day",
}
"""Those, and where what is seen is what is there."""


def compiled_rules(config: Config) -> bool:
    """Whether compiled searches go by the motion, the behaviour, the sensor and the conditions of these."""
    return not config.slips and all(getattr(config, key) == value for key, value in COMPILED_VALUES.items())


def drives_in_batch(config: Config, planner: str) -> bool:
    """Whether a batch goes by the motion, the behaviour and the sensor of a configuration with a planner."""
    if config.slips or config.sensor_latency:
        return False
    if any(getattr(config, name) != value for name, value in COMPILED_MOTION.items()):
        return False
    return config.sensor == DEFAULT_SENSOR or (config.sensor in BUILT_IN and planner == SENSING_PLANNER)
