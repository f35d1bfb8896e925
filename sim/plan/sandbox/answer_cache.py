"""A cache of planners' answers: the same question is not asked twice.

A past decision is then explained without its planner, and twenty questions about one tick cost one call. The
cache holds the latest questions, in memory only (least recently used ones are dropped), and is thread-safe.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from hashlib import blake2b
from typing import Final

from sim.plan.sandbox.answer import Answer

MOST: Final = 20_000
"""Most entries, of some hundred bytes each."""


class AnswerCache:
    """An LRU cache of answers and faults by question."""

    def __init__(self, most: int = MOST) -> None:
        self._most = most
        self._lock = threading.Lock()
        self._by_question: OrderedDict[bytes, Answer | str] = OrderedDict()

    def note(self, key: bytes, answer: Answer | str) -> None:
        """Stores an answer, or the message of the fault that came instead."""
        with self._lock:
            self._by_question[key] = answer
            self._by_question.move_to_end(key)
            if len(self._by_question) > self._most:
                self._by_question.popitem(last=False)

    def find(self, key: bytes) -> Answer | str | None:
        """Returns the stored answer or fault; None if the question is unknown."""
        with self._lock:
            found = self._by_question.get(key)
            if found is not None:
                self._by_question.move_to_end(key)
            return found

    def clear(self) -> None:
        """Removes all entries."""
        with self._lock:
            self._by_question.clear()


def key_of(planner: str, question: bytes) -> bytes:
    """Hashes a planner's name and a question to a key of 16 bytes."""
    digest = blake2b(planner.encode(), digest_size=16)
    digest.update(b"\0")
    digest.update(question)
    return digest.digest()


answers = AnswerCache()
"""The cache of this process."""
