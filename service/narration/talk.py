"""Answers about the conversation itself: what changed, and which question is pending."""

from __future__ import annotations

from typing import Final

from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from service.sessions.log import LogEvent

MAX_TOLD: Final = 10
"""Largest number of changes that are told one by one."""


class RecentChanges:
    """Answers to "what changed?": what the latest utterances did, in the words in which it was said then."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`; `changes` has the lines with their ticks, the latest last."""
        lines = self._lines(asked)
        told = plain(self._sayings, asked.ask, asked.timeline.state, self._text(asked, lines))
        return told | {"changes": [{"tick": line.tick, "text": line.text} for line in lines]}

    def _lines(self, asked: Asked) -> tuple[LogEvent, ...]:
        """The lines asked for: the latest, so many, or those since a tick."""
        lines, since = asked.talk.changes(), asked.ask.tick
        if since is not None:
            lines = tuple(line for line in lines if line.tick >= since)
        count = asked.ask.count
        if count is None:
            count = 1 if since is None else len(lines)
        return lines[max(0, len(lines) - count) :]

    def _text(self, asked: Asked, lines: tuple[LogEvent, ...]) -> str:
        since = asked.ask.tick
        if not lines:
            return self._say("no_changes" if since is None else "no_changes_since", tick=since)
        if len(lines) == 1:
            return self._say("last_change", text=lines[0].text, tick=lines[0].tick)
        shown = lines[-MAX_TOLD:]
        parts = [self._say("change", text=line.text, tick=line.tick) for line in shown]
        if len(shown) < len(lines):
            parts.insert(0, self._say("changes_before", count=len(lines) - len(shown)))
        return self._say("changes", count=len(lines), listed=" ".join(parts))

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("talk", key, **parts)


class OpenQuestion:
    """Answers to "what were you asking?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`; `pending` is the question with its choices, or null."""
        pending = asked.talk.pending
        if pending is None:
            text = self._sayings.say("talk", "nothing_pending")
        else:
            choices = " ".join(
                self._sayings.say("talk", "choice", number=number, text=choice.text)
                for number, choice in enumerate(pending.choices, 1)
            )
            text = self._sayings.say(
                "talk", "pending", said=pending.text, question=pending.question, choices=choices
            )
        told = plain(self._sayings, asked.ask, asked.timeline.state, text)
        return told | {"pending": None if pending is None else pending.to_json()}
