"""Answers about being stuck: what closes the way, since when, and when that could have been known."""

from __future__ import annotations

from service.contract.encode.lost_way import lost_way_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.lost_way import LostWay, lost_way
from sim.perceive.registry import sensor_named
from sim.plan import traits_of
from sim.types import Outcome


class LostWays:
    """Answers to "why did you get stuck?" and "when could you have known that there was no way?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Of a drive that did not end stuck, that is the answer."""
        ask, state = asked.ask, asked.timeline.state
        try:
            found = lost_way(asked.timeline)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        parts = self._knowable(found) if ask.what == "knowable" else self._why(found, state.world.outcome)
        return plain(self._sayings, ask, state, within(parts)) | {"what": ask.what} | lost_way_json(found)

    def _why(self, found: LostWay, outcome: Outcome) -> list[Part]:
        if found.open is not False:
            return self._still_open(found, outcome)
        told = [Part(0, self._since(found))]
        if found.made is not None and found.instead is not None and found.made is not found.instead:
            did, doing = self._sayings.move(found.made, "did"), self._sayings.move(found.instead, "doing")
            told.append(Part(0, capital(self._say("kept", did=did, doing=doing))))
        return [*told, Part(1, self._closed(found)), Part(2, self._knew(found)), Part(3, self._method(found))]

    def _still_open(self, found: LostWay, outcome: Outcome) -> list[Part]:
        """That a way was left where it got no further, or that this is not known."""
        tick = found.state.world.tick
        if outcome is Outcome.RUNNING:
            return [Part(0, self._say("not_stuck", "unknown" if found.open is None else "open"))]
        if found.open is None or found.plan is None:
            return [Part(0, self._say("unknown", tick=tick)), Part(1, self._method(found))]
        doing = self._sayings.move(found.plan[0], "doing")
        seconds = in_seconds(self._sayings, len(found.plan), found.state.config)
        planner = self._sayings.planner(found.state.config_of(None).planner, "id")
        told = self._say("missed", tick=tick, seconds=seconds, doing=doing, planner=planner)
        return [Part(0, told), Part(1, self._method(found))]

    def _since(self, found: LostWay) -> str:
        """Since when no way has been left."""
        assert found.shut_at is not None
        first = found.shut_at.world.tick
        if first == found.first:
            return self._say("since", "start", tick=first)
        if found.exact:
            return self._say("since", "exact", tick=first - 1)
        return self._say("since", "latest", tick=first)

    def _closed(self, found: LostWay) -> str:
        """What would have to go."""
        if found.shut is None:
            return ""
        if found.shut.late:
            return self._say("late")
        if not found.shut.ids:
            return self._say("many")
        state = found.shut_at or found.state
        who = Naming(self._sayings, state, as_seen=False).things(found.shut.ids)
        form = "one" if len(found.shut.ids) == 1 else "many"
        return self._say("without", form, who=who, tick=state.world.tick)

    def _knew(self, found: LostWay) -> str:
        """Whether what closes the way had been detected when the last way was given up."""
        if found.shut is None or not found.shut.ids or found.shut_at is None:
            return ""
        if sensor_named(found.state.config.sensor).faithful:
            return self._say("knew", "sees_all")
        if found.detected is None:
            return self._say("knew", "never")
        key = "before" if found.detected < found.shut_at.world.tick else "after"
        return self._say("knew", key, tick=found.detected)

    def _method(self, found: LostWay) -> str:
        """Whether the planner looks for a way at all, and since when it found none."""
        name = found.state.config_of(None).planner
        planner = self._sayings.planner(name, "id")
        if not traits_of(name).plans_to_goal:
            key = "passages" if traits_of(name).by_passages else "near"
            return self._say("method", key, planner=planner)
        if found.noticed is None:
            return ""
        return self._say("method", "noticed", planner=planner, tick=found.noticed)

    def _knowable(self, found: LostWay) -> list[Part]:
        """First the tick, then what was known of it."""
        if found.open is not False:
            return self._still_open(found, Outcome.RUNNING if found.open else Outcome.STUCK)
        assert found.shut_at is not None
        tick = found.shut_at.world.tick
        shown = found.shut is not None and bool(found.shut.ids)
        seen = sensor_named(found.state.config.sensor).faithful or not shown
        known = tick if seen else found.detected
        if known is None:
            told = [Part(0, self._say("knowable", "never", tick=tick))]
        else:
            told = [Part(0, self._say("knowable", "at", tick=max(tick, known)))]
            if known > tick:
                told.append(Part(1, self._say("knowable", "sooner", tick=tick, known=known)))
        since = Part(1, self._since(found)) if known in (None, tick) or seen else Part(2, "")
        return [*told, since, Part(2, self._closed(found)), Part(2, self._method(found))]

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("lost_way", *keys, **parts)
