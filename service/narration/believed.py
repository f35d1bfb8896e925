"""Answers about the nearest thing that is seen: how sure it is, which device saw it, whether it is there."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.explain.believed import MOST_BACK, Believed, believed
from sim.explain.scene import Detection
from sim.perceive.parameters import SUITES
from sim.types import Kind

AHEAD, DEVICE, REALLY, SHADOW = "ahead", "device", "really", "shadow"
"""What a question asks for first (`Asked.supposes`): only what is ahead, the device, the truth, a shadow."""
MOST_PERCENT: Final = 99
"""Percent of what is not certain, at most."""


class NearestBelieved:
    """Answers to "how sure are you of the nearest pothole?", "which sensor saw it?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        kind = None if ask.kind is None else Kind(ask.kind)
        words = (asked.supposes or "").split()
        found = believed(timeline, kind, ahead=AHEAD in words)
        text = self._told(found, kind, words, asked)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | _json(found)

    def _told(self, found: Believed, kind: Kind | None, words: list[str], asked: Asked) -> str:
        thing = found.thing
        shadow = [Part(1, self._say("no_shadows"))] if SHADOW in words else []
        if thing is None:
            things = self._say("things") if kind is None else self._sayings.things(kind, 2)
            told = self._say("none_ahead" if AHEAD in words else "none", things=things)
            return within([Part(0, told), *self._missed(found, asked, "missed"), *shadow])
        if found.faithful:
            parts = [Part(0, self._say("perfect", nearest=self._nearest(thing, kind, asked)))]
            return within([*parts, *shadow])
        sure, seen, truth = (
            self._sure(thing, kind, asked),
            self._reported(found, asked),
            self._truth(found, asked),
        )
        order = [sure, seen, truth]
        if DEVICE in words:
            order = [seen, sure, truth]
        elif REALLY in words:
            answer = self._sayings.say("ahead", "answer", "agree" if found.is_there else "disagree")
            order = [self._say("really", answer=answer, truth=truth), sure, seen]
        nearer = self._missed(found, asked, "nearer")
        return within([*(Part(0, each) for each in order), *shadow, *nearer])

    def _nearest(self, thing: Detection, kind: Kind | None, asked: Asked) -> str:
        """ "the nearest pothole is 15 m ahead", or with the kind as news."""
        place = Naming(self._sayings, asked.timeline.state).place(thing.cell)
        if kind is None:
            return self._say("nearest_of_all", a=self._sayings.say("words", "a", thing.kind), place=place)
        return self._say("nearest", thing=self._sayings.things(thing.kind, 1), place=place)

    def _sure(self, thing: Detection, kind: Kind | None, asked: Asked) -> str:
        percent = min(MOST_PERCENT, max(1, round(100 * thing.likelihood)))
        return self._say("sure", nearest=self._nearest(thing, kind, asked), percent=percent)

    def _reported(self, found: Believed, asked: Asked) -> str:
        """Which devices reported it last, and when."""
        timeline = asked.timeline
        state = timeline.state
        if state.config.sensor not in SUITES:
            return self._say("unknown", sensor=state.config.sensor)
        if found.reported is None:
            return self._say("unreported", ticks=MOST_BACK)
        devices = self._sayings.joined([value_of(self._sayings, "sensor", each) for each in found.devices])
        ago = state.world.tick - found.reported
        if ago == 0:
            return self._say("reported", devices=devices)
        return self._say(
            "reported_before", devices=devices, seconds=in_seconds(self._sayings, ago, state.config)
        )

    def _truth(self, found: Believed, asked: Asked) -> str:
        if found.is_there:
            return self._say("truth", "there")
        if found.truth is None:
            return self._say("truth", "phantom")
        place = Naming(self._sayings, asked.timeline.state, as_seen=False).place(found.truth.cell)
        return self._say("truth", "elsewhere", place=place)

    def _missed(self, found: Believed, asked: Asked, key: str) -> list[Part]:
        """The nearest thing that is not seen, where it is nearer than what is."""
        if found.missed is None:
            return []
        place = Naming(self._sayings, asked.timeline.state, as_seen=False).place(found.missed.cell)
        a = self._sayings.say("words", "a", found.missed.kind)
        return [Part(2 if key == "nearer" else 0, self._say(key, a=a, place=place))]

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("believed", *keys, **parts)


def _json(found: Believed) -> Json:
    thing, truth, missed = found.thing, found.truth, found.missed
    return {
        "seen": []
        if thing is None
        else [{"id": thing.id, "kind": thing.kind, "cell": list(thing.cell), "likelihood": thing.likelihood}],
        "really": None if truth is None else {"id": truth.id, "cell": list(truth.cell)},
        "is_there": found.is_there,
        "reported": found.reported,
        "devices": list(found.devices),
        "nearer_missed": None if missed is None else {"id": missed.id, "cell": list(missed.cell)},
    }
