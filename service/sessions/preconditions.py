"""On what terms a change is asked for, beside what it is.

A caller may say which change of the session it has seen last, and what is to be kept with the change.
Both hold at the very moment of the change: nothing can come between.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from service.problems import PreconditionFailed
from service.sessions.utterance import Outcome
from service.store import StoredResponse


@dataclass(frozen=True, slots=True)
class Preconditions:
    """The terms of one change; none of them by default.

    `sequences`: the session must stand at one of these. `answer`: makes of the outcome what is to be kept
    with it, before it is stored.
    """

    sequences: frozenset[int] | None = None
    answer: Callable[[Outcome], StoredResponse] | None = None

    def check(self, sequence: int) -> None:
        """Raise `Stale` where the session stands elsewhere."""
        if self.sequences is not None and sequence not in self.sequences:
            raise PreconditionFailed(sequence)


NO_PRECONDITIONS = Preconditions()
"""No terms at all."""
