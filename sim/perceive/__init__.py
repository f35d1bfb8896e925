"""What the sensors let through: World → Percept. The planner sees this and nothing else.

Camera, lidar, radar, weather and night come behind this door; today there is the perfect sensor.
"""

from sim.perceive.percept import OtherEgo, Percept
from sim.perceive.perfect import perceive

__all__ = ["OtherEgo", "Percept", "perceive"]
