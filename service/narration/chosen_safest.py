"""Answers to "was that move the safest one?": each move that could be made is run, and what follows it."""

from __future__ import annotations

from collections.abc import Sequence

from service.contract.encode.ahead import safe_move_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.futures_told import share_told
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.assurance import Level
from sim.explain.chosen_safest import ChosenSafest, chosen_safest
from sim.explain.question_error import QuestionError
from sim.explain.safe_move import SafeMove
from sim.types import Move


class ChosenMoves:
    """Answers about the safety of a move that was made, beside the others."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            found = chosen_safest(asked.timeline, ask.tick)
        except QuestionError as error:
            if error.code == "no_such_tick":
                told = self._sayings.say("history", error.code, **error.facts)
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        facts = {
            "at_tick": found.tick,
            "made": found.made.move,
            "was_safest": found.was_safest,
            "safest": list(found.safest),
            "moves": [safe_move_json(each) for each in found.moves],
        }
        return plain(self._sayings, ask, state, within(self._told(found))) | {"what": ask.what} | facts

    def _told(self, found: ChosenSafest) -> list[Part]:
        """Yes or no, then what makes the difference, which moves were alike, and what it is judged by."""
        named = {"move": self._sayings.move(found.made.move, "name"), "tick": found.tick}
        others = [move for move in found.safest if move is not found.made.move]
        measure = Part(2, self._say("measure"))
        if not found.was_safest:
            first = self._say("was_not", **named, others=self._names(found.safest))
            return [Part(0, first), Part(0, self._why(found.made, found.moves[0])), measure]
        key = "alone" if not others else "all" if len(found.safest) == len(found.moves) else "among"
        first = self._say("was", key, **named, others=self._names(others))
        unsafe = self._say("none_safe") if not found.made.safe else ""
        hits = [each.move for each in found.moves if each.then is None and not each.off_road]
        at_once = self._say("at_once", others=self._names(hits)) if hits and found.made.then else ""
        return [Part(0, first), Part(0, unsafe), Part(1, at_once), measure]

    def _why(self, made: SafeMove, best: SafeMove) -> str:
        """What made the other safer: the first of what they are judged by in which they differ."""
        named = {"best": self._sayings.move(best.move, "name")}
        if made.then is None or best.then is None:
            return self._say("why", "hit")
        if made.then.crashes != best.then.crashes:
            shares = [
                share_told(self._sayings, each.then.crashes, each.then.chances)
                for each in (made, best)
                if each.then
            ]
            return self._say("why", "crashes", share=shares[0], best_share=shares[1], **named)
        levels = [Level.NONE if each.assurance is None else each.assurance.level for each in (made, best)]
        if levels[0] is not levels[1]:
            made_level, best_level = (self._say("levels", str(each.value)) for each in levels)
            return self._say("why", "level", level=made_level, best_level=best_level, **named)
        return self._say("why", "closed", **named)

    def _names(self, moves: Sequence[Move]) -> str:
        return self._sayings.joined([self._sayings.move(each, "name") for each in moves])

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("chosen_safest", *keys, **parts)
