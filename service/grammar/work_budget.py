"""The work budget of one utterance, counted in steps of the engine and not in time.

A sentence costs the same number of steps on every machine, so the machine does not decide what is understood.
A sentence that exceeds the budget is refused as too involved; no labelled sentence comes near it
(`tests/grammar/test_work_budget.py`). Each stage counts the rounds of its innermost loop as steps.
"""

from __future__ import annotations

from service.grammar.parse_types import Parse

MOST_STEPS = 20_000
"""What one utterance may cost."""

READ_STEPS = 60
"""What one reading of a text costs beside its words: a correction is read once for each place it may have."""

TOKEN_STEPS = 10
"""What each of its words costs to be looked up."""


class BudgetExceededError(Exception):
    """The steps are used up."""


class WorkBudget:
    """The steps that one utterance has left, and the readings it has paid for."""

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
        """Take away some steps. Raises `BudgetExceededError` where there are not as many."""
        self.left -= steps
        if self.left < 0:
            raise BudgetExceededError
