"""Answers about a person's part in this drive: since when, what was held back, what the planner would do."""

from __future__ import annotations

from typing import Final

from service.contract.encode.by_hand import by_hand_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.by_hand import ByHand, by_hand
from sim.explain.question_error import QuestionError

MOST_TOLD: Final = 4
"""Moves held back that are told one by one; the facts have all."""
FIRST: Final = {"held_back": ("held", "since", "would"), "would": ("would", "since", "held")}
"""What is told first, by what the question supposes."""


class HandsOn:
    """Answers to "since when am I driving?", "how many of my moves were held back?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            found = by_hand(asked.timeline)
        except QuestionError as error:
            if error.code == "not_by_hand":
                told = self._say("never")
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        parts = {
            "since": self._since(found, state.config),
            "held": self._held(found),
            "would": self._would(found),
        }
        order = FIRST.get(str(asked.supposes), ("since", "would", "held"))
        text = within(Part(rank, parts[key]) for rank, key in enumerate(order))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | by_hand_json(found)

    def _since(self, found: ByHand, config: Config) -> str:
        if found.until is None:
            ago = in_seconds(self._sayings, found.now - found.since, config)
            return self._say("since", "now", tick=found.since, seconds=ago)
        key = "one" if found.until == found.since else "then"
        return self._say("since", key, tick=found.since, until=found.until)

    def _held(self, found: ByHand) -> str:
        """How many of the person's moves were not made, and the first few."""
        moves = self._say("moves", "one" if found.moves == 1 else "many", count=found.moves)
        if not found.held_back:
            return self._say("held", "none", moves=moves)
        told = [
            self._say("one", tick=each.tick, move=self._sayings.move(each.asked, "name"))
            for each in found.held_back[:MOST_TOLD]
        ]
        if len(found.held_back) > MOST_TOLD:
            told.append(self._say("more", count=len(found.held_back) - MOST_TOLD))
        count, listed = len(found.held_back), self._sayings.listed(told)
        return self._say("held", "some", count=count, moves=moves, listed=listed)

    def _would(self, found: ByHand) -> str:
        if found.would is None:
            return ""
        return self._say("would", tick=found.since, move=self._sayings.move(found.would, "name"))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("by_hand", *keys, **parts)
