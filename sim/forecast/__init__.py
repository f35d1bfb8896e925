"""What is expected where, and who: Percept → Forecast. It is the one thing planners read."""

from sim.forecast.forecast import Forecast, StepVerdict, predict
from sim.forecast.mover_rollout import RollOut
from sim.forecast.reachable_sets import Occupancy, ReachableSets

__all__ = ["Forecast", "Occupancy", "ReachableSets", "RollOut", "StepVerdict", "predict"]
