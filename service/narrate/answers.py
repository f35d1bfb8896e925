"""Answers to questions: each kind of question has one that knows it."""

from __future__ import annotations

from service.narrate.advice import Advices
from service.narrate.answering import Answerer, Json
from service.narrate.confidence import Confidences
from service.narrate.maintenance import Maintenance
from service.narrate.metrics import Figures
from service.narrate.next import Next
from service.narrate.sayings import Sayings
from service.narrate.scene import Scenes
from service.narrate.status import Help, Status
from service.narrate.whatif import WhatIfs
from service.narrate.whys import Whys
from service.sessions.facts import Advised, Answerable


class Answers:
    """Answers in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._advices = Advices(sayings)
        whys = Whys(sayings)
        self._by_question: dict[str, Answerer] = {
            "why": whys,
            "why_not": whys,
            "status": Status(sayings),
            "help": Help(sayings),
            "scene": Scenes(sayings),
            "confidence": Confidences(sayings),
            "maintenance": Maintenance(sayings),
            "what_if": WhatIfs(sayings),
            "next": Next(sayings),
            "metrics": Figures(sayings),
        }

    def answer(self, asked: Answerable) -> Json:
        """The `Answer` of the interface."""
        if isinstance(asked, Advised):
            return self._advices.answer(asked)
        return self._by_question[asked.ask.about].answer(asked)
