"""What the sensors let through: (World, Belief) → (Percept, Belief). The planner sees the percept alone.

`perfect` shows the truth. `camera`, `lidar`, `radar` and `fusion` err (`parameters`), and what they report is
gathered in a belief (`bayes_filter`); a program can register further sensors. Proofs do not use sensors: they
read the ground truth (`perceive_truth`, `sim.forecast.Forecast.of_truth`).
"""

from sim.perceive.percept import CERTAIN, OtherEgo, Percept
from sim.perceive.perfect import perceive_truth
from sim.perceive.registry import perceive, register_sensor, sensor_named, unregister_sensor
from sim.perceive.sensor import NO_BELIEF, Belief, Sensor

__all__ = [
    "CERTAIN",
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
