"""The pending question of a session: what the service asked last and nobody answered yet.

One question is pending at a time. The next utterance may answer it; a request of its own drops it. It is
stored nowhere: after a restart nothing is pending.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from service import actions as contract
from service.actions import Action, Ask
from service.sessions.log import LogEvent


@dataclass(frozen=True, slots=True)
class PendingChoice:
    """One answer that was offered: a sentence, and the actions it means."""

    text: str
    actions: tuple[Action, ...]


@dataclass(frozen=True, slots=True)
class PendingQuestion:
    """A question, the utterance that it was asked about, and the answers that were offered."""

    text: str
    question: str
    choices: tuple[PendingChoice, ...]
    source: str
    """who understood the utterance so far: the grammar, or a language model"""
    language: str

    @property
    def kind(self) -> str | None:
        """The one kind of thing that all choices are about."""
        kinds = [{getattr(action, "kind", None) for action in each.actions} for each in self.choices]
        named = kinds[0] if kinds and all(each == kinds[0] for each in kinds) else set()
        return named.pop() if len(named) == 1 else None

    def to_json(self) -> dict[str, Any]:
        """The question as JSON values, the form in which clients see it."""
        choices = [{"text": each.text, "actions": contract.dump(each.actions)} for each in self.choices]
        return {"text": self.text, "question": self.question, "choices": choices}


@dataclass(frozen=True, slots=True)
class Talk:
    """What questions about the conversation itself are answered from."""

    pending: PendingQuestion | None = None
    changes: Callable[[], tuple[LogEvent, ...]] = tuple
    """the log lines of what was done, the latest last"""
    explained: Ask | None = None
    """the question that was answered last, with the tick that it turned out to be about"""

    def for_transfer(self) -> Talk:
        """The same with the log lines looked up, for a process that does not have the log."""
        return replace(self, changes=_KnownLines(self.changes()))


@dataclass(frozen=True, slots=True)
class _KnownLines:
    lines: tuple[LogEvent, ...]

    def __call__(self) -> tuple[LogEvent, ...]:
        return self.lines


NO_TALK = Talk()
"""That of a session nobody has talked to."""
