"""What a question supposes of how a drive ends: "would it have crashed?", "do I survive?"."""

from typing import Final

from sim.types import Outcome

FAILS: Final = "fails"
"""A crash is supposed."""
ARRIVES: Final = "arrives"
"""It is supposed to go well."""
SEES: Final = "sees"
"""The thing is supposed to be seen."""


def agrees(supposes: str | None, outcome: Outcome) -> bool | None:
    """Whether an end is as supposed; None where neither yes nor no would be plain."""
    if supposes == ARRIVES and outcome is not Outcome.RUNNING:
        return outcome is Outcome.SUCCESS
    if supposes == FAILS and outcome in (Outcome.CRASH, Outcome.SUCCESS):
        return outcome is Outcome.CRASH
    return None
