"""What a search has shown of the ticks ahead, kept for the decisions that follow on the same road.

A drive asks again at every tick. As long as everything goes on as was foretold, what was found of a later
tick holds: its costs and bounds are looked up, and not searched for again. A forecast follows on an earlier
one if after its first tick everything stands where the earlier one had it then; from there on both are alike.
"""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass, field
from typing import Any, Final

from sim.forecast import Forecast
from sim.search.costs import Weights

KEPT: Final = 6
"""Forecasts of which it is kept: those of a drive and of the ones beside it in an answer."""


@dataclass(slots=True)
class Known:
    """What is known of the ticks of a forecast."""

    forecast: Forecast
    weights: Weights | None
    """the charges it was searched with; None where they have no part in it"""
    limit: int
    """steps left at its beginning"""
    found: Any
    """as the search wants it"""


@dataclass
class _Store(threading.local):
    latest: dict[str, deque[Known]] = field(default_factory=dict)


_STORE = _Store()


def forget() -> None:
    """Forget all that is kept; what is decided is the same."""
    _STORE.latest.clear()


def keep(search: str, known: Known) -> None:
    """Keep what a search has found, and forget the oldest. `search`: what kind it is."""
    _STORE.latest.setdefault(search, deque(maxlen=KEPT)).appendleft(known)


def continued(
    search: str, forecast: Forecast, weights: Weights | None, limit: int
) -> tuple[Known, int] | None:
    """What is known of the ticks of a forecast, and how many ticks before it that begins; None: nothing."""
    if forecast.egos:
        return None
    for known in _STORE.latest.get(search, ()):
        ahead = forecast.episode_tick - known.forecast.episode_tick
        same = known.weights == weights and known.limit == limit + ahead
        if ahead >= 0 and same and _follows(forecast, known.forecast, ahead):
            return known, ahead
    return None


def _follows(forecast: Forecast, earlier: Forecast, ahead: int) -> bool:
    """Whether from the end of its first tick on a forecast is the same as an earlier one."""
    if ahead >= len(earlier.slices) or forecast.boards.fixed != earlier.boards.fixed:
        return False
    return (
        forecast.dynamics is earlier.dynamics
        and forecast.disabled == earlier.disabled
        and forecast.slices[0] == earlier.slices[ahead]
        and forecast.slices.marked(0) == earlier.slices.marked(ahead)
        and forecast.percept.behaviour == earlier.percept.behaviour
        and forecast.percept.doubtful == earlier.percept.doubtful
    )
