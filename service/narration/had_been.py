"""What another sensor or other conditions would have changed: "would you have crashed with lidar?"."""

from __future__ import annotations

from typing import Any

from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.actions import Set
from sim.config import ConfigError
from sim.explain.attribution import Alternative, rerun, seen_since
from sim.plan import traits_of
from sim.sensor_names import DEFAULT_SENSOR
from sim.types import Outcome

_VARIED = ("sensor", "weather", "time_of_day")


class HadBeen:
    """The drive that failed, driven again with one setting otherwise."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def told(self, asked: Asked) -> tuple[str, dict[str, Any]]:
        """What would have been, and the same as facts; nothing where that was not asked, or nothing failed.

        It is not looked for with planners that take long.
        """
        change, timeline = asked.ask.change or (), asked.timeline
        state = timeline.state
        if len(change) != 1 or asked.ask.tick is not None or len(state.world.avs) > 1:
            return "", {}
        (action,) = change
        if not isinstance(action, Set) or action.parameter not in _VARIED:
            return "", {}
        setting, value = action.parameter, str(action.value)
        if value == getattr(state.config, setting) or not traits_of(state.config.planner).quick:
            return "", {}
        try:
            found = rerun(timeline, setting, value)
        except ConfigError:
            return "", {}
        if found is None or found.outcome is None:
            return "", {}
        since = seen_since(timeline, setting, value)
        facts = {"setting": setting, "value": value, "outcome": found.outcome, "ticks": found.ticks}
        return self._sentences(asked, found, since), {"had_been": facts | {"seen_since": since}}

    def _sentences(self, asked: Asked, found: Alternative, since: int | None) -> str:
        state = asked.timeline.state
        value = value_of(self._sayings, found.setting, found.value)
        name = self._sayings.say("whatif", "settings", found.setting)
        told = []
        if state.world.outcome is Outcome.CRASH and state.config.sensor != DEFAULT_SENSOR:
            key = "unseen" if since is None else "seen"
            told.append(self._say(key, name=name, value=value, tick=since))
        after = in_seconds(self._sayings, found.ticks, state.config)
        told.append(self._say("driven", str(found.outcome), name=name, value=value, seconds=after))
        return " ".join(told)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("whatif", "had_been", *keys, **parts)
