"""Which sensor would have led to the goal: the drive that failed, driven again with each of them."""

from __future__ import annotations

from service.narration.answerer import Json, not_so, plain
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.explain.attribution import attribute
from sim.plan import traits_of
from sim.types import Outcome


class SensorsAgain:
    """Answers to "which sensor would have prevented it?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. It is not looked for with planners that take long."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        if state.world.outcome not in (Outcome.CRASH, Outcome.STUCK) or len(state.world.avs) > 1:
            return plain(self._sayings, ask, state, self._say("not_failed")) | {"what": ask.what}
        if not traits_of(state.config.planner).quick:
            return plain(self._sayings, ask, state, not_so(self._sayings, "too_long_again", {}))
        found = attribute(timeline)
        told = [] if found is None else [each for each in found.alternatives if each.setting == "sensor"]
        if not told or any(each.outcome is None for each in told):
            return plain(self._sayings, ask, state, not_so(self._sayings, "not_again", {}))
        good = [value_of(self._sayings, "sensor", each.value) for each in told if each.avoids]
        bad = [value_of(self._sayings, "sensor", each.value) for each in told if not each.avoids]
        key = "none" if not good else "some" if bad else "all"
        text = self._say(key, good=self._sayings.joined(good), bad=self._sayings.joined(bad))
        facts = [{"sensor": each.value, "outcome": each.outcome, "ticks": each.ticks} for each in told]
        return plain(self._sayings, ask, state, text) | {"what": ask.what, "driven_again": facts}

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("sight", "prevents", key, **parts)
