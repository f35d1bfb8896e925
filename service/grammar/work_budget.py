"""How much work one utterance may cost, counted in steps of the engine and never in time.

The same sentence costs the same steps on every machine, so whether it is read depends on nothing but
the sentence. A sentence that needs more is refused as too involved; no labelled sentence comes near the bound
(`tests/grammar/test_work_budget.py`). Leaves out what a step is: each stage counts its own innermost loop.
"""

from __future__ import annotations

from service.grammar.parse_types import Parse

MOST_STEPS = 20_000
"""What one utterance may cost."""

READ_STEPS = 60
"""What one reading of a text costs beside its words: a correction is read once for each place it may have."""

TOKEN_STEPS = 10
"""What each of its words costs to be looked up."""


class SpentError(Exception):
    """The work is used up."""


class Work:
    """What is left of one utterance's work, and the readings it has paid for."""

    __slots__ = ("_most", "known", "left")

    def __init__(self, most: int = MOST_STEPS) -> None:
        """`most`: the steps there are."""
        self._most = most
        self.left = most
        self.known: dict[tuple[str, int], Parse] = {}
        """Texts that were read within this utterance, with the identity of the topic: none is read twice."""

    @property
    def spent(self) -> int:
        """Steps that were spent; more than there were where the last could not be paid."""
        return self._most - self.left

    def spend(self, steps: int) -> None:
        """Take away some steps. Raises `SpentError` where there are not as many."""
        self.left -= steps
        if self.left < 0:
            raise SpentError
