"""Changes of a session: one utterance at a time, all of it or nothing.

The order of a change: perform all actions on a copy, store, publish, acknowledge. While the store is waited
for, the clock does not tick this session. A change that began is finished even if the client disconnects.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

import structlog

from service.actions.table import traits_of
from service.problems import NotSaved, UnknownSession
from service.server_timing import part as timed
from service.sessions.event_feed import CHANGED, Told, narrate_parts
from service.sessions.facts import Fact, merge_views, parts_with_events, performed_actions
from service.sessions.latest_decision import LatestDecision
from service.sessions.outcome import make_entry
from service.sessions.part import SessionPart
from service.sessions.perform import perform_actions, tell_outcome
from service.sessions.permission import as_it_stands
from service.sessions.preconditions import NO_PRECONDITIONS, Preconditions
from service.sessions.started_jobs import forget_jobs, start_jobs
from service.sessions.transaction import Flag, Transaction, check_step_ticks
from service.sessions.utterance import Outcome, ReachabilityNotice, Utterance
from service.store import StoredResponse, StoreError
from sim.events import Event
from sim.explain.summary import long_to_tell
from sim.session.timeline import Timeline
from sim.state import StepResult

if TYPE_CHECKING:
    from service.sessions.session import Session

_LOG = structlog.get_logger(__name__)

MAX_STREAMED_TICKS = 8
"""Steps of up to so many ticks are published tick by tick."""


class Changes(SessionPart):
    """Performs the changes of one session in turn. All methods are for the event loop's thread."""

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        self._lock = asyncio.Lock()

    @property
    def busy(self) -> bool:
        """Whether a change is under way."""
        return self._lock.locked()

    @asynccontextmanager
    async def locked(self, preconditions: Preconditions = NO_PRECONDITIONS) -> AsyncIterator[None]:
        """Hold the session's lock, so that nothing changes meanwhile. Raises `PreconditionFailed`."""
        async with self._lock:
            preconditions.check(self._session.sequence)
            yield

    async def start(
        self,
        utterance: Utterance | Callable[[Timeline], Utterance],
        dry_run: bool,
        preconditions: Preconditions,
    ) -> Outcome:
        """Perform an utterance in a task that outlives whoever asked. Raises a `ProblemError`."""
        session = self._session
        if isinstance(utterance, Utterance):
            language = utterance.language or session.language
            check_step_ticks(utterance.actions, session.services.settings.max_step_ticks, language)
        abandoned = Flag()
        task = asyncio.ensure_future(
            self.perform(utterance, dry_run=dry_run, preconditions=preconditions, abandoned=abandoned)
        )
        session.tasks.add(task)
        task.add_done_callback(session.tasks.discard)
        try:
            return await asyncio.shield(task)
        except asyncio.CancelledError:
            abandoned.set()  # a search ends with that; anything else is finished all the same
            raise

    async def perform(
        self,
        utterance: Utterance | Callable[[Timeline], Utterance],
        *,
        dry_run: bool,
        preconditions: Preconditions = NO_PRECONDITIONS,
        abandoned: Flag | None = None,
    ) -> Outcome:
        """Perform an utterance, or one made when its turn comes. Raises a `ProblemError`."""
        session = self._session
        async with self._lock:
            if session.closed:
                raise UnknownSession
            preconditions.check(session.sequence)
            if not isinstance(utterance, Utterance):
                utterance = utterance(session.timeline)
            utterance = as_it_stands(utterance, session.timeline)
            session.ticks.hold()
            try:
                transaction = session.begin_transaction(utterance.language)
                transaction.abandoned = abandoned or transaction.abandoned
                with timed("apply"):
                    transaction, facts = await perform_actions(session, transaction, utterance)
                if dry_run:
                    return await self._tell_dry_run(transaction, utterance, facts)
                return await self._keep(transaction, utterance, facts, preconditions)
            finally:
                session.ticks.let_go()

    async def _tell_dry_run(
        self, transaction: Transaction, utterance: Utterance, facts: tuple[Fact, ...]
    ) -> Outcome:
        session = self._session
        seen = await session.reachability.after_change(transaction.timeline.state, facts)
        event = None if seen is None else session.reachability.event_for(seen, transaction.timeline.state)
        return await tell_outcome(
            session, utterance, facts, session.sequence, self._notice(event, transaction)
        )

    async def _keep(
        self,
        transaction: Transaction,
        utterance: Utterance,
        facts: tuple[Fact, ...],
        preconditions: Preconditions,
    ) -> Outcome:
        """Store and publish what was performed, or only tell it where it changes nothing."""
        session = self._session
        jobs, language = session.services.jobs, utterance.language or session.language
        facts = await start_jobs(jobs, facts, language, session.id)
        state = transaction.timeline.state
        seen = await session.reachability.after_change(state, facts)
        event = None if seen is None else session.reachability.event_for(seen, state)
        if not any(traits_of(action).changes_session for action in utterance.actions):
            outcome = await tell_outcome(session, utterance, facts, session.sequence)
            session.conversation.record(outcome, transient=True)
            if views := merge_views(facts):
                session.feed.publish_change(utterance.text, outcome.reply, (), (), views)
            return outcome
        notice = self._notice(event, transaction)
        outcome = await tell_outcome(session, utterance, facts, session.sequence + 1, notice)
        told = await self._tell_events(outcome)
        try:
            with timed("store"):
                await self._store(outcome, transaction, preconditions)
        except NotSaved:
            await forget_jobs(jobs, facts)
            raise
        if seen is not None:
            session.reachability.remember(seen)
        self._commit(transaction, outcome, told)
        return outcome

    def _notice(self, event: Event | None, transaction: Transaction) -> ReachabilityNotice | None:
        if event is None:
            return None
        run = transaction.timeline.state
        return ReachabilityNotice(event, self._session.narrator.event(event, run), run)

    async def _tell_events(self, outcome: Outcome) -> list[Told]:
        """The events of each part of an outcome in words, made in a thread where that takes long."""
        session, parts = self._session, parts_with_events(outcome.facts)
        if any(part.events and long_to_tell(run) for run, part in parts):
            return await session.services.work.in_thread(narrate_parts, session.narrator, parts)
        return narrate_parts(session.narrator, parts)

    async def _store(self, outcome: Outcome, transaction: Transaction, preconditions: Preconditions) -> None:
        session = self._session
        store, position = session.services.store, session.log_position
        kept = await self._answer_to_keep(outcome, preconditions)
        entry = make_entry(outcome, session.timeline.tick, transaction)
        if session.paused != position.paused:
            entry = replace(entry, paused=session.paused)
        try:
            if transaction.timeline.tick < session.timeline.tick:
                # First: where time once stood must never be run on to from a log that has gone back.
                await store.save_ticks({session.id: transaction.timeline.tick})
            await store.append(session.id, entry, *kept)
        except StoreError as error:
            _LOG.error("a change was not saved", session=session.id, error=str(error))
            raise NotSaved from error
        position.append(entry)

    async def _answer_to_keep(
        self, outcome: Outcome, preconditions: Preconditions
    ) -> tuple[StoredResponse, ...]:
        """The answer to store with the change, made in a thread where it tells many ticks."""
        if preconditions.answer is None:
            return ()
        if len(outcome.ticks) > MAX_STREAMED_TICKS:
            return (await self._session.services.work.in_thread(preconditions.answer, outcome),)
        return (preconditions.answer(outcome),)

    def _commit(self, transaction: Transaction, outcome: Outcome, told: list[Told]) -> None:
        """Take over a transaction's state and publish the outcome; `told`: its events in words."""
        session = self._session
        before, began = session.run, session.timeline.tick
        if transaction.playback_speed != session.playback_speed:
            session.services.clock.remove(session)  # the turn it waits for is at the old speed
        step = transaction.undo_stack.is_step_after(session.undo_stack)
        actions = performed_actions(outcome.utterance.actions, outcome.facts)
        session.adopt(transaction, outcome.sequence, actions)
        session.latest = LatestDecision.of_steps(outcome)
        session.set_paused(transaction.paused)
        session.conversation.record(outcome, step=step)
        feed = session.feed
        lines = [feed.log_line(began, CHANGED, outcome.done, transient=False)]
        playing = outcome.only_steps and len(outcome.ticks) <= MAX_STREAMED_TICKS
        for (run, part), narrated in zip(parts_with_events(outcome.facts), told, strict=True):
            noted = feed.write(narrated)
            if isinstance(part, StepResult) and playing:
                feed.publish_tick(before, part, noted)
            else:
                lines += noted
            before = run
        if outcome.notice is not None:
            lines.append(feed.log_reachability(outcome.notice))
        text, views = outcome.utterance.text, merge_views(outcome.facts)
        feed.publish_change(text, outcome.reply, outcome.changes, lines, views)
        if session.after_change is not None:
            session.after_change(session)
