"""Answers about moments and patterns: the riskiest, those like one, a move made again and again."""

from __future__ import annotations

from service.contract.encode.past import pattern_json, risk_json, similar_json
from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.pattern import Pattern, pattern
from sim.explain.riskiest import MOST_TICKS, riskiest
from sim.explain.similar import Likeness, Similar, similar
from sim.state import SimState

SIMILAR_MOMENTS = 3
"""How many moments are looked for where no number is said."""
MOST_MOMENTS = 5
"""How many are told; the facts have all."""
THINGS_TOLD = 2
"""Things of a moment that are told."""


def when(sayings: Sayings, state: SimState, tick: int, now: int) -> str:
    """How long ago a tick was decided, as seconds; the last one is just now."""
    if now - tick <= 1:
        return sayings.say("past", "when", "now")
    return sayings.say(
        "past", "when", "ago", seconds=in_seconds(sayings, now - tick, state.config), tick=tick
    )


class Moments:
    """Answers to "what was the riskiest moment?" and "three moments like this one"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        return self._riskiest(asked) if asked.ask.what == "riskiest" else self._similar(asked)

    def _riskiest(self, asked: Asked) -> Json:
        ask, timeline = asked.ask, asked.timeline
        world = timeline.state.world
        last = timeline.tick if ask.until is None else ask.until
        first = max(world.episode_start if ask.tick is None else ask.tick, last - MOST_TICKS)
        if max(first, last) > timeline.tick:
            none: dict[str, object] = {"tick": max(first, last), "now": timeline.tick}
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, "no_such_tick", none))
        found = riskiest(timeline.between(first, last + 1))
        if found is None:
            return plain(self._sayings, ask, timeline.state, self._say("no_risk"))
        facts: dict[str, object] = {
            "when": when(self._sayings, found.before, found.tick, timeline.tick),
            "free": len(found.free),
            "tried": len(found.tried),
            "move": self._sayings.move(found.made, "name"),
        }
        call = ""
        if found.call is not None and not found.crashed:
            who = Naming(self._sayings, found.before, as_seen=False).thing(found.call.id)
            metres = self._sayings.number(round(found.call.gap_m, 2))
            call = capital(self._say("riskiest_call", who=who, metres=metres))
        told = [
            Part(0, self._say("riskiest_crash" if found.crashed else "riskiest", **facts)),
            Part(1, call),
            Part(2, self._say("measure")),
        ]
        return plain(self._sayings, ask, timeline.state, within(told)) | risk_json(found)

    def _similar(self, asked: Asked) -> Json:
        ask, timeline = asked.ask, asked.timeline
        try:
            found = similar(timeline, ask.count or SIMILAR_MOMENTS, ask.tick)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, timeline.state, self._likes(found)) | similar_json(found)

    def _likes(self, found: Similar) -> str:
        facts = {"tick": found.before.world.tick, "did": self._sayings.move(found.move, "did")}
        if not found.found:
            return self._say("none_similar", searched=found.searched, **facts)
        likes = [self._like(each, found) for each in found.found[:MOST_MOMENTS]]
        told = self._say("similar", moments=self._sayings.listed(likes), **facts)
        while len(likes) > 1 and len(told.split()) > MOST_WORDS:
            likes.pop()
            told = self._say("similar", moments=self._sayings.listed(likes), **facts)
        return told

    def _like(self, like: Likeness, found: Similar) -> str:
        if not like.shared:
            return self._say("moment_bare", tick=like.tick)
        naming = Naming(self._sayings, found.before, as_seen=False)
        column, row = found.before.world.road.cell(found.before.world.av)
        things = [
            self._say(
                "thing",
                a=self._sayings.say("words", "a", kind),
                place=naming.place((column + across, row - ahead)),
            )
            for (across, ahead), kind in like.shared[:THINGS_TOLD]
        ]
        percent = self._sayings.number(round(100 * like.alike))
        return self._say("moment", tick=like.tick, percent=percent, things=self._sayings.joined(things))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("past", *keys, **parts)


class Patterns:
    """Answers to "why do you keep going left?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            found = pattern(timeline, ask.move, ask.tick, ask.until)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, timeline.state, self.text(found)) | pattern_json(found)

    def text(self, found: Pattern) -> str:
        """How often, and because of what."""
        parts = [
            Part(
                0,
                self._say(
                    "pattern",
                    seconds=self._sayings.number(round(found.seconds, 1)),
                    did=self._sayings.move(found.move, "did"),
                    times=self._times(found.made),
                    decided=found.decided,
                ),
            )
        ]
        kinds = found.kinds()
        if kinds:
            clauses = self._sayings.joined(
                [
                    self._say("way_of", times=self._times(count), a=self._sayings.say("words", "a", kind))
                    for kind, count in kinds
                ]
            )
            examined = len(found.instances)
            key = "behind" if examined == found.made else "of_last"
            text = self._say(key, clauses=clauses, count=examined)
            parts.append(Part(0, capital(text)))
        alone = sum(not each.ids and not each.by_hand for each in found.instances)
        if alone:
            text = self._say("nothing_alone", times=self._times(alone))
            parts.append(Part(1, capital(text)))
        return within(parts)

    def _times(self, count: int) -> str:
        return self._say("times", {1: "one", 2: "two"}.get(count, "many"), count=count)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("past", *keys, **parts)
