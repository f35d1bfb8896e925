"""What the sensors let through: (World, Belief) → (Percept, Belief). The planner sees the percept alone.

The perfect sensor is the only built-in one; further sensors (camera, lidar, radar) are registered. Proofs
do not use sensors: they read the ground truth (`perceive_truth`, `sim.forecast.Forecast.of_truth`).
"""

from sim.perceive.percept import OtherEgo, Percept
from sim.perceive.perfect import perceive_truth
from sim.perceive.registry import perceive, register_sensor, sensor_named, unregister_sensor
from sim.perceive.sensor import NO_BELIEF, Belief, Sensor

__all__ = [
    "NO_BELIEF",
    "Belief",
    "OtherEgo",
    "Percept",
    "Sensor",
    "perceive",
    "perceive_truth",
    "register_sensor",
    "sensor_named",
    "unregister_sensor",
]
