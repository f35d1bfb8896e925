"""Answers to "how worn is the suspension?": what is counted, and that wear is not.

Nothing in this world wears, and no figure is made up for it. Distance and crashes are counted; a service by
distance alone is due by an interval that is stated with it.
"""

from __future__ import annotations

from typing import Final

from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.metrics import Metrics

SERVICE_INTERVAL_M: Final = 15_000_000
"""Metres between two services by distance alone: 15,000 km, as is usual for cars. Agreed, not measured."""


class Maintenance:
    """Answers to questions about wear."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        run = asked.timeline.state
        metrics = run.metrics
        left = SERVICE_INTERVAL_M - metrics.distance_m % SERVICE_INTERVAL_M
        return plain(self._sayings, asked.ask, run, self._text(metrics, left)) | {
            "distance_m": round(metrics.distance_m, 3),
            "crashes": metrics.crashes,
            "potholes_hit": None if metrics.crashes else 0,
            "service_interval_m": SERVICE_INTERVAL_M,
            "service_in_m": round(left, 3),
            "wear": None,
        }

    def _text(self, metrics: Metrics, left: float) -> str:
        key = "none" if not metrics.crashes else "one" if metrics.crashes == 1 else "many"
        crashes = self._say("crashes", key, count=metrics.crashes)
        return " ".join(
            (
                self._say("unmeasured"),
                self._say("driven", driven=self._distance(metrics.distance_m), crashes=crashes),
                self._say("due", interval=self._distance(SERVICE_INTERVAL_M), left=self._distance(left)),
            )
        )

    def _distance(self, metres: float) -> str:
        if metres < 1000:
            return self._say("metres", metres=f"{metres:.0f}")
        tenths = round(metres / 1000, 1)
        kilometres = self._sayings.number(tenths, ",.0f" if tenths.is_integer() else ",.1f")
        return self._say("kilometres", kilometres=kilometres)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("maintenance", *keys, **parts)
