"""Answers about all others: where they go, and who comes into the lane ahead."""

from __future__ import annotations

from service.contract.encode.others import crossing_json, others_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.others_ahead import (
    CROSSING_ROWS,
    Crossing,
    OthersAhead,
    crossing,
    others_ahead,
    others_next,
)
from sim.rules.mover_boards import PERIODS
from sim.types import PLACEABLE, Kind, Move

MOST_TOLD = 3
"""Road users that are named; more are counted."""


class AllOthers:
    """Answers to "what are the others doing?", "which change lanes next?", "is anyone about to cross?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        kind = None if ask.kind is None else Kind(ask.kind)
        try:
            if ask.what == "others":
                others = others_ahead(timeline, kind)
                text, facts = self._others(others, kind), others_json(others)
            elif ask.what == "others_next":
                others = others_next(timeline, kind)
                text, facts = self._next(others, kind), others_json(others)
            else:
                found = crossing(timeline, kind)
                text, facts = self._crossing(asked, found, kind), crossing_json(found)
        except QuestionError as error:
            told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, told)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _others(self, found: OthersAhead, kind: Kind | None) -> str:
        """How many of each kind go to each side next; of a kind that does not move, that."""
        if kind is not None and kind not in PERIODS:
            return self._say("never_move", things=self._sayings.things(kind, 2))
        kinds = [each for each in PLACEABLE if each in PERIODS and kind in (None, each)]
        told = []
        for each in kinds:
            ways = [way for thing, way in found.ways if thing.kind is each]
            counts = [(key, ways.count(move)) for key, move in _WAYS.items() if move in ways]
            if not ways:
                continue
            parts = self._sayings.joined([self._say("ways", key, count=count) for key, count in counts])
            things = self._sayings.things(each, len(ways))
            key = "one" if len(ways) == 1 else "many"
            told.append(Part(0, self._say("go", key, count=len(ways), things=things, parts=parts)))
        if not told:
            things = self._sayings.joined([self._sayings.things(each, 2) for each in kinds])
            return self._say("none", things=things)
        return within([*told, Part(1, self._say("measure"))])

    def _next(self, found: OthersAhead, kind: Kind | None) -> str:
        """How many of each kind go to each side in the next tick, and who of the nearest does."""
        if kind is not None and kind not in PERIODS:
            return self._say("never_move", things=self._sayings.things(kind, 2))
        kinds = [each for each in PLACEABLE if each in PERIODS and kind in (None, each)]
        told = []
        for each in kinds:
            ways = [way for thing, way in found.ways if thing.kind is each]
            if not ways:
                continue
            counts = [(key, ways.count(move)) for key, move in _WAYS.items() if move in ways]
            parts = self._sayings.joined([self._say("next_ways", key, count=count) for key, count in counts])
            things = self._sayings.things(each, len(ways))
            told.append(self._say("next_of", count=len(ways), things=things, parts=parts))
        if not told:
            things = self._sayings.joined([self._sayings.things(each, 2) for each in kinds])
            return self._say("none", things=things)
        naming = Naming(self._sayings, found.state, as_seen=False)
        near = [
            self._say("next_one", "left" if way is Move.LEFT else "right", who=naming.thing(thing.id))
            for thing, way in found.ways
            if way is not Move.STAY
        ]
        answer = [Part(0, self._say("next", parts="; ".join(told)))]
        if near:
            listed = self._sayings.joined(near[:MOST_TOLD])
            answer.append(Part(1, self._say("next_near", parts=listed)))
        return within(answer)

    def _crossing(self, asked: Asked, found: Crossing, kind: Kind | None) -> str:
        """Yes or no first, then who, and when."""
        config = found.state.config
        metres = self._sayings.number(CROSSING_ROWS * config.cell_m)
        words = yes_and_no(self._sayings, asked)
        seconds = in_seconds(self._sayings, found.ticks, config)
        if kind is not None and kind not in PERIODS:
            return self._say("never_move", things=self._sayings.things(kind, 2))
        who = self._say("whom", "any" if kind is None else str(kind))
        if not found.coming:
            return self._say("clear", seconds=seconds, metres=metres, who=who, **words)
        naming = Naming(self._sayings, found.state, as_seen=False)
        told = []
        for id, ticks in found.coming[:MOST_TOLD]:
            key = "later" if ticks else "now"
            after = in_seconds(self._sayings, ticks, config)
            told.append(self._say("comes", key, who=naming.thing(id), seconds=after))
        more = len(found.coming) - len(told)
        if more:
            told.append(self._say("more", count=more))
        return self._say("coming", metres=metres, seconds=seconds, parts=self._sayings.joined(told), **words)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("others", *keys, **parts)


_WAYS = {"left": Move.LEFT, "right": Move.RIGHT, "stay": Move.STAY}
"""By key of the sayings, the next step that is counted."""
