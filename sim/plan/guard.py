"""Asking a planner for a decision, so that whatever it does the session stands.

Planners of this program are called as they are. One that another package brings is asked in a process of
its own (`sim.plan.worker`), and what it answers is looked at: an answer that is no decision for this
moment, a move that leads off the road, something raised, or no answer in time make the vehicle stay, and the
decision's `fault` says what happened.
"""

from __future__ import annotations

from sim.config import Config
from sim.forecast import foretell
from sim.kinds import Move
from sim.perceive import Percept
from sim.plan.decision import Decision, Option
from sim.plan.priority import options_in_order
from sim.plan.registry import planner_named


def is_foreign(name: str) -> bool:
    """Whether this planner comes from another package."""
    return planner_named(name) is None


def planned(percept: Percept, config: Config) -> Decision:
    """The planner's decision; or to stay, with the fault."""
    planner = planner_named(config.planner)
    if planner is not None:
        return planner.decide(foretell(percept, planner.horizon(config)), config)
    from sim.plan.worker import BUDGET_S, FailedError, SilentError, worker_of

    worker = worker_of(config.planner)
    if worker is None:
        return stayed(percept, config, "is not installed")
    try:
        answer = worker.decide(percept, config)
    except SilentError:
        return stayed(percept, config, f"did not answer within {BUDGET_S:g} s", timed_out=True)
    except FailedError as failure:
        return stayed(percept, config, str(failure))
    wrong = illegal(answer, percept)
    return answer if wrong is None else stayed(percept, config, f"answered {wrong}")


def stayed(
    percept: Percept, config: Config, fault: str | None = None, *, timed_out: bool = False
) -> Decision:
    """To stay, with every move as it was seen; no planner is asked."""
    options = options_in_order(foretell(percept, 1))
    return Decision(
        percept.tick, percept.ego_id, config.planner, Move.STAY, options, fault=fault, timed_out=timed_out
    )


def illegal(answer: object, percept: Percept) -> str | None:
    """What is wrong with an answer, to follow "answered"; None if it is a legal decision for this moment."""
    if not isinstance(answer, Decision):
        return f"{_short(answer)}, which is no decision"
    move: object = answer.move  # another package's claim
    if not isinstance(move, Move):
        return f"{_short(move)}, which is no move"
    if answer.tick != percept.tick or answer.av != percept.ego_id:
        return "for another moment or vehicle"
    if percept.road.moved(percept.ego, move) is None:
        return f"{move}, which leads off the road"
    options: object = answer.options
    if (
        not isinstance(options, tuple)
        or not all(isinstance(option, Option) for option in options)
        or sorted(option.move for option in options) != sorted(Move)
    ):
        return "without a verdict on each of the six moves"
    return None


def _short(value: object) -> str:
    return repr(value)[:80]
