"""Falsification: looks for worlds that a planner fails although they can be driven, and makes them small.

A `Falsification` says what is searched. Worlds are drawn from a space of scenarios (`space`), at first at
random and then by the cross-entropy method (`cross_entropy`); failures are proved to be the planner's
(`world`), shrunk by delta debugging (`shrink`) and kept as cases that can be replayed (`case`). `stages` cuts
the search into pieces of work, and `search.falsify` runs them all. The result depends on the `Falsification`
alone.
"""

from sim.falsify.case import Case, CaseError
from sim.falsify.spec import Falsification

__all__ = ["Case", "CaseError", "Falsification"]
