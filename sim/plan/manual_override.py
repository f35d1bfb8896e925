"""A person's move, put through the same picture as a planner's.

A move whose cell will not be free is held back: the ego stays, and the trace says what would
have been met. Staying is always granted; whether it was wise, the judge says.
"""

from __future__ import annotations

from dataclasses import replace

from sim.plan.decision import Decision
from sim.types import Move


def override(planned: Decision, asked: Move) -> Decision:
    """The decision when a person asks for a move, given the planner's view of the same tick."""
    granted = Move.STAY if planned.option(asked).reason.blocks else asked
    return replace(planned, planner="manual", move=granted, asked=asked)
