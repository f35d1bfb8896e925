"""Answers about camera, lidar and radar: what each reports now, and which saw a thing first."""

from __future__ import annotations

from itertools import groupby
from typing import Any, Final

from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.by_device import ByDevice, by_device, first_by_device
from sim.perceive.registry import sensor_named
from sim.state import SimState
from sim.types import Kind
from sim.world import Thing

ONLY, DISAGREE = "only", "disagree"
"""What is asked for first (`Asked.supposes`): what one device alone reports; whether they disagree."""
MOST_NAMED: Final = 2
"""Things that are named of a device."""
FUSED: Final = "fusion"


class ByDeviceTold:
    """Answers to "which sensors see each thing?", "which sensor saw the car first?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            text, facts = self._now(asked) if ask.what == "by_device" else self._first(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _now(self, asked: Asked) -> tuple[str, Json]:
        """What each device reports in this tick; by how many; what one alone reports."""
        state, words = asked.timeline.state, (asked.supposes or "").split()
        found = by_device(state)
        facts: Json = {
            "things": [
                {"id": each.id, "kind": each.kind, "devices": list(found.seen_by(each.id))}
                for each in found.things
            ],
            "false_alarms": dict(found.alarms),
        }
        if not found.things:
            return self._say("nothing"), facts
        if asked.ask.value is not None:
            return self._alone(found, str(asked.ask.value), state), facts
        each = [
            self._say("one", sensor=self._sensor(name), count=len(ids)) for name, ids in found.seen.items()
        ]
        counts = self._say(
            "counts",
            things=len(found.things),
            listed=self._sayings.joined(each),
            three=found.by_count(3),
            two=found.by_count(2),
            one=found.by_count(1),
            none=found.by_count(0),
        )
        alone = self._alone_ones(found, state, MOST_NAMED)
        if len(alone.split()) > MOST_WORDS // 2:
            alone = self._alone_ones(found, state, 1)
        told = [Part(0, counts), Part(1, alone), Part(2, self._own(state))]
        if ONLY in words:
            told = [Part(0, alone), Part(1, counts), Part(2, self._own(state))]
        if DISAGREE in words:
            differ = found.by_count(1) + found.by_count(2)
            answer = self._sayings.say("ahead", "answer", "agree" if differ else "disagree")
            told.insert(0, Part(0, self._say("first_word", answer=answer)))
        return within(told), facts

    def _alone_ones(self, found: ByDevice, state: SimState, most: int) -> str:
        """What each sensor alone reports, so many of its things by name."""
        told = [
            self._say("only", sensor=self._sensor(name), who=self._named(found.only(name), state, most))
            for name in found.seen
            if found.only(name)
        ]
        return " ".join(told) or self._say("nobody_alone")

    def _named(self, things: tuple[Thing, ...], state: SimState, most: int = MOST_NAMED) -> str:
        naming = Naming(self._sayings, state, as_seen=False)
        names = [naming.thing(each.id) for each in things[:most]]
        if len(things) > most:
            names.append(self._say("more", count=len(things) - most))
        return self._sayings.joined(names)

    def _alone(self, found: ByDevice, name: str, state: SimState) -> str:
        """What one sensor would report: a device, or all three fused."""
        ids = frozenset[str]().union(*found.seen.values()) if name == FUSED else found.seen[name]
        seen = tuple(each for each in found.things if each.id in ids)
        sensor = self._sensor(name)
        if not seen:
            return self._say("alone_none", sensor=sensor, things=len(found.things))
        who = self._named(seen, state)
        return self._say("alone", sensor=sensor, count=len(seen), things=len(found.things), who=who)

    def _own(self, state: SimState) -> str:
        """How this bears on the session's sensor; empty where it has all three."""
        name = state.config.sensor
        if sensor_named(name).faithful:
            return self._say("perfect")
        return "" if name == FUSED else self._say("not_fused", sensor=self._sensor(name))

    def _first(self, asked: Asked) -> tuple[str, Json]:
        """In which tick each device first reported the nearest thing, and how far off it was then."""
        state = asked.timeline.state
        kind = None if asked.ask.kind is None else Kind(asked.ask.kind)
        found = first_by_device(asked.timeline, kind)
        facts: Json = {"thing": None, "first": {}}
        if found is None:
            noun = (
                self._sayings.say("sensing_now", "things") if kind is None else self._sayings.things(kind, 2)
            )
            return self._sayings.say("sensing_now", "would_see", "none", things=noun), facts
        facts = {
            "thing": found.thing.id,
            "first": {name: None if at is None else at[0] for name, at in found.first.items()},
        }
        who = Naming(self._sayings, state, as_seen=False).thing(found.thing.id)
        if not found.order:
            return self._say("first", "none", who=who), facts
        ticks = {name: at for name, at in found.first.items() if at is not None}
        listed = [
            self._say(
                "first",
                "at",
                devices=self._sayings.joined([self._sensor(name) for name in names]),
                tick=tick,
                metres=self._sayings.number(round(ticks[names[0]][1] * state.config.cell_m, 1)),
            )
            for tick, names in (
                (tick, list(each)) for tick, each in groupby(found.order, key=lambda name: ticks[name][0])
            )
        ]
        told = [Part(0, self._say("first", "told", who=who, listed=self._sayings.listed(listed)))]
        never = [self._sensor(name) for name, at in found.first.items() if at is None]
        if never:
            told.append(Part(0, self._say("first", "never", devices=self._sayings.joined(never))))
        told.append(Part(2, self._own(state)))
        return within(told), facts

    def _sensor(self, name: str) -> str:
        return value_of(self._sayings, "sensor", name)

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("by_device", *keys, **parts)
