"""What other sensors or other conditions would have changed: "would you have crashed with lidar by day?"."""

from __future__ import annotations

from typing import Any, Final

from service.actions import Ask
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.sayings import Sayings
from service.narration.supposed_ends import SEES, agrees
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.actions import Set
from sim.config import ConfigError
from sim.explain.attribution import Rerun, rerun, seen_since
from sim.plan import traits_of
from sim.sensor_names import DEFAULT_SENSOR
from sim.state import SimState
from sim.types import Outcome

_VARIED: Final = ("sensor", "weather", "time_of_day")


class HadBeen:
    """The drive that failed, driven again with some settings otherwise."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def told(self, asked: Asked) -> tuple[str, dict[str, Any]]:
        """What would have been, and the same as facts; nothing where that was not asked, or nothing failed.

        It is not looked for with planners that take long.
        """
        timeline = asked.timeline
        state = timeline.state
        varied = _varied(asked.ask, state)
        if not varied or len(state.world.avs) > 1 or not traits_of(state.config.planner).quick:
            return "", {}
        try:
            found = rerun(timeline, varied)
        except ConfigError:
            return "", {}
        if found is None or found.outcome is None:
            return "", {}
        since = seen_since(timeline, varied)
        facts = {"settings": varied, "outcome": found.outcome, "ticks": found.ticks, "seen_since": since}
        return self._sentences(asked, varied, found, since), {"had_been": facts}

    def _sentences(self, asked: Asked, varied: dict[str, str], found: Rerun, since: int | None) -> str:
        state = asked.timeline.state
        supposed = [
            self._say(
                "supposed",
                name=self._sayings.say("whatif", "settings", setting),
                value=value_of(self._sayings, setting, value),
            )
            for setting, value in varied.items()
        ]
        crashed = state.world.outcome is Outcome.CRASH
        told = []
        as_supposed = since is not None if asked.supposes == SEES and crashed else None
        if found.outcome is not None and as_supposed is None:
            as_supposed = agrees(asked.supposes, found.outcome)
        if as_supposed is not None:
            word = yes_and_no(self._sayings, asked)["yes" if as_supposed else "no"]
            told.append(self._sayings.say("whatif", "yes_no", word=word))
        if crashed and state.config.sensor != DEFAULT_SENSOR:
            key = "unseen" if since is None else "seen"
            told.append(self._say(key, supposed=self._sayings.joined(supposed), tick=since))
        after = in_seconds(self._sayings, found.ticks, state.config)
        told.append(self._say("driven", str(found.outcome), seconds=after))
        return " ".join(told)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("whatif", "had_been", *keys, **parts)


def _varied(ask: Ask, state: SimState) -> dict[str, str]:
    """The settings that are otherwise, where a change is of nothing else; empty where all are so already."""
    change = ask.change or ()
    if ask.tick is not None or ask.count is not None:
        return {}
    varied: dict[str, str] = {}
    for action in change:
        if not isinstance(action, Set) or action.parameter not in _VARIED:
            return {}
        varied[action.parameter] = str(action.value)
    return {name: value for name, value in varied.items() if value != getattr(state.config, name)}
