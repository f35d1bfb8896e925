"""Where the actions of an utterance are performed and its answers are made: by what they will cost.

What is small is done on the event loop, what is larger in a thread, and what is larger still in a worker
process; what asks a planner of another package runs in the threads for that.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from service.actions.table import traits_of
from service.problems import UnknownName
from service.sessions.bookmarks import add_other_session
from service.sessions.facts import Asked, Fact, question_timelines
from service.sessions.outcome import is_slow_to_answer, make_outcome
from service.sessions.scheduler.offload import (
    QUESTION_S,
    STEPS_S,
    names_external_planner,
    run_in_thread,
    uses_external_planner,
)
from service.sessions.transaction import Transaction
from service.sessions.utterance import Outcome, ReachabilityNotice, Utterance
from service.sessions.work_estimate import answer_units, transaction_units
from service.sessions.worker_calls import Performed, perform, perform_for_transfer
from service.work.units import THREAD

if TYPE_CHECKING:
    from service.sessions.session import Session


async def perform_actions(session: Session, transaction: Transaction, utterance: Utterance) -> Performed:
    """The transaction afterwards, another object where a process did it, and the facts."""
    actions, work = utterance.actions, session.services.work
    sequence = session.sequence + 1
    try:
        if transaction.needs_external_planner(actions):
            foreign = uses_external_planner(transaction.timeline) or names_external_planner(actions)
            done = partial(perform, transaction, sequence, actions)
            return await run_in_thread(foreign, STEPS_S, done)
        units = transaction_units(transaction, actions)
        if units > THREAD:
            transaction.talk = transaction.talk.for_transfer()
            return await work.run(units, perform_for_transfer, transaction, sequence, actions)
        if units or any(traits_of(action).searches for action in actions):
            return await work.run(units, perform, transaction, sequence, actions)
        return perform(transaction, sequence, actions)
    except UnknownName as problem:
        raise await add_other_session(
            session.services.store, problem, utterance.actions, utterance.language or session.language
        ) from None


async def tell_outcome(
    session: Session,
    utterance: Utterance,
    facts: tuple[Fact, ...],
    sequence: int,
    notice: ReachabilityNotice | None = None,
) -> Outcome:
    """The outcome in words, made elsewhere where slow. `notice`: about the road afterwards."""
    run, narrator, work = session.run, session.narrator, session.services.work
    told = partial(make_outcome, narrator, run, utterance, facts, sequence, notice)
    timelines = question_timelines(facts)
    if any(uses_external_planner(timeline) for timeline in timelines):
        slow = is_slow_to_answer(run.config.planner, facts)
        return await run_in_thread(True, QUESTION_S, told) if slow else told()
    if not timelines:
        return told()
    units = answer_units(run, facts)
    if units <= THREAD:
        return await work.run(units, told)
    facts = tuple(
        replace(fact, talk=fact.talk.for_transfer()) if isinstance(fact, Asked) else fact for fact in facts
    )
    return await work.run(units, make_outcome, narrator, run, utterance, facts, sequence, notice)
