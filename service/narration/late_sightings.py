"""Answers to "was anything detected only at the last moment?": what was near before it was first detected."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.sayings import Sayings
from service.narration.values import conditions_of
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.late import NEAR_ROWS, FirstLook, LateThings, late_things
from sim.explain.question_error import QuestionError
from sim.types import Kind

MOST_TOLD: Final = 3
"""Things that are told one by one; more are counted."""


class LateSightings:
    """Answers about things that were detected late."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        kind = None if ask.kind is None else Kind(ask.kind)
        try:
            found = late_things(asked.timeline, kind)
        except QuestionError as error:
            if error.code == "nothing_yet":
                told = self._sayings.say("sightings", "not_begun")
            elif error.code == "too_long":
                told = self._sayings.say("history", error.code, **error.facts)
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        text = within(self._told(found, kind, state.config))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | _json(found)

    def _told(self, found: LateThings, kind: Kind | None, config: Config) -> list[Part]:
        """Yes or no with what was late, then what was never detected, what near is, and the reach."""
        things = self._say("things") if kind is None else self._sayings.things(kind, 2)
        if found.faithful:
            return [Part(0, self._say("faithful"))]
        near = Part(2, self._say("near", rows=NEAR_ROWS))
        never = self._say("never", things=self._list(found.never)) if found.never else ""
        if found.late:
            first = self._say("some", count=len(found.late), things=self._list(found.late))
            return [Part(0, first), Part(1, never), near, Part(1, self._reach(found, config))]
        if found.never:
            first = self._say("only_never", things=self._list(found.never))
            return [Part(0, first), near, Part(1, self._reach(found, config))]
        if not found.in_time:
            return [Part(0, self._say("none_near", things=things)), near, Part(1, self._reach(found, config))]
        key = "one" if len(found.in_time) == 1 else "many"
        first = self._say("none", key, count=len(found.in_time))
        return [Part(0, first), near, Part(1, self._reach(found, config))]

    def _list(self, looks: Sequence[FirstLook]) -> str:
        """The nearest few, with how far ahead each was and when, then how many more."""
        told = [
            self._say(
                "one",
                "one" if each.rows == 1 else "many",
                a=self._sayings.say("words", "a", each.kind),
                rows=each.rows,
                tick=each.tick,
            )
            for each in looks[:MOST_TOLD]
        ]
        if len(looks) > MOST_TOLD:
            told.append(self._say("more", count=len(looks) - MOST_TOLD))
        return self._sayings.listed(told)

    def _reach(self, found: LateThings, config: Config) -> str:
        """How far the sensor reaches now."""
        if found.reach is None:
            return ""
        metres = self._sayings.number(round(found.reach.metres, 1))
        key = "one" if found.reach.cells == 1 else "many"
        conditions = conditions_of(self._sayings, config)
        return self._say("reach", key, cells=found.reach.cells, metres=metres, conditions=conditions)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("late", *keys, **parts)


def _json(found: LateThings) -> Json:
    def looks(of: Sequence[FirstLook]) -> list[Json]:
        return [
            {"id": each.id, "tick": each.tick, "rows_ahead": each.rows, "lanes_aside": each.lanes}
            for each in of
        ]

    return {
        "first": found.first,
        "last": found.last,
        "late": looks(found.late),
        "never": looks(found.never),
        "in_time": looks(found.in_time),
        "reach_m": None if found.reach is None else round(found.reach.metres, 3),
    }
