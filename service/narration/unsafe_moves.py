"""Answers about moves of a person that the rules of the planners forbid."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, plain
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.unsafe_moves import UnsafeMove, UnsafeMoves, unsafe_moves

MOST_TOLD: Final = 3
"""Moves that are told with what was in their way; more are counted."""


class UnsafeMovesTold:
    """Answers to "which of my moves so far would be unsafe by your own rules?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where nobody drove by hand, that is the answer."""
        ask, state = asked.ask, asked.timeline.state
        found = unsafe_moves(asked.timeline)
        if not found.by_hand:
            text = self._sayings.say("stretches", "differed", "not_by_hand")
        else:
            text = self._told(found)
        facts = [
            {
                "tick": each.tick,
                "move": each.option.move,
                "reason": each.option.reason,
                "held_back": each.held_back,
            }
            for each in found.found
        ]
        return plain(self._sayings, ask, state, text) | {"what": ask.what, "unsafe": facts}

    def _told(self, found: UnsafeMoves) -> str:
        text = ""
        moves = self._say("moves", "one" if found.by_hand == 1 else "many", count=found.by_hand)
        rule = Part(2, self._say("rule"))
        if not found.found:
            return within([Part(0, self._say("none", moves=moves)), rule])
        for most in range(MOST_TOLD, 0, -1):
            text = self._some(found, moves, most)
            if len(text.split()) <= MOST_WORDS:
                break
        return within([Part(0, text), rule])

    def _some(self, found: UnsafeMoves, moves: str, most: int) -> str:
        """The latest of them, up to so many, and how many there were before."""
        latest = found.found[-most:]
        told = [self._say("some", moves=moves, count=len(found.found)), *map(self._one, latest)]
        if more := len(found.found) - len(latest):
            told.append(self._say("more", count=more))
        return " ".join(told)

    def _one(self, each: UnsafeMove) -> str:
        """One move, with what was seen in its way."""
        naming = Naming(self._sayings, each.state)
        return self._say(
            "held_back" if each.held_back else "made",
            tick=each.tick,
            move=self._sayings.move(each.option.move, "name"),
            reason=self._sayings.met(each.option, "then", naming),
        )

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("unsafe_moves", *keys, **parts)
