"""Costs of planners as people can take them: a charge is told as the seconds of driving that cost as much."""

from __future__ import annotations

from service.narration.sayings import Sayings
from sim.config import Config
from sim.plan import Measure
from sim.search.costs import weights

LEAST_S = 0.1
"""No difference is told as less than this, so that none reads as nothing."""


def seconds_worth(sayings: Sayings, cost: float, measure: Measure, config: Config) -> str:
    """A difference of costs in seconds: of ticks as they are, of charges by what a tick of driving is charged."""
    ticks = cost / weights(config).tick if measure is Measure.COST else cost
    return in_seconds(sayings, ticks, config)


def in_seconds(sayings: Sayings, ticks: float, config: Config) -> str:
    """Ticks as seconds, with one decimal at most."""
    seconds = ticks * config.step_seconds
    return sayings.number(round(max(LEAST_S, seconds), 1) if ticks else 0)
