"""Does the last request to other things: "and the other one", "no, the first one", "that car too"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

from service.actions import Action
from service.grammar.parse_types import Parse, Understood
from service.grammar.sentences import Unsayable
from service.grammar.topic import Topic
from service.grammar.work_budget import WorkBudget
from sim.actions import Copy, MoveThings, Remove, Replace, Where

_MARK = "barrier-999999"
"""An id that no thing has: it stands in a sentence where the other things are to be named."""


class LanguageReader(Protocol):
    """What is needed of the language."""

    def read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        """A sentence read."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""


def to_other_things(
    language: LanguageReader, named: str, topic: Topic, done: Sequence[Action], noun_after: Sequence[str] = ()
) -> tuple[Action, ...] | None:
    """The last request done to the things that are `named`; None where they are none, or unclear.

    `named` is as it was said, and what it may refer to is in the topic; `noun_after` are ways to complete it
    ("the third": "the third one").
    """
    of_things = [each for each in done if isinstance(each, Remove | MoveThings | Replace | Copy)]
    if not of_things or len(of_things) < len(done):
        return None
    first = of_things[0]
    alike = {_without_thing(each) for each in of_things}
    if len(alike) > 1 or not _pointed(first):
        return None
    try:
        sentence = language.sentence((replace(_without_thing(first), where=Where(id=_MARK)),))
    except Unsayable:
        return None
    if sentence.count(_MARK) != 1:
        return None
    for words in (named, *(each.format(said=named) for each in noun_after)):
        parsed = language.read(sentence.replace(_MARK, words), topic, WorkBudget(), asking=False)
        if isinstance(parsed, Understood) and all(
            type(each) is type(first) and _pointed(each) and _aim(each) == _aim(first)
            for each in parsed.actions
        ):
            return parsed.actions
    return None


def _pointed(action: Action) -> bool:
    """Whether an action is about things that it points at, not about an amount of a kind."""
    where = getattr(action, "where", None)
    return where is not None and (where.id is not None or bool(where.nearest) or where.lane is not None)


def _without_thing(action: Remove | MoveThings | Replace | Copy) -> Remove | MoveThings | Replace | Copy:
    """An action on one thing, whichever that is."""
    return replace(action, kind="barrier", count=1, where=None)


def _aim(action: Action) -> tuple[object, ...]:
    """What an action does to things, whichever they are."""
    return tuple(getattr(action, key, None) for key in ("to", "by"))
