"""What the sensors let through: (World, Belief) → (Percept, Belief). The planner sees the percept alone.

Camera, lidar, radar, weather and night come behind this door; today there is the perfect sensor. Proofs do
not look through it: they stand on the truth (`perceive_truth`, `sim.forecast.Forecast.of_truth`).
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
