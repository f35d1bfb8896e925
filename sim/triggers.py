"""Rules that stand in a session ("every 10 ticks add a car"), as part of its state.

What a rule is waiting for and does is `sim.actions.Trigger`; here is how it stands. That it is looked at
after every tick is the work of `sim.session.triggers`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sim.actions import Trigger

MAX_TRIGGERS: Final = 20
"""How many rules may stand at a time."""
MAX_FAILURES: Final = 10
"""How often in a row a rule may fail to do what it says; then it is switched off."""
MAX_CROWDING: Final = 0.5
"""The share of the cells between start and goal that may be taken after a rule has put things on the road."""


@dataclass(frozen=True, slots=True)
class StandingTrigger:
    """A rule, and how it stands at a tick."""

    number: int
    """by which it is named; never used again in the session"""
    trigger: Trigger
    since: int
    """the tick at which it was made"""
    held: bool = False
    """whether its condition held after the latest tick"""
    fired: int = 0
    """how often it has been done"""
    failed: int = 0
    """how often it could not be done since it was done last"""


@dataclass(frozen=True, slots=True)
class Triggers:
    """The rules of a session, in the order of their numbers."""

    made: int = 0
    """how many were ever made: the latest number"""
    standing: tuple[StandingTrigger, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.standing)


NO_TRIGGERS: Final = Triggers()
