"""What sessions have done in worker processes: functions that can be pickled, with all they take."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

from service.actions import Action
from service.sessions.facts import Fact, Stepped
from service.sessions.transaction import Transaction
from sim.decide import decide_each
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.state import EgoStep, SimState, StepResult

Performed = tuple[Transaction, tuple[Fact, ...]]


def perform(transaction: Transaction, sequence: int, actions: Sequence[Action]) -> Performed:
    """Perform actions; the transaction afterwards, and what they did. Raises a `ProblemError`."""
    return transaction, transaction.perform(sequence, actions)


def perform_for_transfer(transaction: Transaction, sequence: int, actions: Sequence[Action]) -> Performed:
    """The same, with less to be sent back: ticks keep their decisions, but not what these were taken from."""
    facts = transaction.perform(sequence, actions)
    return transaction, tuple(_without_percepts(fact) for fact in facts)


def decide(state: SimState) -> dict[str, Decision]:
    """The decision of each ego in a state."""
    return {id: step.decision for id, step in decide_each(state).items()}


def decision_before(timeline: Timeline) -> tuple[SimState, Decision | None]:
    """The state before the present one, and the decision taken in it."""
    run = timeline.at(timeline.tick - 1)
    return run, timeline.decided(run)


def _without_percepts(fact: Fact) -> Fact:
    if not isinstance(fact, Stepped):
        return fact
    return replace(fact, ticks=tuple(_bare(tick) for tick in fact.ticks))


def _bare(tick: StepResult) -> StepResult:
    nothing = cast(Any, None)
    steps = {id: EgoStep(nothing, nothing, step.decision, nothing) for id, step in tick.steps.items()}
    return replace(tick, steps=steps)
