"""Answers to "was it luck?": the same drive with what is left to chance drawn anew."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.luck import Luck, luck
from sim.explain.question_error import QuestionError
from sim.types import Outcome

MOSTLY = 0.9
"""From this share of runs that stand alike on, luck had little part."""


class Lucks:
    """Answers about luck."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            found = luck(asked.timeline)
        except QuestionError as error:
            told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        facts = {
            "what": ask.what,
            "left_to_chance": {
                "reactions": found.reactions,
                "sensing": found.sensing,
                "slips": found.slips,
            },
            "outcome": found.here,
            "outcomes": list(found.outcomes),
        }
        return plain(self._sayings, ask, state, self._text(found)) | facts

    def _text(self, found: Luck) -> str:
        """How large a part luck had, in how many runs, and what is left to chance."""
        if not found.by_chance:
            return self._say("none")
        runs = len(found.outcomes)
        share = found.alike / runs
        key = "never" if share == 1.0 else "little" if share >= MOSTLY else "part" if found.alike else "all"
        named = [
            self._say("chances", name) for name in ("reactions", "sensing", "slips") if getattr(found, name)
        ]
        order = (Outcome.SUCCESS, Outcome.CRASH, Outcome.STUCK, Outcome.RUNNING)
        ends = [
            self._say("ends", str(outcome), count=found.counts[outcome])
            for outcome in order
            if found.counts[outcome]
        ]
        told = self._say(
            "again",
            "to_end" if found.to_end else "to_tick",
            runs=runs,
            tick=found.last,
            ends=self._sayings.joined(ends),
        )
        parts = [Part(0, self._say("first", key)), Part(0, told)]
        if found.by_hand:
            parts.append(Part(2, self._say("by_hand")))
        parts.append(Part(1, self._say("drawn", chances=self._sayings.joined(named))))
        return within(parts)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("luck", *keys, **parts)
