"""Preconditions of a change, and the response to store with it.

A client may name the change that it saw last (`If-Match`), and a response may be stored together with the
change (`Idempotency-Key`). Both are atomic with the change.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from service.problems import PreconditionFailed
from service.sessions.utterance import Outcome
from service.store import StoredResponse


@dataclass(frozen=True, slots=True)
class Preconditions:
    """The preconditions of one change; none by default.

    `sequences`: the session must be at one of these sequence numbers. `answer`: makes the response to store
    from the outcome, before the change is stored.
    """

    sequences: frozenset[int] | None = None
    answer: Callable[[Outcome], StoredResponse] | None = None

    def check(self, sequence: int) -> None:
        """Raise `PreconditionFailed` unless the session is at one of the sequence numbers."""
        if self.sequences is not None and sequence not in self.sequences:
            raise PreconditionFailed(sequence)


NO_PRECONDITIONS = Preconditions()
"""None at all."""
