"""Which of the things in the way to name in a line about a decision: one that matters to the move.

What stands in the way of the first choice need not matter: behind it there may be something else that would
be in the way as well. So the decision is taken again without it. A few runs at most, since a line is told at
every tick.
"""

from __future__ import annotations

from typing import Final

from sim.decide import announced_before, decide_on, sense
from sim.forecast import Forecast
from sim.perceive import Percept
from sim.plan import Decision, Option
from sim.state import SimState
from sim.types import Move

MOST_BEHIND: Final = 2
"""So many times what comes to stand in the way once others are gone is taken away too."""


def telling_option(run: SimState, decision: Decision, forecast: Forecast | None = None) -> Option | None:
    """A move not made, whose blockers matter to the decision: taken away, another move is made.

    None where none was found. `forecast`: what was decided by, where that is known already.
    """
    ego = decision.av
    percept = forecast.percept if forecast is not None else sense(run, announced_before(run, ego), ego)[0]
    met = [option for option in decision.options if option.causes and option.move is not decision.move]
    met = [option for option in met if option in decision.preferred or option.move is Move.FORWARD]
    for option in met:
        if decide_on(run, percept.without(option.causes), ego).move is not decision.move:
            return option
    return next((option for option in met[:1] if _matters_with_others(run, decision, option, percept)), None)


def _matters_with_others(run: SimState, decision: Decision, option: Option, percept: Percept) -> bool:
    """Whether a move's blockers matter together with what would be in the way once they are gone."""
    ego, gone = decision.av, tuple(option.causes)
    for _ in range(MOST_BEHIND):
        seen = decide_on(run, percept.without(gone), ego)
        if seen.move is not decision.move:
            behind = [name for name in gone if name not in option.causes]
            return decide_on(run, percept.without(behind), ego).move is decision.move
        gone += tuple(name for name in seen.option(option.move).causes if name not in gone)
    return False
