"""What is expected where, and who: Percept → Forecast. It is the one thing planners read."""

from sim.forecast.rollout import RollOut, Slice
from sim.forecast.volume import Forecast, Verdict, foretell

__all__ = ["Forecast", "RollOut", "Slice", "Verdict", "foretell"]
