"""A cache of what sentences mean in a conversation: the same text about the same things means the same.

The grammar remembers what a sentence means by itself (`service.grammar.cache`). What it means after the one
before it is a pure function of the text and of those attributes of the topic that are looked at; so a
sentence that a script says again and again, or that was typed before it is sent, is read once. The attributes
that were looked at are kept beside the meaning, which holds only while all of them are the same: not merely
equal, since a request that is said again repeats numbers as they were written (2 and 2.0 are equal).

Refusals and questions are not kept: nobody repeats them, and rubbish must not fill the cache.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import fields
from threading import Lock
from typing import Any

from service.grammar.parse_types import Parse, Understood
from service.grammar.topic import Now, Phrases, Topic

MOST = 1_024
"""Sentences that are kept."""
LONGEST = 200
"""Characters of a sentence that is kept, at most."""

_FIELDS = tuple(each.name for each in fields(Topic))
_PLAIN = (str, bool, int, type(None))


class _RecordingNow:
    """A road that is spoken of, which records that it was looked at: what depends on it is not kept."""

    def __init__(self, now: Now, seen: dict[str, Any]) -> None:
        self._now, self._seen = now, seen

    def count(self, kind: str) -> int:
        self._seen["now"] = self._now
        return self._now.count(kind)

    def value(self, parameter: str) -> int | float | str | None:
        self._seen["now"] = self._now
        return self._now.value(parameter)


class _RecordingTopic(Topic):
    """A topic that records which of its attributes are read."""

    __slots__ = ("_seen",)

    def __getattribute__(self, name: str) -> Any:
        found = super().__getattribute__(name)
        if name in _FIELDS:
            try:
                seen = super().__getattribute__("_seen")
            except AttributeError:  # made of another by `replace`, which read all attributes of that
                return found
            if name == "now" and found is not None:
                return _RecordingNow(found, seen)
            seen[name] = found
        return found


def _recording(topic: Topic) -> tuple[Topic, dict[str, Any]]:
    """A topic with the attributes of another, and where what is read of it is recorded."""
    seen: dict[str, Any] = {}
    twin = _RecordingTopic(**{name: getattr(topic, name) for name in _FIELDS})
    object.__setattr__(twin, "_seen", seen)
    return twin, seen


class SentenceCache:
    """Sentences that were understood in a conversation, by language and text. For any thread."""

    def __init__(self) -> None:
        self._known: OrderedDict[tuple[int, str], tuple[object, Understood, dict[str, Any]]] = OrderedDict()
        self._changing = Lock()

    def parse(self, language: object, text: str, topic: Topic, read: Callable[[Topic], Parse]) -> Parse:
        """What a sentence means in a language; `read` says so of a topic, and looks at nothing else."""
        if len(text) > LONGEST:
            return read(topic)
        key = id(language), text
        known = self._known.get(key)
        if known is not None and known[0] is language:
            for name, seen in known[2].items():
                found = getattr(topic, name)
                if found is not seen and not _same(found, seen):
                    break
            else:
                return known[1]
        recording, seen_now = _recording(topic)
        parsed = read(recording)
        if isinstance(parsed, Understood):
            with self._changing:
                self._known[key] = language, parsed, seen_now
                self._known.move_to_end(key)
                if len(self._known) > MOST:
                    self._known.popitem(last=False)
        return parsed


def _same(one: Any, other: Any) -> bool:
    """Whether no sentence could tell two values apart."""
    if type(one) is not type(other):
        return False
    if isinstance(one, Phrases):
        return not (one.by_first or other.by_first)
    if isinstance(one, _PLAIN):
        return bool(one == other)
    if isinstance(one, tuple):
        return len(one) == len(other) and all(
            mine is theirs or _same(mine, theirs) for mine, theirs in zip(one, other, strict=True)
        )
    return bool(one == other) and repr(one) == repr(other)
