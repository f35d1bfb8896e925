"""Sentences that were just read, read again: the same text, of the same things, means the same.

Reading is a pure function of a text and of what it looks at in the topic. What it looked at is noted, with
the values found there; the meaning is given again only where all of those are the same. So "add a pothole"
is known again although others were added meanwhile, and "remove it" only while "it" is the same. A sentence
is read while it is typed, when it is sent, and by scripts a hundred times. Leaves out what was not
understood: nobody says that again, and whoever sends rubbish must fill nothing.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from threading import Lock
from typing import Any, NamedTuple, cast

from service.grammar.parse_types import Parse, Understood
from service.grammar.topic import Phrases, Topic
from service.grammar.work_budget import Work

MOST = 512
"""How many sentences are remembered, and how long one may be in letters."""
LONGEST = 200


_VALUES = frozenset(("actions", "where"))
"""What is said again, or pointed back at, as it was: of these, equal ones may differ (2 and 2.0)."""


class _Read(NamedTuple):
    """What a sentence meant, and what of the topic was looked at."""

    meant: Understood
    seen: dict[str, Any]


class _Noting:
    """A topic that notes what is looked at."""

    def __init__(self, topic: Topic) -> None:
        self._topic = topic
        self.seen: dict[str, Any] = {}

    def __getattr__(self, name: str) -> Any:
        found = self.seen[name] = getattr(self._topic, name)
        return found


class Remembered:
    """A reader with a memory of the sentences it has understood. For any thread."""

    def __init__(self, read: Callable[[str, Topic, Work], Parse]) -> None:
        """`read`: looks at a topic through its attributes, and at nothing else that could change."""
        self._read = read
        self._known: OrderedDict[str, _Read] = OrderedDict()
        self._changing = Lock()

    def parse(self, text: str, topic: Topic, work: Work) -> Parse:
        """What a sentence means; one that is remembered costs no work."""
        known = self._known.get(text)
        if known is not None and all(_same(getattr(topic, name), seen) for name, seen in known.seen.items()):
            return known.meant
        if len(text) > LONGEST:
            return self._read(text, topic, work)
        noting = _Noting(topic)
        meant = self._read(text, cast(Topic, noting), work)
        if isinstance(meant, Understood) and _VALUES.isdisjoint(noting.seen):
            with self._changing:
                self._known[text] = _Read(meant, noting.seen)
                self._known.move_to_end(text)
                if len(self._known) > MOST:
                    self._known.popitem(last=False)
        return meant


def _same(one: Any, other: Any) -> bool:
    """Whether it makes no difference which of two was looked at: names, and taught phrases by identity."""
    if isinstance(one, Phrases):
        return one is other or not (one.by_first or other.by_first)
    return bool(one == other)
