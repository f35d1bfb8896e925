"""Figures as people can take them: charges and ticks as seconds of driving, chances as shares."""

from __future__ import annotations

from service.narration.sayings import Sayings
from sim.config import Config
from sim.explain.chances import Chances
from sim.plan import Measure
from sim.search.costs import weights

LEAST_S = 0.1
"""No difference is told as less than this, so that none reads as nothing."""


def seconds_worth(sayings: Sayings, cost: float, measure: Measure, config: Config) -> str:
    """A difference of costs in seconds: ticks as they are, charges by what a tick of driving is charged."""
    ticks = cost / weights(config).tick if measure is Measure.COST else cost
    return in_seconds(sayings, ticks, config)


def in_seconds(sayings: Sayings, ticks: float, config: Config) -> str:
    """Ticks as seconds, with one decimal at most."""
    seconds = ticks * config.step_seconds
    return sayings.number(round(max(LEAST_S, seconds), 1) if ticks else 0)


def likely(sayings: Sayings, found: Chances | None) -> str:
    """How likely it is to arrive: a share where it is exact, or how many of the futures that were drawn."""
    if found is None:
        return sayings.say("confidence", "likely", "unknown")
    if found.futures is not None:
        arrived = round(found.arrives * found.futures)
        return sayings.say("confidence", "likely", "drawn", arrived=arrived, futures=found.futures)
    percent = sayings.number(round(100 * found.arrives))
    if 0.0 < found.arrives < 0.01:
        percent = sayings.say("confidence", "below")
    elif 0.99 < found.arrives < 1.0:
        percent = sayings.say("confidence", "above")
    return sayings.say("confidence", "likely", "exact", percent=percent)
