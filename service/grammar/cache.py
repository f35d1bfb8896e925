"""A cache of parses: the same text about the same things means the same.

Parsing is a pure function of the text and of the attributes of the topic that it reads. The cache records
those attributes and their values, and answers only while all of them are equal. So "add a pothole" is
answered although other things were added meanwhile, and "remove it" only while "it" is the same. The same
sentence is parsed while it is typed, when it is sent, and many times by scripts.
Refusals are not cached: nobody repeats them, and rubbish must not fill the cache.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from threading import Lock
from typing import Any, NamedTuple, cast

from service.grammar.parse_types import Parse, Understood
from service.grammar.topic import Phrases, Topic
from service.grammar.work_budget import WorkBudget

MOST = 512
"""How many sentences are remembered, and how long one may be in letters."""
LONGEST = 200


_VALUES = frozenset(("actions", "where"))
"""What is said again, or pointed back at, as it was: of these, equal ones may differ (2 and 2.0)."""


class _Read(NamedTuple):
    """What a sentence meant, and the attributes of the topic that were read."""

    meant: Understood
    seen: dict[str, Any]


class _TopicRecorder:
    """A topic that records which of its attributes are read."""

    def __init__(self, topic: Topic) -> None:
        self._topic = topic
        self.seen: dict[str, Any] = {}

    def __getattr__(self, name: str) -> Any:
        found = self.seen[name] = getattr(self._topic, name)
        return found


class ParseCache:
    """Parses that were understood, by their text. For any thread."""

    def __init__(self, read: Callable[[str, Topic, WorkBudget], Parse]) -> None:
        """`read`: looks at a topic through its attributes, and at nothing else that could change."""
        self._read = read
        self._known: OrderedDict[str, _Read] = OrderedDict()
        self._changing = Lock()

    def parse(self, text: str, topic: Topic, work: WorkBudget) -> Parse:
        """What a sentence means; one that is remembered costs no work."""
        known = self._known.get(text)
        if known is not None and all(_same(getattr(topic, name), seen) for name, seen in known.seen.items()):
            return known.meant
        if len(text) > LONGEST:
            return self._read(text, topic, work)
        noting = _TopicRecorder(topic)
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
