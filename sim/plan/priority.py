"""`priority`: the rule planner. Forward, then left or right, then a diagonal, then stay.

Structure: one tick of forecast; the first move in a fixed order whose cell will be free.
Guarantees: never a step into a cell that will be taken while another move is free.
Simplifications: no memory and no look-ahead, so that it may swing left and right before a wall
for ever (a livelock, ended as STUCK), and may stand where a mover arrives (`stay` is the last
resort, free or not). Left is tried before right, so a mirrored road is mirrored only for a
planner that prefers right.
Source: the pygame study this project grew from; see "Planners" in the project's rules.
"""

from __future__ import annotations

from functools import lru_cache

from sim.config import Config
from sim.fast_replace import fast_constructor
from sim.forecast import Forecast, StepVerdict
from sim.plan.decision import Decision, Option
from sim.plan.protocol import SIMPLEST, Traits
from sim.rules.dynamics import Dynamics
from sim.types import MOVES, Move

_decided = fast_constructor(Decision, "tick", "av", "planner", "move", "options")
_option = fast_constructor(Option, "move", "cell", "reason", "cost", "causes")


def options_in_order(forecast: Forecast) -> tuple[Option, ...]:
    """Every move with what it would meet; its cost is its place in the order."""
    # Most moves of most ticks are free: all that are, are found at once, and only the others looked into.
    steps = forecast.own_steps()
    ready = _free_options(forecast.dynamics, forecast.ego)
    if all(steps):
        return ready
    return tuple(
        [free if there else met_option(forecast, free) for there, free in zip(steps, ready, strict=True)]
    )


def met_option(forecast: Forecast, free: Option) -> Option:
    """A move that is not free, with what it would meet; `free` says where it leads."""
    end = None if free.cell is None else forecast.road.index(free.cell)
    reason, causes = forecast.check_step(forecast.ego, end)
    return _option(free.move, free.cell, reason, None, causes)


@lru_cache(maxsize=4_096)
def _free_options(dynamics: Dynamics, index: int) -> tuple[Option, ...]:
    """Every move from a cell as it is where nothing would be met, in the order of `MOVES` and of `Steps`."""
    ends = [dynamics.target(index, move) for move in MOVES]
    cells = [None if end is None else dynamics.road.cell(end) for end in ends]
    return tuple(
        Option(move, cell, StepVerdict.FREE, float(rank), ())
        for rank, (move, cell) in enumerate(zip(MOVES, cells, strict=True))
    )


class PriorityPlanner:
    """The first move of `MOVES` whose cell will be free; staying when there is none."""

    name = "priority"
    traits = Traits(
        local=True, near=True, forward_only=True, plans_to_goal=False, work=SIMPLEST, decisions_per_answer=450
    )

    def horizon(self, config: Config) -> int:  # noqa: ARG002 - the same for every road
        """One tick."""
        return 1

    def decide(self, forecast: Forecast, config: Config) -> Decision:  # noqa: ARG002 - no preferences
        """The move and the six verdicts."""
        options = options_in_order(forecast)
        for option in options:
            if option.cost is not None:
                return _decided(forecast.tick, forecast.ego_id, self.name, option.move, options)
        return _decided(forecast.tick, forecast.ego_id, self.name, Move.STAY, options)
