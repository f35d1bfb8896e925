"""Answers about sensing: what is imagined, what is missed, how far it reaches, what the weather did."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Final

from service.contract.encode.sight import sensing_json, weather_effect_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.sensing_compared import conditions_said
from service.narration.values import conditions_of
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.misperception import NONE
from sim.explain.sensing import Reach, Sensing, reach, sensing
from sim.explain.weather_effect import CLEAR, WeatherEffect, weather_effect
from sim.perceive import sensor_named
from sim.types import PLACEABLE, Kind, Outcome
from sim.world import Thing

MOST_TOLD: Final = 3
"""Things that are named; more are counted."""


class Sights:
    """Answers to "what do you miss?", "how far can you see?", "did the weather cause it?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        if ask.what == "weather":
            try:
                effect = weather_effect(asked.timeline)
            except QuestionError as error:
                return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
            text = self._weather(effect, asked)
            return plain(self._sayings, ask, state, text) | {"what": ask.what} | weather_effect_json(effect)
        if ask.what == "range":
            return self._range_asked(asked)
        found = sensing(state)
        tellers: dict[str, Callable[[Sensing], str]] = {
            "phantoms": self._phantoms,
            "missed": partial(self._missed, kind=ask.kind and Kind(ask.kind)),
            "truth": self._truth,
            "blind": self._blind,
        }
        text = tellers[str(ask.what)](found)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | sensing_json(found)

    def _phantoms(self, found: Sensing) -> str:
        if found.faithful:
            return self._say("phantoms", "faithful")
        things = found.wrong.phantoms
        told = self._named(things, found, as_seen=True)
        return self._say("phantoms", _form(things), count=len(things), things=told)

    def _missed(self, found: Sensing, kind: Kind | None) -> str:
        if found.faithful:
            return self._say("missed", "faithful")
        return self._undetected(found if kind is None else found.of_kind(kind), MOST_TOLD, kind)

    def _undetected(self, found: Sensing, most: int, kind: Kind | None = None) -> str:
        """What is not detected (of one `kind`, if said), the nearest first, and how much is out of range."""
        things, total = found.wrong.missed, found.things
        if kind is None:
            said, of = "missed", ""
        else:
            said, of = "missed_kind", self._sayings.things(kind, 1 if total == 1 and things else 2)
        if not things:
            return self._say(said, "all" if total else "empty", total=total, of=of)
        told = self._named(things, found, as_seen=False, most=most)
        text = self._say(said, _form(things), count=len(things), total=total, things=told, of=of)
        far = found.out_of_range
        return f"{text} {self._say('out_of_range', _count(far), count=far)}" if far else text

    def _truth(self, found: Sensing) -> str:
        """What is there by kinds, then what is seen otherwise."""
        counts = found.state.world.counts()
        parts = [
            self._say("counted", count=counts[kind], things=self._sayings.things(kind, counts[kind]))
            for kind in PLACEABLE
            if counts.get(kind)
        ]
        there = self._say("truth", "there", things=self._sayings.joined(parts))
        told = [Part(0, there if parts else self._say("truth", "empty"))]
        wrong = found.wrong
        if not (wrong.phantoms or wrong.missed):
            told.append(Part(0, self._say("truth", "faithful" if found.faithful else "as_seen")))
        if wrong.missed:
            told.append(Part(0, self._undetected(found, 1)))
        if wrong.phantoms:
            told.append(Part(1, self._phantoms(found)))
        return within(told)

    def _range_asked(self, asked: Asked) -> Json:
        """The range of the sensor and in the conditions that are named, else of the present ones."""
        ask, state = asked.ask, asked.timeline.state
        config, supposed = conditions_said(state.config, (asked.supposes or "").split())
        if ask.value is not None:
            config = replace(config, sensor=str(ask.value))
        if config == state.config:
            there = sensing(state)
            facts = sensing_json(there)
        else:
            faithful = sensor_named(config.sensor).faithful
            found = None if faithful else reach(config)
            there, facts = Sensing(replace(state, config=config), faithful, found, NONE, 0), Json()
        text = self._range(there)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts | supposed

    def _range(self, found: Sensing) -> str:
        """How far it detects anything, and up to where half of the looks find a car or a pothole."""
        config, reached = found.state.config, found.reach
        if found.faithful:
            metres = self._metres(found.state.world.road.rows, found)
            return self._say("range", "faithful", metres=metres)
        if reached is None:
            return self._say("range", "unknown", sensor=config.sensor)
        told = self._say(
            "range",
            "limit",
            conditions=conditions_of(self._sayings, config),
            metres=self._sayings.number(round(reached.metres, 1)),
            cells=self._say("cells", _count(reached.cells), count=reached.cells),
        )
        return " ".join([told, *(self._half(kind, reached, found) for kind in (Kind.VEHICLE, Kind.POTHOLE))])

    def _half(self, kind: Kind, reach: Reach, found: Sensing) -> str:
        a = self._sayings.say("words", "a", kind)
        cells = reach.half[kind]
        return self._say("half", "some" if cells else "none", a=a, metres=self._metres(cells, found))

    def _blind(self, found: Sensing) -> str:
        """Yes or no first."""
        if found.faithful:
            return self._say("blind", "faithful")
        if found.blind:
            return " ".join([self._say("blind", "yes"), self._undetected(found, 1)])
        key = "partly" if found.wrong.missed else "no"
        told = self._say("blind", key)
        return " ".join([told, self._undetected(found, 1)]) if found.wrong.missed else told

    def _weather(self, found: WeatherEffect, asked: Asked) -> str:
        """Yes or no first; then how the drive goes in clear weather."""
        no, yes = (self._sayings.say("ahead", "answer", key) for key in ("disagree", "agree"))
        if found.weather == CLEAR:
            return self._say("weather", "clear", no=no)
        word = yes if found.caused else no
        weather = self._say("without", found.weather)
        if asked.supposes in self._sayings.words("sight", "without") and asked.supposes != found.weather:
            other = self._say("there_is_none", str(asked.supposes))
            return self._say("weather", "another", no=no, other=other, weather=self._say("is", found.weather))
        told = [Part(0, self._ends(found, asked, word=word, weather=weather))]
        differs = found.differs
        if differs is not None:
            move = self._sayings.move(differs.would, "name")
            made = self._sayings.move(differs.made, "name")
            told.append(Part(1, self._say("differs", tick=differs.tick, would=move, made=made)))
        return within(told)

    def _ends(self, found: WeatherEffect, asked: Asked, *, word: str, weather: str) -> str:
        """How it would have ended, or whether any move would have been another one."""
        if found.clear_outcome is None or found.outcome is Outcome.SUCCESS is found.clear_outcome:
            key = "other_moves" if found.differs is not None else "same_moves"
            return self._say("weather", key, yes=word, without=weather)
        config = asked.timeline.state.config
        return self._say(
            "weather",
            "ended",
            found.clear_outcome,
            yes=word,
            without=weather,
            seconds=in_seconds(self._sayings, found.clear_ticks, config),
        )

    def _metres(self, cells: int, found: Sensing) -> str:
        return self._sayings.number(cells * found.state.config.cell_m)

    def _named(self, things: Sequence[Thing], found: Sensing, *, as_seen: bool, most: int = MOST_TOLD) -> str:
        """The nearest of some things, and how many more there are."""
        naming = Naming(self._sayings, found.state, as_seen=as_seen)
        near = sorted(things, key=lambda thing: found.cells_to(thing.cell))
        told = [naming.thing(thing.id) for thing in near[:most]]
        if len(things) > most:
            told.append(self._say("more", count=len(things) - most))
        return self._sayings.joined(told)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("sight", *keys, **parts)


def _form(things: Sequence[Thing]) -> str:
    return "none" if not things else _count(len(things))


def _count(count: int) -> str:
    return "one" if count == 1 else "many"
