"""Answers to "how is it going?" and "how many crashes so far?"."""

from __future__ import annotations

from service.contract.encode.forecast import figures_json
from service.narration.answerer import Json, plain
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.metrics import Metrics
from sim.state import SimState
from sim.statistics import wilson

ENOUGH = 5
"""Episodes from which on a rate is told, with its interval."""
MOST_COUNTED = 20
"""Moves up to which those of each kind are counted; of more, shares are told."""


class Figures:
    """Answers made from what the session has counted."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        run = asked.timeline.state
        metrics = run.metrics
        interval = wilson(metrics.successes, metrics.episodes) if metrics.episodes >= ENOUGH else None
        text = self._text(asked.ask.metric, run, interval)
        return plain(self._sayings, asked.ask, run, text) | figures_json(run, interval)

    def _text(self, metric: str | None, run: SimState, interval: tuple[float, float] | None) -> str:
        metrics = run.metrics
        if not metrics.steps:
            return self._say("nothing")
        match metric:
            case "crashes":
                return self._counted("crashes", metrics.crashes, metrics)
            case "successes":
                return self._counted("arrivals", metrics.successes, metrics)
            case "success_rate":
                return self._rate(metrics, interval)
            case "steps":
                return self._steps(run)
            case "moves":
                return self.moves(metrics)
            case "distance":
                return self.distance(metrics)
            case "speed":
                return self._speed(run)
            case _:
                return self._all(run, interval)

    def _all(self, run: SimState, interval: tuple[float, float] | None) -> str:
        metrics = run.metrics
        if not metrics.episodes:
            return " ".join([self._say("no_episode"), self.moves(metrics), self.distance(metrics)])
        counts = [
            self._many("arrivals", metrics.successes),
            self._many("crashes", metrics.crashes),
            self._many("stuck", metrics.stuck),
        ]
        counted = self._sayings.joined([count for count in counts if count])
        told = [self._say("all", counts=capital(counted), episodes=self._many("episodes", metrics.episodes))]
        if interval is not None:
            told.append(self._say("rate", **_shares(metrics, interval)))
        return " ".join([*told, self.moves(metrics), self.distance(metrics)])

    def _counted(self, key: str, count: int, metrics: Metrics) -> str:
        if not metrics.episodes:
            return self._say("no_figure")
        episodes = self._many("episodes", metrics.episodes)
        return self._say("all", counts=capital(self._many(key, count)), episodes=episodes)

    def _rate(self, metrics: Metrics, interval: tuple[float, float] | None) -> str:
        if not metrics.episodes:
            return self._say("no_figure")
        episodes = self._many("episodes", metrics.episodes)
        if interval is None:
            return self._say("too_few", hits=metrics.successes, episodes=episodes)
        shares = _shares(metrics, interval)
        return self._say("rate_of", hits=metrics.successes, episodes=episodes, **shares)

    def _steps(self, run: SimState) -> str:
        steps = run.metrics.steps
        seconds = self._sayings.number(round(steps * run.config.step_seconds, 1), ".10g")
        return self._say("steps", "one" if steps == 1 else "many", count=steps, seconds=seconds)

    def _speed(self, run: SimState) -> str:
        """The average speed, stops included."""
        seconds = run.metrics.steps * run.config.step_seconds
        return self._say(
            "speed",
            kmh=self._sayings.number(round(3.6 * run.metrics.distance_m / seconds, 1), ".10g"),
            metres=round(run.metrics.distance_m),
            seconds=self._sayings.number(round(seconds, 1), ".10g"),
        )

    def moves(self, metrics: Metrics) -> str:
        """The moves made, and how many are of each kind; of many moves their shares."""
        counts = {kind: getattr(metrics, kind) for kind in ("forward", "lateral", "diagonal", "stay")}
        few = "part" if metrics.steps > MOST_COUNTED else "part_few"
        parts = [
            self._say(
                "part_all" if 1 < count == metrics.steps else few,
                share=round(100 * count / metrics.steps),
                count=count,
                kind=self._say("kinds", kind),
            )
            for kind, count in counts.items()
            if count
        ]
        return self._say(
            "moves", moves=self._many("moves_made", metrics.steps), parts=self._sayings.joined(parts)
        )

    def distance(self, metrics: Metrics) -> str:
        """How far it was driven."""
        metres = metrics.distance_m
        if metres < 1000:
            return self._say("distance", distance=self._say("metres", count=round(metres)))
        return self._say(
            "distance", distance=self._say("kilometres", count=self._sayings.number(metres / 1000, ".1f"))
        )

    def _many(self, key: str, count: int) -> str:
        forms = self._sayings.words("metrics", key)
        form = "none" if count == 0 and "none" in forms else "one" if count == 1 else "many"
        return self._say(key, form, count=count)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("metrics", *keys, **parts)


def _shares(metrics: Metrics, interval: tuple[float, float]) -> dict[str, object]:
    low, high = interval
    share = round(100 * metrics.successes / metrics.episodes)
    # Outwards, so that the interval told is never narrower than the one computed.
    return {"share": share, "low": int(100 * low), "high": min(100, int(100 * high) + 1)}
