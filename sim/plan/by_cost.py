"""From what every move costs in all to a decision with its trace: shared by the planners that weigh costs."""

from __future__ import annotations

from collections.abc import Sequence

from sim.forecast import Forecast
from sim.plan.decision import Decision, Measure, Option
from sim.search.reachability import longest_lasting
from sim.types import MOVES, Move


def decide_by_cost(
    planner: str,
    measure: Measure,
    forecast: Forecast,
    totals: Sequence[int | None],
    limit: int,
    lasting: Move | None = None,
) -> Decision:
    """The cheapest move, ties in the order of `Move`; with no way on, the move after which one lasts longest.

    `totals` are in the order of `Move`; None where the step is not free or no way leads on. `lasting`: the
    move after which one lasts longest, where it is known already.
    """
    options = []
    for move, total in zip(MOVES, totals, strict=True):
        end = forecast.dynamics.target(forecast.ego, move)
        reason, causes = forecast.check_step(forecast.ego, end)
        cell = None if end is None else forecast.road.cell(end)
        options.append(Option(move, cell, reason, None if total is None else float(total), causes))
    options.sort(key=lambda option: (option.cost is None, option.cost or 0.0))
    if options[0].cost is not None:
        move = options[0].move
    else:
        move = longest_lasting(forecast, limit) if lasting is None else lasting
        options.sort(key=lambda option: option.move is not move)
    return Decision(forecast.tick, forecast.ego_id, planner, move, tuple(options), measure=measure)
