"""Answers about near misses, and about how risky a single move was."""

from __future__ import annotations

from typing import Final

from service.contract.encode.close_calls import move_risk_json, near_misses_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.closest_call import NEAR_MISS_M, REACH, ClosestCall, near_misses
from sim.explain.move_risk import move_risk
from sim.explain.occurrences import Event, Query, stretch_of
from sim.explain.question_error import QuestionError
from sim.types import Kind

MOST_TOLD: Final = 3
"""Near misses told one by one; the facts have all."""
TOLD_TTC_S: Final = 3.0
"""A time to collision above this, in seconds, is not told."""
WHETHER: Final = "whether"
"""What a question supposes that asks whether there was one."""


class CloseCalls:
    """Answers to "how many near misses were there?", "how risky was my last move?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            text, facts = self._misses(asked) if ask.what == "near_misses" else self._risk(asked)
        except QuestionError as error:
            if error.code in ("no_such_tick", "too_long"):
                told = self._sayings.say("history", error.code, **error.facts)
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _misses(self, asked: Asked) -> tuple[str, Json]:
        """How many, what counts as one, and the first few."""
        ask, timeline = asked.ask, asked.timeline
        kind = None if ask.kind is None else Kind(ask.kind)
        if kind is not None and not kind.moves:
            text = self._sayings.say("history", "not_moving", things=self._sayings.things(kind, 2))
            return text, near_misses_json((), None)
        now = timeline.tick
        if ask.ticks is not None and ask.ticks > now:
            return self._sayings.say("history", "not_so_far_back", now=now), near_misses_json((), None)
        first = ask.tick if ask.ticks is None else now - ask.ticks
        start, stop = stretch_of(timeline, Query(event=Event.DRIVE, first=first, last=ask.until))
        found = near_misses(timeline.between(start, min(stop, now) + 1), kind)
        key = "none" if not found else "one" if len(found) == 1 else "many"
        told = self._say("counted", key, count=len(found))
        if kind is not None:
            told = self._say("counted_kind", key, count=len(found), things=self._sayings.things(kind, 2))
        if asked.supposes == WHETHER and found:
            word = self._sayings.say("ahead", "answer", "agree")
            told = self._say("whether", word=word, told=told)
        measure = self._say("measure", metres=self._sayings.number(NEAR_MISS_M))
        parts = [Part(0, told), Part(0, self._list(found)), Part(1, measure)]
        parts.append(Part(2, self._say("timeline")))
        return within(parts), near_misses_json(found, (start, min(stop, now)))

    def _list(self, found: tuple[ClosestCall, ...]) -> str:
        """The first few in their order, and how many more."""
        if not found:
            return ""
        told = [
            self._say("one", tick=call.tick, who=self._who(call), metres=self._metres(call.gap_m))
            for call in found[:MOST_TOLD]
        ]
        if len(found) > MOST_TOLD:
            told.append(self._say("more", count=len(found) - MOST_TOLD))
        return self._say("list", calls=self._sayings.listed(told))

    def _risk(self, asked: Asked) -> tuple[str, Json]:
        """Whether it was a near miss or a crash, what came near, and how many moves were free."""
        found = move_risk(asked.timeline, asked.ask.tick)
        call = found.call
        move = self._sayings.move(found.made, "name")
        named = {"tick": found.tick, "move": move}
        if found.crashed:
            told = self._say("risk", "crash", **named)
        elif call is None:
            reach = self._sayings.number(REACH * found.before.config.cell_m)
            told = self._say("risk", "nothing", metres=reach, **named)
        else:
            soon = ""
            if call.ttc_s is not None and call.ttc_s <= TOLD_TTC_S:
                soon = self._say("soon", seconds=self._sayings.number(round(call.ttc_s, 1)))
            key = "near" if call.near_miss else "clear"
            metres = self._metres(call.gap_m)
            told = self._say("risk", key, who=self._who(call), metres=metres, soon=soon, **named)
        free = self._say("free", free=len(found.free), tried=len(found.tried))
        measure = self._say("risk_measure", metres=self._sayings.number(NEAR_MISS_M))
        parts = [Part(0, capital(told)), Part(1, free)]
        return within(parts if found.crashed else [*parts, Part(2, measure)]), move_risk_json(found)

    def _who(self, call: ClosestCall) -> str:
        return Naming(self._sayings, call.before, as_seen=False).thing(call.id)

    def _metres(self, gap_m: float) -> str:
        return self._sayings.number(round(gap_m, 1 if gap_m >= 1 else 2))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("close_calls", *keys, **parts)
