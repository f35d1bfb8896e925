"""What is asked of human drivers: that is not known, and what is known instead is told."""

from __future__ import annotations

from dataclasses import replace

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.blame import Blames
from service.narration.move_reasons import SENTENCE_END
from service.narration.sayings import Sayings
from service.sessions.facts import Asked


class HumanDrivers:
    """Answers to "would a human driver have avoided it?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._blames = Blames(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. After a crash: whether any way of driving would have avoided it."""
        avoidable = self._blames.answer(replace(asked, ask=replace(asked.ask, what="avoidable")))
        facts = {key: value for key, value in avoidable.items() if key not in ("question", "text", "what")}
        unknown = self._say("unknown")
        if "what" in avoidable:
            sentences = [Part(0, unknown), Part(1, self._say("possible"))]
            told = SENTENCE_END.split(str(avoidable["text"]))
            sentences += [Part(at + 2 if at else 0, each) for at, each in enumerate(told)]
            text = within(sentences)
        else:  # there was no crash to speak of
            text = f"{unknown} {self._say('compare', example=self._say('example'))}"
        answer = plain(self._sayings, asked.ask, asked.timeline.state, text)
        return answer | facts | {"what": asked.ask.what}

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("planners_differ", "human", key, **parts)
