"""Answers to "what is a safety buffer?": what a word means in this simulator, and where the idea is from."""

from __future__ import annotations

from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked


class Glossary:
    """Explanations of terms."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        term = str(asked.ask.term)
        text = self._sayings.say("glossary", "terms", term, "text")
        source = self._sayings.value("glossary", "terms", term, "source")
        key = "told" if source is None else "told_with_source"
        told = self._sayings.say("glossary", key, text=text, source=source)
        return plain(self._sayings, asked.ask, asked.timeline.state, told) | {"term": term, "source": source}
