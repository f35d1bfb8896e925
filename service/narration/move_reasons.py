"""Answers to "explain the last five moves one by one": each move with its reason, shortly."""

from __future__ import annotations

import re
from typing import Final

from service.actions import Ask
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.narration.why import Whys
from service.sessions.facts import Asked

MOST_MOVES: Final = 10
"""Moves that are explained at once: an answer of so many sentences is asked for."""
DEFAULT_MOVES: Final = 5
SENTENCE_END: Final = re.compile(r"(?<=[^\W\d][.!?])\s+|(?<=[)”“][.!?])\s+")
"""Between two sentences of an answer."""


class MoveReasons:
    """The reasons of the last moves, the earliest first."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._whys = Whys(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. It may be longer than other answers."""
        ask, timeline = asked.ask, asked.timeline
        world = timeline.state.world
        stop = timeline.tick if world.ended is None else world.ended
        wanted = ask.ticks or DEFAULT_MOVES
        count = min(wanted, MOST_MOVES)
        ticks = range(max(world.episode_start, stop - count), stop)
        if not ticks:
            return plain(self._sayings, ask, timeline.state, self._say("nothing")) | {"what": ask.what}
        moves = [
            {
                "tick": tick,
                "move": None if decision is None else decision.move,
                "text": self._reason(asked, tick),
            }
            for tick in ticks
            for decision in (timeline.decision(tick),)
        ]
        told = [str(each["text"]) for each in moves]
        if wanted > MOST_MOVES and world.episode_start < ticks[0]:
            told.insert(0, self._say("most", count=MOST_MOVES))
        facts = {"what": ask.what, "moves": moves}
        return plain(self._sayings, ask, timeline.state, " ".join(told)) | facts

    def _reason(self, asked: Asked, tick: int) -> str:
        """The first sentence of why that move was made."""
        why = Asked(Ask(about="why", tick=tick), asked.timeline, length="shorter")
        return SENTENCE_END.split(str(self._whys.answer(why)["text"]), maxsplit=1)[0]

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("move_reasons", *keys, **parts)
