"""What is expected where, and who: Percept → Forecast. It is the one thing planners read."""

from sim.forecast.rollout import RollOut
from sim.forecast.volume import Forecast, Verdict, foretell

__all__ = ["Forecast", "RollOut", "Verdict", "foretell"]
