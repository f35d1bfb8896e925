"""The topic of a conversation: all that a sentence may refer to without naming it.

The engine is a pure function of a sentence and a topic; whoever holds the conversation makes the
topic. An empty one is that of a sentence that stands alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from service.actions import Action
from sim.actions import Where

Words = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Phrases:
    """Taught phrases, ready to be found: by their first word, the words and the actions as JSON values."""

    by_first: Mapping[str, Sequence[tuple[Words, list[dict[str, Any]]]]] = field(default_factory=dict)

    def at(self, words: Sequence[str], start: int) -> tuple[int, list[dict[str, Any]]] | None:
        """The end and the actions of the longest phrase that starts at a word."""
        best: tuple[int, list[dict[str, Any]]] | None = None
        for phrase, actions in self.by_first.get(words[start], ()):
            end = start + len(phrase)
            if tuple(words[start:end]) == phrase and (best is None or end > best[0]):
                best = end, actions
        return best


@dataclass(frozen=True, slots=True)
class Topic:
    """What has been spoken of."""

    things: tuple[str, ...] = ()
    """ids of what was last added, moved or told about, still on the road: "it", "them" """
    before: tuple[str, ...] = ()
    """ids of what was spoken of before those: "both" of two that were added one by one """
    added: tuple[str, ...] = ()
    """ids of all that was added by someone and is still there, the latest last: "the last pothole" """
    actions: tuple[Action, ...] = ()
    """what was last done or asked: "again" """
    request: tuple[Action, ...] = ()
    """the same as it was said: a goal or a style, not what it came to"""
    asked: tuple[Action, ...] = ()
    """the last question: "and now?" asks it again"""
    said: str = ""
    """how that was said; empty for typed actions"""
    steps: int = 0
    """how many steps of undo take it back; a correction of a correction takes back both"""
    changed: tuple[Action, ...] = ()
    """the last change that was made, whatever was asked since: "put it back" undoes it"""
    changed_steps: int = 0
    """how many steps of undo take it back; 0 where there is none"""
    steps_before: int = 0
    """the same of the change before the last one; 0 where there is none"""
    away: tuple[int, ...] = ()
    """how many things each of the latest two changes took off the road or moved"""
    named: tuple[str, ...] = ()
    """ids that the last request was about: "the next one" is after them"""
    listed: tuple[str, ...] = ()
    """ids in the order in which they were last told or added: "the second one" """
    batch: tuple[str, ...] = ()
    """those of them that one request added or one answer told, the last that did"""
    gone: frozenset[str] = frozenset()
    """those of them that are no longer on the road"""
    undone: bool = False
    """whether the latest change was an undo: then "again" is to redo it"""
    kind: str | None = None
    """what "two more" is more of"""
    offered: tuple[Action, ...] = ()
    """what choosing each would do, where the last answer listed settings or styles: "the second one" """
    asked_kind: str | None = None
    """the kind of thing that the pending question is about: "remove five" after "too many cars" """
    tick: int | None = None
    """the tick that the last question or its answer named: "since then" """
    others: int = 0
    """how many more of that kind are on the road beside the things spoken of"""
    removed: bool = False
    """whether the latest amount was one taken away"""
    where: Where | None = None
    """where things were last put: "there", "the other lane" """
    phrases: Phrases = field(default_factory=Phrases)
    names: frozenset[str] = frozenset()
    """of moments that were saved, in small letters: "go back to monday" is one of them, or something else"""
    columns: int = 8
    """how many lanes the road has: "the two right lanes" """


ALONE = Topic()
"""That of a sentence with nothing before it."""
