"""Answers to questions: each kind of question has one that knows it."""

from __future__ import annotations

from service.narrate.answering import Answerer, Json
from service.narrate.sayings import Sayings
from service.narrate.status import Help, Status
from service.narrate.whys import Whys
from service.sessions.facts import Asked


class Answers:
    """Answers in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        whys = Whys(sayings)
        self._by_question: dict[str, Answerer] = {
            "why": whys,
            "why_not": whys,
            "status": Status(sayings),
            "help": Help(sayings),
        }

    def answer(self, asked: Asked) -> Json:
        """The `Answer` of the interface."""
        return self._by_question[asked.ask.about].answer(asked)
