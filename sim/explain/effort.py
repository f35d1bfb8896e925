"""How much work an answer may take before it says what has been found so far.

Work is counted in what decisions look through and never by the clock, so the same question has the same
answer wherever the compiled costs are loaded (`sim.search.compiled_costs`); before that, less is tried. Asked
to go on, an answer begins again with more.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Final

from sim.config import Config
from sim.plan import Decision, Measure, traits_of
from sim.rules.compiled import compiled_rules
from sim.search.compiled_costs import are_loaded, load_compiled_costs
from sim.search.costs import weights
from sim.state import SimState

FOR_CAUSES: Final = 1_100
"""Work of looking for causes; a unit is some ten microseconds."""
FOR_CHANGES: Final = 1_500
"""Work of looking for a change."""
CELLS_LOOKED_AT: Final = 1_500
"""Cells that a decision looks through in a unit of work where many are taken at once."""
RESERVE: Final = 700
"""Work of what is tried last, when all else is spent."""
MORE: Final = 40
"""So many times the work where an answer is asked to go on."""

_DECISION: Final = 4
"""Work of a decision that looks no further than the next tick."""
_TICK: Final = {Measure.TICKS: 1, Measure.COST: 4}
"""Work of each tick of a way to the goal, by what is weighed."""
_COMPILED: Final = 15
"""Work of a decision that looks to the goal where the compiled costs answer (`sim.search.compiled_costs`)."""
_NO_WAY: Final = 3
"""Ticks for each row of the road that count for a decision that finds no way to the goal."""


class Effort(StrEnum):
    """How hard an answer is looked for."""

    USUAL = "usual"
    MORE = "more"

    def of(self, work: int) -> int:
        """The work that is allowed, where it usually is `work`."""
        return work if self is Effort.USUAL else MORE * work


def work_among_many(columns: int, row: int) -> int:
    """The work of one of many decisions that are taken at once, from a row."""
    return 1 + columns * row * row // CELLS_LOOKED_AT


class WorkSpentError(Exception):
    """The work that an answer may take is done; what was found before holds."""


def prepare(state: SimState) -> None:
    """Load what makes an explanation quick, if it was ever compiled: decisions, futures and searches."""
    if len(state.egos) == 1:
        load_compiled_costs()


def work_of(decision: Decision, config: Config) -> int:
    """The work of a decision, estimated by what it found: how long it really took hangs on what was kept."""
    of_tick = _TICK.get(decision.measure, 0)
    cost = decision.chosen.cost
    if not of_tick or traits_of(decision.planner).quick:
        return _DECISION
    if are_loaded() and compiled_rules(config):
        return _COMPILED
    if cost is None:
        return _DECISION + of_tick * _NO_WAY * config.rows
    return _DECISION + of_tick * int(cost / (weights(config).tick if decision.measure is Measure.COST else 1))
