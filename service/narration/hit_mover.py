"""Answers about what was hit: where it came from, how fast it was, whether it could have kept clear."""

from __future__ import annotations

from service.contract.encode.others import hit_movers_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.crash import Crashes
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.hit_mover import HitMover, hit_movers
from sim.types import Kind, Move


class HitMoversTold:
    """Answers to "from which side did it come?", "how fast was it?", "could the other have avoided us?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._crashes = Crashes(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where there was no crash, that is the answer."""
        ask, state = asked.ask, asked.timeline.state
        try:
            found = hit_movers(asked.timeline, ask.tick)
        except QuestionError as error:
            return plain(self._sayings, ask, state, self._crashes.not_so(error))
        naming = Naming(self._sayings, found.crash.explanation.moment, as_seen=False)
        told = []
        for each in found.found:
            who = naming.thing(each.id)
            tell = self._could if ask.what == "other_could" else self._came
            told.append(Part(0, capital(tell(each, who))))
        if ask.what == "other_could" and any(each.moves for each in found.found):
            told.append(Part(1, self._say("rules")))
        return plain(self._sayings, ask, state, within(told)) | {"what": ask.what} | hit_movers_json(found)

    def _came(self, each: HitMover, who: str) -> str:
        if each.kind is Kind.AV:
            return self._say("another", who=who)
        if not each.moves:
            return self._say("never_moves", who=who)
        side = self._say("from", "left" if each.across < 0 else "right" if each.across else "ahead")
        if each.move is Move.STAY:
            return self._say("stood", who=who, side=side)
        way = self._sayings.say("past", "sides", each.move)
        return self._say("came", who=who, side=side, way=way, speed=self._sayings.number(each.speed_kmh))

    def _could(self, each: HitMover, who: str) -> str:
        if each.kind is Kind.AV:
            return self._say("another", who=who)
        if not each.moves:
            return self._say("never_moves", who=who)
        if each.clear_if_stayed is None:
            return self._say("could", "stood", who=who)
        return self._say("could", "clear" if each.clear_if_stayed else "met", who=who)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("hit_mover", *keys, **parts)
