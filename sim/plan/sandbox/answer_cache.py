"""What planners of other packages have answered: the same question is not asked twice.

So a decision that was taken is told of as it was, without its planner, and twenty questions about one moment
cost one. Kept for the latest questions, in memory only. Safe to use from several threads.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from hashlib import blake2b
from typing import Final

from sim.plan.sandbox.answer import Answer

MOST: Final = 20_000
"""Answers, of some hundred bytes each."""


class AnswerCache:
    """The latest answers, and the faults that were met instead."""

    def __init__(self, most: int = MOST) -> None:
        self._most = most
        self._lock = threading.Lock()
        self._by_question: OrderedDict[bytes, Answer | str] = OrderedDict()

    def note(self, key: bytes, answer: Answer | str) -> None:
        """An answer, or the fault (`FaultError`) that was met."""
        with self._lock:
            self._by_question[key] = answer
            self._by_question.move_to_end(key)
            if len(self._by_question) > self._most:
                self._by_question.popitem(last=False)

    def find(self, key: bytes) -> Answer | str | None:
        """What was answered to this question."""
        with self._lock:
            found = self._by_question.get(key)
            if found is not None:
                self._by_question.move_to_end(key)
            return found

    def clear(self) -> None:
        """Forget all."""
        with self._lock:
            self._by_question.clear()


def key_of(planner: str, question: bytes) -> bytes:
    """What a planner is asked, in 16 bytes."""
    digest = blake2b(planner.encode(), digest_size=16)
    digest.update(b"\0")
    digest.update(question)
    return digest.digest()


answers = AnswerCache()
"""Those of this process."""
