"""Answers to questions: each kind of question has one that knows it."""

from __future__ import annotations

from service.narration.advice import Advices
from service.narration.ahead import Outlooks
from service.narration.answerer import Answerer, Json
from service.narration.blame import Blames
from service.narration.confidence import Confidences
from service.narration.glossary import Glossary
from service.narration.goals import Styles
from service.narration.history import History
from service.narration.maintenance import Maintenance
from service.narration.metrics import Figures
from service.narration.next import Next
from service.narration.planners import Planners
from service.narration.sayings import Sayings
from service.narration.scene import Scenes
from service.narration.settings import Settings
from service.narration.status import Help, Status
from service.narration.talk import OpenQuestion, RecentChanges
from service.narration.what_if import WhatIfs
from service.narration.why import Whys
from service.sessions.facts import Advised, Answerable


class Answers:
    """Answers in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._advices = Advices(sayings)
        whys, settings = Whys(sayings), Settings(sayings)
        self._by_question: dict[str, Answerer] = {
            "why": whys,
            "why_not": whys,
            "status": Status(sayings),
            "help": Help(sayings),
            "changes": RecentChanges(sayings),
            "pending": OpenQuestion(sayings),
            "scene": Scenes(sayings),
            "confidence": Confidences(sayings),
            "maintenance": Maintenance(sayings),
            "what_if": WhatIfs(sayings),
            "next": Next(sayings),
            "metrics": Figures(sayings),
            "setting": settings,
            "options": settings,
            "term": Glossary(sayings),
            "history": History(sayings),
            "styles": Styles(sayings),
            "outlook": Outlooks(sayings),
            "blame": Blames(sayings),
            "planners": Planners(sayings),
        }

    def answer(self, asked: Answerable) -> Json:
        """The `Answer` of the interface."""
        if isinstance(asked, Advised):
            return self._advices.answer(asked)
        return self._by_question[asked.ask.about].answer(asked)
