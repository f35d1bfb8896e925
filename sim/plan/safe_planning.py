"""Asking a planner for a decision, so that whatever it does the session stands.

Planners of this program are called as they are. One that another package brings is asked in a process of
its own (`sim.plan.sandbox.worker`). Of what it answers a move and costs are taken, nothing else
(`sim.plan.sandbox.answer`). An answer that is none, a move that leads off the road, something raised, or no
answer in time make the ego stay, and the decision's `fault` says what happened.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from sim.config import Config
from sim.forecast import Forecast, predict
from sim.perceive import Percept
from sim.plan.decision import Decision, Measure
from sim.plan.priority import options_in_order
from sim.plan.registry import planner_named
from sim.types import Move

if TYPE_CHECKING:
    from sim.plan.sandbox.answer import Answer

NOT_KNOWN: Final = "did not answer as it should"
"""The fault of a decision of which no more is known any more."""


def is_foreign(name: str) -> bool:
    """Whether this planner comes from another package."""
    return planner_named(name) is None


def plan_safely(percept: Percept, config: Config) -> tuple[Forecast, Decision]:
    """What the planner reads and decides; or to stay, with the fault.

    The forecast goes as far ahead as the planner asks for; for one of another package it is one tick.
    """
    planner = planner_named(config.planner)
    if planner is not None:
        forecast = predict(percept, planner.horizon(config))
        return forecast, planner.decide(forecast, config)
    from sim.plan.sandbox.client import wait_for_answer

    return predict(percept, 1), plan_answered(lambda: wait_for_answer(percept, config), percept, config)


def plan_answered(answered: Callable[[], Answer], percept: Percept, config: Config) -> Decision:
    """What an answer of another package's planner comes to, or that there is none."""
    from sim.plan.sandbox.answer import FaultError, decision_of
    from sim.plan.sandbox.planner_process import NoAnswerError

    try:
        return decision_of(answered(), percept, config)
    except NoAnswerError as silence:
        return hold_position(percept, config, str(silence), timed_out=True)
    except FaultError as fault:
        return hold_position(percept, config, str(fault))


def hold_position(
    percept: Percept, config: Config, fault: str | None = None, *, timed_out: bool = False
) -> Decision:
    """To stay, with every move as it was seen; no planner is asked."""
    options = options_in_order(predict(percept, 1))
    return Decision(
        percept.tick, percept.ego_id, config.planner, Move.STAY, options, fault=fault, timed_out=timed_out
    )


def recorded_decision(percept: Percept, config: Config, move: Move) -> Decision:
    """What a planner of another package once decided: its move, and the costs if they are remembered."""
    from sim.plan.sandbox.answer import Answer, decision_of
    from sim.plan.sandbox.client import cached_answer

    found = cached_answer(percept, config)
    if isinstance(found, Answer) and found.move is move:
        return decision_of(found, percept, config)
    options = (replace(option, cost=None) for option in options_in_order(predict(percept, 1)))
    first = sorted(options, key=lambda option: option.move is not move)
    return Decision(percept.tick, percept.ego_id, config.planner, move, tuple(first), measure=Measure.OWN)


def failed_decision(percept: Percept, config: Config) -> Decision:
    """What was done when a planner of another package once failed: the ego stayed."""
    from sim.plan.sandbox.answer import Answer, FaultError, decision_of
    from sim.plan.sandbox.client import cached_answer

    found = cached_answer(percept, config)
    if isinstance(found, Answer):
        try:
            decision_of(found, percept, config)
        except FaultError as fault:
            found = str(fault)
    return hold_position(percept, config, found if isinstance(found, str) else NOT_KNOWN)
