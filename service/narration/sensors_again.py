"""Which sensor would have led to the goal, and whether the present one is to blame: driven again."""

from __future__ import annotations

from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.explain.attribution import attribute, rerun
from sim.perceive.parameters import SUITES
from sim.perceive.registry import sensor_named
from sim.plan import traits_of
from sim.sensor_names import DEFAULT_SENSOR
from sim.types import Outcome


class SensorsAgain:
    """Answers to "which sensor would have prevented it?", "was the radar to blame?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. It is not looked for with planners that take long."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        fault = ask.what == "sensor_fault"
        if fault and (otherwise := self._not_at_fault(asked)) is not None:
            return plain(self._sayings, ask, state, otherwise) | {"what": ask.what}
        if state.world.outcome not in (Outcome.CRASH, Outcome.STUCK) or len(state.world.avs) > 1:
            text = self._fault("not_failed") if fault else self._say("not_failed")
            return plain(self._sayings, ask, state, text) | {"what": ask.what}
        if not traits_of(state.config.planner).quick:
            return plain(self._sayings, ask, state, not_so(self._sayings, "too_long_again", {}))
        if fault:
            return self._blamed(asked)
        found = attribute(timeline)
        told = [] if found is None else [each for each in found.alternatives if each.setting == "sensor"]
        if not told or any(each.outcome is None for each in told):
            return plain(self._sayings, ask, state, not_so(self._sayings, "not_again", {}))
        good = [self._say("with", each.value) for each in told if each.avoids]
        bad = [self._say("with", each.value) for each in told if not each.avoids]
        key = "none" if not good else "some" if bad else "all"
        text = self._say(key, good=self._sayings.joined(good), bad=self._sayings.joined(bad))
        facts = [{"sensor": each.value, "outcome": each.outcome, "ticks": each.ticks} for each in told]
        return plain(self._sayings, ask, state, text) | {"what": ask.what, "driven_again": facts}

    def _not_at_fault(self, asked: Asked) -> str | None:
        """Why nothing needs to be driven again: it is another sensor, or one that shows all there is."""
        config, value = asked.timeline.state.config, asked.ask.value
        sensor = value_of(self._sayings, "sensor", config.sensor)
        part = config.sensor == "fusion" and str(value) in [each.name for each in SUITES["fusion"]]
        if value is not None and value != config.sensor and not part:
            named = value_of(self._sayings, "sensor", str(value))
            return self._fault("another", named=named, sensor=sensor)
        return self._fault("perfect") if sensor_named(config.sensor).faithful else None

    def _blamed(self, asked: Asked) -> Json:
        """Yes if the same drive with the perfect sensor arrives; how it ends in either case."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        again = rerun(timeline, {"sensor": DEFAULT_SENSOR})
        if again is None or again.outcome is None:
            return plain(self._sayings, ask, state, not_so(self._sayings, "not_again", {}))
        answer = self._sayings.say("ahead", "answer", "agree" if again.avoids else "disagree")
        seconds = in_seconds(self._sayings, again.ticks, state.config)
        told = [self._fault(str(again.outcome), answer=answer, seconds=seconds)]
        if ask.value is not None and ask.value != state.config.sensor:
            told.append(self._fault("part", named=value_of(self._sayings, "sensor", str(ask.value))))
        facts = {"sensor": DEFAULT_SENSOR, "outcome": again.outcome, "ticks": again.ticks}
        return plain(self._sayings, ask, state, " ".join(told)) | {"what": ask.what, "driven_again": [facts]}

    def _fault(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("sight", "fault", *keys, **parts)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("sight", "prevents", *keys, **parts)
