"""Answers that trace things: how old is what is believed of them, and where they were in the last ticks."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.sightings import thing_meant
from service.sessions.facts import Asked
from sim.explain.last_detected import BeliefAges, LastDetected, last_detected
from sim.explain.places_before import TICKS, PlacesBefore, places_before
from sim.explain.question_error import QuestionError
from sim.session.errors import EditError

MOST_TOLD: Final = 5
"""Ticks at which a place is told; the facts have all."""


class ThingsTraced:
    """Answers to "how old is what you know about that car?" and "where was it before the crash?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            id = None if ask.which is None else thing_meant(asked)
            if ask.what == "last_detected":
                ages = last_detected(timeline)
                text, facts = self._ages(ages, id), _ages_json(ages)
            else:
                found = places_before(timeline, ask.ticks or TICKS, id)
                text, facts = self._places(found), _places_json(found)
        except EditError:
            text, facts = self._sayings.say("past", "none_to_ask"), Json()
        except QuestionError as error:
            if error.code == "not_there_before":
                text = self._say("not_there")
            else:
                text = not_so(self._sayings, error.code, error.facts)
            facts = Json()
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _ages(self, found: BeliefAges, id: str | None) -> str:
        if not found.known:
            return self._say("age", "unknown_sensor")
        if id is not None:
            each = found.find(id)
            if each is None:
                return self._say("age", "not_believed")
            return within([Part(0, self._age(found, each)), Part(1, self._faithful(found))])
        if not found.found:
            return self._say("age", "nothing")
        if found.faithful:
            return self._say("age", "all_fresh", count=len(found.found))
        fresh = sum(found.age(each) == 0 for each in found.found)
        counts = self._say("age", "counts", fresh=fresh, total=len(found.found))
        return within(
            [Part(0, self._say("age", "oldest", told=self._age(found, found.found[0]))), Part(1, counts)]
        )

    def _age(self, found: BeliefAges, each: LastDetected) -> str:
        config = found.state.config
        who = Naming(self._sayings, found.state).thing(each.thing.id)
        age = found.age(each)
        if age is None:
            ticks = found.state.world.tick - found.first + 1
            return self._say("age", "older", who=who, ticks=ticks)
        key = "fresh" if not age else "one" if age == 1 else "old"
        seconds = in_seconds(self._sayings, age, config)
        return self._say("age", key, who=who, ticks=age, seconds=seconds, tick=each.tick)

    def _faithful(self, found: BeliefAges) -> str:
        return self._say("age", "faithful") if found.faithful else ""

    def _places(self, found: PlacesBefore) -> str:
        parts = []
        for state, lanes, rows in found.places[-MOST_TOLD:]:
            column, row = state.world.road.cell(state.world.av)
            place = Naming(self._sayings, state, as_seen=False).place((column + lanes, row - rows))
            ago = found.tick - state.world.tick
            key = "now" if not ago else "one" if ago == 1 else "many"
            parts.append(self._say("place", key, ticks=ago, place=place))
        who = self._sayings.say("naming", "the", found.kind)
        key = "crash" if found.crashed else "now"
        return capital(self._say("places", key, who=who, tick=found.tick, parts="; ".join(parts)))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("things_traced", *keys, **parts)


def _ages_json(found: BeliefAges) -> Json:
    return {
        "faithful": found.faithful,
        "last_detected": [
            {"id": each.thing.id, "kind": each.thing.kind, "tick": each.tick} for each in found.found
        ],
    }


def _places_json(found: PlacesBefore) -> Json:
    return {
        "id": found.id,
        "of": found.tick,
        "crashed": found.crashed,
        "places": [
            {"tick": state.world.tick, "lanes": lanes, "rows": rows} for state, lanes, rows in found.places
        ],
    }
