"""Where no way leads to the goal: from which cells it could still be reached, and where one can keep clear.

Structure: two sweeps backwards through all ticks that are left, by whole boards. They are kept
(`sim.search.continued`), so that a vehicle that is shut in looks up at every tick what else it would have to
search the whole rest of the episode for. Guarantee: exact for the forecast that is handed in.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.forecast import Forecast
from sim.search.continued import Known, continued, keep
from sim.world.grid import Board

SHUT_IN: Final = "shut in"
"""The kind of search under which the sweeps are kept."""
ASKED: Final = "asked_shut_in"
"""The kind under which it is kept what was asked about."""


@dataclass(frozen=True, slots=True)
class Outlook:
    """By ticks from the beginning of a forecast."""

    arriving: tuple[Board, ...]
    """cells from which row 0 is reached in time"""
    lasting: tuple[Board, ...]
    """cells from which one can keep clear for all the steps that are left"""


def look_ahead(forecast: Forecast, limit: int) -> None:
    """Sweep back from the end of the episode, and keep what is found."""
    if forecast.egos or limit < 1:
        return
    goal = forecast.road.row(0)
    arriving, lasting = [goal], [forecast.road.all]
    for ahead in range(limit - 1, 0, -1):
        blocked = forecast.blocked(ahead)
        arriving.append(goal | forecast.spread_back(arriving[-1] & ~blocked, ahead))
        lasting.append(forecast.spread_back(lasting[-1] & ~blocked, ahead))
    arriving.append(0)  # of the present cell nothing is asked
    lasting.append(0)
    keep(SHUT_IN, Known(forecast, None, limit, Outlook(tuple(arriving[::-1]), tuple(lasting[::-1]))))


def look_ahead_if_asked_again(forecast: Forecast, limit: int) -> None:
    """Sweep back if a tick before was asked about already: then the ticks that follow are, too."""
    if continued(SHUT_IN, forecast, None, limit) is not None:
        return
    if continued(ASKED, forecast, None, limit) is not None:
        look_ahead(forecast, limit)
    elif not forecast.egos:
        keep(ASKED, Known(forecast, None, limit, None))


def shut_in(forecast: Forecast, starts: Board, limit: int) -> bool:
    """Whether it is known that from none of these cells, entered in the coming tick, row 0 is reached."""
    found = continued(SHUT_IN, forecast, None, limit)
    return found is not None and not starts & found[0].found.arriving[found[1] + 1]


def known_to_last(forecast: Forecast, limit: int) -> Board:
    """The cells, entered in the coming tick, of which it is known that one can keep clear to the end."""
    found = continued(SHUT_IN, forecast, None, limit)
    return 0 if found is None else found[0].found.lasting[found[1] + 1]
