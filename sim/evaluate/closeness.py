"""How near things came to the ego in an episode: gaps, times to collision, and how restless the drive was."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, nan
from typing import Final

from sim.explain.closest_call import encounters, least_gap, ticks_to_contact
from sim.state import SimState
from sim.types import Move

TTC_S: Final = 1.5
"""Time to collision, in seconds, up to which a tick counts as exposed.

The usual limit of studies of near misses; the time spent below is the time-exposed time to collision
(Minderhoud & Bovy, "Extended time-to-collision measures for road traffic safety assessment", 2001).
"""


@dataclass
class Closeness:
    """What is seen of one episode, tick by tick."""

    gap_m: float = inf
    ttc_s: float = inf
    exposed: int = 0
    changes: int = 0
    _last: Move | None = field(default=None, repr=False)

    def add(self, before: SimState, after: SimState, move: Move | None) -> None:
        """Look at one tick."""
        soonest = inf
        for _, own, other in encounters(before.world, after.world):
            gap_m = least_gap(own, other) * before.config.cell_m
            if gap_m > 0:
                self.gap_m = min(self.gap_m, gap_m)
            ticks = ticks_to_contact(own, other)
            if ticks is not None:
                soonest = min(soonest, ticks * before.config.step_seconds)
        self.ttc_s = min(self.ttc_s, soonest)
        self.exposed += soonest <= TTC_S
        self.changes += self._last is not None and move is not self._last
        self._last = move

    def values(self) -> dict[str, float]:
        """The columns of this episode (`sim.evaluate.rows`)."""
        return {
            "gap_m": round(self.gap_m, 4) if self.gap_m < inf else nan,
            "ttc_s": round(self.ttc_s, 4) if self.ttc_s < inf else nan,
            "exposed": self.exposed,
            "changes": self.changes,
        }
