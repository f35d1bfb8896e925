"""Which things may have a part in a decision at all, by the traits of its planner, and how many may be tried.

What a planner does not read cannot flip its decision, so leaving it out of a search loses nothing.
"""

from __future__ import annotations

from typing import Final

from sim.explain.factors import is_factor
from sim.perceive import Percept
from sim.plan.protocol import Traits
from sim.search.passages import locked_in

TRIED_QUICK: Final = 120
"""Things that are tried one by one where a decision takes a few hundredths of a millisecond."""
TRIED_SEARCHING: Final = 2
"""The same where a decision searches to the goal; further ones are tried in groups."""


def having_part(percept: Percept, traits: Traits, names: list[str]) -> list[str]:
    """Those of the names that the planner may have read, in their order."""
    if not traits.local or percept.egos:
        return names
    columns = percept.road.columns
    own = percept.ego // columns
    read = {name for cell, name in percept.movers.items() if own - 1 <= cell // columns <= own}
    if traits.by_passages:  # movers that are locked in count as what never moves
        road, moving = percept.road, percept.right | percept.left
        locked = locked_in(moving, percept.boards.fixed, road.left_edge, road.right_edge)
        read |= {name for cell, name in percept.movers.items() if locked >> cell & 1}
    first = own - 1 if traits.near else 0
    read |= {name for cell, name in percept.hazards.items() if first <= cell // columns <= own}
    return [name for name in names if name in read or is_factor(name)]


def tried_singly(traits: Traits) -> int:
    """How many things are tried one by one for an answer."""
    return TRIED_QUICK if traits.quick else TRIED_SEARCHING
