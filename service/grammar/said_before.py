"""The last request as a sentence, so that what leans on it is read as if it were one sentence with it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from service.actions import Action, Undo
from service.grammar.parse_types import Parse, Understood
from service.grammar.sentences import Unsayable
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import WorkBudget


class LanguageReader(Protocol):
    """What is needed of the language."""

    def read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        """A sentence read."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""


def said_before(language: LanguageReader, topic: Topic, work: WorkBudget) -> str | None:
    """A sentence that means the last actions; None where there is none.

    As the language says it, or else as it was said, where that means the same without a conversation.
    """
    try:
        return language.sentence(topic.actions)
    except Unsayable:
        pass
    if not topic.said:
        return None
    parsed = language.read(topic.said, ALONE, work, asking=False)
    return topic.said if isinstance(parsed, Understood) and parsed.actions == topic.actions else None


def can_be_corrected(topic: Topic) -> bool:
    """Whether what was said last can be said otherwise: it is taken back, or has nothing to be taken back."""
    return bool(topic.actions) and not topic.undone


def done_anew(topic: Topic, actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """Actions in the place of what was done last, which is taken back where it was steps of undo."""
    return (take_back(topic), *actions) if topic.steps else actions


def take_back(topic: Topic) -> Undo:
    """The undo of the last request."""
    return Undo(steps=None if topic.steps == 1 else topic.steps)


def take_back_change(topic: Topic) -> Undo:
    """The undo of the last change, whatever was asked since."""
    return Undo(steps=None if topic.changed_steps == 1 else topic.changed_steps)


def shape(actions: Sequence[Action]) -> list[object]:
    """What kinds of request some actions are."""
    return [
        (action.do, getattr(action, "about", None), getattr(action, "parameter", None)) for action in actions
    ]
