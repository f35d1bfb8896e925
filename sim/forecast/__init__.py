"""What is expected where, and who: Percept → Forecast. It is the one thing planners read."""

from sim.forecast.volume import Forecast, Slice, Verdict, foretell

__all__ = ["Forecast", "Slice", "Verdict", "foretell"]
