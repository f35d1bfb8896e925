"""What is expected where, and who: Percept → Forecast. It is the one thing planners read."""

from sim.forecast.forecast import Forecast, StepVerdict, predict
from sim.forecast.mover_rollout import RollOut

__all__ = ["Forecast", "RollOut", "StepVerdict", "predict"]
