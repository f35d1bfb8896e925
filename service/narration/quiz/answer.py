"""Answers to "quiz me": the situations to predict, which the page shows one by one."""

from __future__ import annotations

from service.narration.answerer import Json, plain
from service.narration.quiz.document import quiz_json
from service.narration.quiz.situations import situations
from service.narration.sayings import Sayings
from service.sessions.facts import Asked

COUNT = 4
"""Situations of each phase."""


class Quizzes:
    """Quizzes about the planner of a session."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. The same moment of a run has the same quiz."""
        run = asked.timeline.state
        seed = run.config.seed + run.world.tick
        planner = run.config.planner
        found = situations(seed, planner, COUNT, self._sayings)
        text = self._sayings.say("quiz", "answer", count=COUNT)
        told = plain(self._sayings, asked.ask, run, text)
        return told | {"quiz": quiz_json(planner, seed, found, self._sayings)}
