"""A live session: a timeline, its clock, its log and its subscribers, changed by one utterance at a time.

The order of a change: perform all actions on a copy, store, publish, acknowledge. While the store is waited
for, the clock does not tick this session; a tick that becomes due meanwhile is run afterwards. A change that
began is finished even if the client disconnects.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from contextlib import asynccontextmanager, suppress
from dataclasses import replace
from functools import partial
from threading import Event
from typing import Any

import structlog

from service.actions import Action
from service.actions.table import traits_of
from service.contract.encode.state import SessionStatus
from service.evaluations.start import start_evaluation, talk_of_evaluation
from service.problems import NotSaved, ProblemError, UnknownName, UnknownSession
from service.server_timing import part as timed
from service.sessions.bookmarks import add_other_session
from service.sessions.conversation import Conversation
from service.sessions.dry_run import is_possible
from service.sessions.event_feed import CHANGED, EventFeed
from service.sessions.facts import (
    Asked,
    Fact,
    JobAsked,
    JobTold,
    merge_views,
    parts_with_events,
    performed_actions,
    question_timelines,
)
from service.sessions.fork import ForkPoint, is_partly_of_world
from service.sessions.latest_decision import LatestDecision
from service.sessions.outcome import is_slow_to_answer, make_entry, make_outcome
from service.sessions.pending import PendingQuestion, Talk
from service.sessions.persistence.log_position import LogPosition
from service.sessions.preconditions import NO_PRECONDITIONS, Preconditions
from service.sessions.reachability import ReachabilityMonitor
from service.sessions.scheduler.external_planner import ExternalPlanner
from service.sessions.scheduler.live_decision import LiveDecision, is_dear_to_decide
from service.sessions.scheduler.offload import (
    QUESTION_S,
    STEPS_S,
    names_external_planner,
    run_in_thread,
    uses_external_planner,
)
from service.sessions.scheduler.playback_speed import (
    NORMAL,
    PlaybackSpeed,
    is_accelerated,
    period_s,
    ticks_of_turn,
)
from service.sessions.services import SessionServices
from service.sessions.state_cache import StateCache
from service.sessions.transaction import Transaction, check_step_ticks
from service.sessions.undo_stack import UndoStack
from service.sessions.utterance import Outcome, ReachabilityNotice, Utterance
from service.sessions.work_estimate import answer_units, transaction_units
from service.sessions.worker_calls import Performed, decision_before, perform, perform_for_transfer
from service.store import SessionRecord, StoredResponse, StoreError
from service.work.units import THREAD, move_units, state_tick_units
from sim.actions import SetMode
from sim.events import Event as RoadEvent
from sim.explain.summary import long_to_tell
from sim.plan import Decision
from sim.session.timeline import PlannerSilentError, Timeline
from sim.session.triggers import pauses
from sim.state import SimState, StepResult
from sim.types import Mode

_LOG = structlog.get_logger(__name__)

MAX_STREAMED_TICKS = 8
"""Steps of up to so many ticks are published tick by tick."""


class Session:
    """One live session. All methods are for the event loop's thread."""

    def __init__(self, record: SessionRecord, timeline: Timeline, services: SessionServices) -> None:
        self.record = record
        self.timeline = timeline
        self.paused = record.paused
        self.playback_speed: PlaybackSpeed = NORMAL
        self.sequence = 0
        self.undo_stack = UndoStack()
        self.partial_changes: set[int] = set()
        """changes of which the log of the road has only some actions"""
        self.conversation = Conversation()
        self.pending: PendingQuestion | None = None
        """the question that the service asked last, while it waits for an answer"""
        self.log_position = LogPosition(record)
        self.after_change: Callable[[Session], None] | None = None
        self.feed = EventFeed(self, services.settings.log_events)
        self.log = self.feed.log
        self.subscribers = self.feed.subscribers
        self.tick_batch = self.feed.tick_batch
        self._external_planner = ExternalPlanner(self._on_decision)
        self._live_decision = LiveDecision(services.work.live, self._on_decision, self._on_no_decision)
        self.reachability = ReachabilityMonitor(lambda: self.run, self.feed.announce_reachability)
        self._state_cache = StateCache()
        self._latest: LatestDecision | None = None
        self.services = services
        self.narrator = services.narrator.in_language(record.language)
        self._lock = asyncio.Lock()
        self._changing = False
        self._tick_due = False
        self.closed = False
        self._tasks: set[asyncio.Task[Any]] = set()

    def __str__(self) -> str:
        return f"session {self.record.id}"

    @property
    def id(self) -> str:
        """The session's unguessable id."""
        return self.record.id

    @property
    def language(self) -> str:
        """The code of the language that its log and narration are in."""
        return self.record.language

    @property
    def run(self) -> SimState:
        """The present state of the simulation."""
        return self.timeline.state

    @property
    def status(self) -> SessionStatus:
        """What the state message says beside the simulation: id, pause, sequence, speed, undo and redo."""
        steps, undone = self.undo_stack.steps, len(self.undo_stack.undone)
        rules = self.narrator.rules(self.run) if self.run.triggers else ()
        return SessionStatus(
            self.id, self.paused, self.sequence, self.playback_speed, steps, undone, tuple(rules)
        )

    @property
    def period_s(self) -> float:
        """Seconds from one turn of the clock to the next."""
        return period_s(self.playback_speed, self.timeline.state.config.step_seconds)

    def state_body(self) -> bytes:
        """The present state as JSON text, encoded once for as long as it stands."""
        return self._state_cache.encode(self.run, self.status)

    def latest_decision(self) -> tuple[Decision, SimState] | None:
        """The decision that led to the present state, and the state it was taken in.

        None also where taking it anew would be dear: `load_latest_decision` does that.
        """
        tick = self.timeline.tick
        if not tick:
            return None
        if self._latest is None or self._latest.key != (self.sequence, tick):
            run = self.timeline.at(tick - 1)
            if is_dear_to_decide(run):
                return None
            self._latest = LatestDecision((self.sequence, tick), run, self.timeline.decided(run))
        decision = self._latest.decision
        return None if decision is None else (decision, self._latest.state)

    async def load_latest_decision(self) -> None:
        """Take the decision that led to the present state anew where it is dear and not known any more."""
        tick, timeline = self.timeline.tick, self.timeline.copy()
        key = self.sequence, tick
        if not tick or (self._latest is not None and self._latest.key == key):
            return
        if is_dear_to_decide(timeline.state):
            units = state_tick_units(timeline.state) + timeline.work_to(tick - 1) * move_units(timeline.state)
            with suppress(ProblemError):  # whoever asked gets the rest without it
                run, decision = await self.services.work.run(units, decision_before, timeline)
                self._latest = LatestDecision(key, run, decision)

    def decision_at(self, tick: int) -> tuple[Decision, SimState] | None:
        """The decision at a past tick and the state it was taken in; None while a result stood."""
        run = self.timeline.at(tick)
        decision = self.timeline.decided(run)
        return None if decision is None else (decision, run)

    # Time

    def set_paused(self, paused: bool) -> None:
        """Pause or resume, on the clock as well."""
        self.paused = paused
        if paused:
            self.services.clock.remove(self)
        else:
            self.services.clock.add(self)

    def tick(self) -> None:
        """Run one turn of the clock: one tick, or several at high speed."""
        if self._changing:
            self._tick_due = True
            return
        for _ in ticks_of_turn(self.playback_speed, self.timeline.state.config.step_seconds):
            # In real time the words of an ending are done by the next tick; in a hurry they are waited for.
            if self._changing or self.paused or (self.feed.narrating and is_accelerated(self.playback_speed)):
                return
            if self._external_planner.busy or self._external_planner.ask(self.timeline.state):
                return  # a planner of another package decides this one, and nobody waits for it here
            if self._live_decision.busy:
                self._say_slowed()
                return
            if self._live_decision.ask(self.timeline.state):
                return
            self._tick_once()

    def _say_slowed(self) -> None:
        """Say once that time runs slower than it should, since decisions take longer than a tick."""
        decision = self._live_decision
        if not decision.slowed:
            decision.slowed = True
            line = self.feed.log_line(self.timeline.tick, "slowed", self.narrator.slowed())
            self.feed.publish_change(None, line.text, (), [line])

    def _on_no_decision(self, run: SimState, fault: str) -> None:
        """Switch to manual driving where the session's own planner did not answer in time."""
        if not (self.closed or self._changing or self.paused) and self.timeline.state is run:
            self._start_manual_override(PlannerSilentError(run.config.planner, fault))

    def _on_decision(self, run: SimState, decision: Decision | Mapping[str, Decision]) -> None:
        """Tick with the decision of an external planner, or with its fallback."""
        if self.closed or self._changing or self.paused or self.timeline.state is not run:
            return  # asked anew when its turn comes
        try:
            self._tick_once(decision)
        except Exception as error:
            self.services.clock.remove(self)
            self.tick_failed(error)

    def _tick_once(self, decided: Decision | Mapping[str, Decision] | None = None) -> None:
        before = self.timeline.state
        try:
            tick = self.timeline.advance(decided)
        except PlannerSilentError as silence:
            self._start_manual_override(silence)
            return
        self._latest = LatestDecision((self.sequence, self.timeline.tick), before, tick.decision)
        if tick.events and long_to_tell(tick.state):
            self.feed.narrate_in_thread(tick.state, tick)
            self.feed.publish_tick(before, tick, ())
        else:
            self.feed.publish_tick(before, tick, self.feed.log_events(tick.state, tick))
            if tick.events and pauses(tick.events):
                self._pause_by_rule(tick)
        if tick.events and tick.state.world.episode_tick == 0:
            self.reachability.start_road(tick.state)

    def _pause_by_rule(self, tick: StepResult) -> None:
        """Stop the clock since a rule says so; the log has a line of it already."""
        self.set_paused(True)
        text = " ".join(self.narrator.event(event, tick.state) for event in tick.events if pauses((event,)))
        self.feed.publish_change(None, text, (), ())

    def _start_manual_override(self, silence: PlannerSilentError) -> None:
        """Switch to manual driving, by a stored change: a replay does not ask that planner again."""
        self._changing = True  # no tick until it is done
        text = self.narrator.planner_timeout(silence.planner, silence.fault)
        task = asyncio.ensure_future(self._switch_to_manual(text))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _switch_to_manual(self, text: str) -> None:
        await self._change(Utterance(actions=(SetMode(mode=Mode.MANUAL),)), dry_run=False)
        self.feed.publish_change(None, text, (), [self.feed.log_line(self.timeline.tick, "event", text)])

    def tick_failed(self, error: Exception) -> None:
        """Pause and log a defect of the rules, rather than fail twice a second."""
        _LOG.error("session paused after a failed tick", session=self.id, error=repr(error))
        self.paused = True
        line = self.feed.log_line(self.timeline.tick, "failed", self.narrator.failed())
        self.feed.publish_change(None, line.text, (), [line])

    @property
    def busy(self) -> bool:
        """Whether work is under way on this session."""
        return self._lock.locked() or bool(self._tasks) or self.feed.narrating

    def retire(self) -> None:
        """Stop for good, at once; whoever holds the session must ask the manager for it again."""
        self.closed = True
        self._live_decision.cancel()
        self.services.clock.remove(self)

    async def close(self) -> None:
        """Stop for good, after the change under way; later changes raise `UnknownSession`."""
        async with self._lock:
            self.closed = True
            self._live_decision.cancel()
            self.set_paused(True)

    def announce(self, kind: str, text: str | None, reply: str) -> None:
        """Log and publish something that changed nothing in the session itself."""
        self.feed.publish_change(text, reply, (), [self.feed.log_line(self.timeline.tick, kind, reply)])

    # Change

    def is_possible(self, actions: tuple[Action, ...]) -> bool:
        """Whether the actions would succeed now and change something."""
        return is_possible(self.begin_transaction(), self.sequence, actions)

    def begin_transaction(self, language: str | None = None) -> Transaction:
        """A copy to try actions on; `language`: the one in which they are refused (the session's)."""
        language = language or self.language
        talk = Talk(self.pending, self.feed.changes, self.conversation.explained)
        return Transaction(self.timeline, self.paused, self.undo_stack, self.playback_speed, language, talk)

    @asynccontextmanager
    async def locked(self, preconditions: Preconditions) -> AsyncIterator[None]:
        """Hold the session's lock, so that nothing changes meanwhile. Raises `PreconditionFailed`."""
        async with self._lock:
            preconditions.check(self.sequence)
            yield

    async def change(
        self,
        utterance: Utterance | Callable[[Timeline], Utterance],
        *,
        dry_run: bool = False,
        preconditions: Preconditions = NO_PRECONDITIONS,
    ) -> Outcome:
        """Perform an utterance, or one made when its turn comes; all or nothing.

        Raises a `ProblemError`; the session is unchanged then.
        """
        if isinstance(utterance, Utterance):
            language = utterance.language or self.language
            check_step_ticks(utterance.actions, self.services.settings.max_step_ticks, language)
        abandoned = Event()
        task = asyncio.ensure_future(self._change(utterance, dry_run, preconditions, abandoned))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        try:
            return await asyncio.shield(task)
        except asyncio.CancelledError:
            abandoned.set()  # a search ends with that; anything else is finished all the same
            raise

    async def _change(
        self,
        utterance: Utterance | Callable[[Timeline], Utterance],
        dry_run: bool,
        preconditions: Preconditions = NO_PRECONDITIONS,
        abandoned: Event | None = None,
    ) -> Outcome:
        async with self._lock:
            if self.closed:
                raise UnknownSession
            preconditions.check(self.sequence)
            if not isinstance(utterance, Utterance):
                utterance = utterance(self.timeline)
            self._changing = True
            try:
                transaction = self.begin_transaction(utterance.language)
                transaction.abandoned = abandoned or transaction.abandoned
                with timed("apply"):
                    transaction, facts = await self._perform(transaction, utterance)
                facts = facts if dry_run else await self._start_jobs(facts, utterance)
                seen = await self.reachability.after_change(transaction.timeline.state, facts)
                event = (
                    None if seen is None else self.reachability.event_for(seen, transaction.timeline.state)
                )
                if dry_run:
                    return await self._make_outcome(utterance, facts, self.sequence, event, transaction)
                if not any(traits_of(action).changes_session for action in utterance.actions):
                    outcome = await self._make_outcome(utterance, facts, self.sequence)
                    self.conversation.record(outcome, transient=True)
                    if views := merge_views(facts):
                        self.feed.publish_change(utterance.text, outcome.reply, (), (), views)
                    return outcome
                outcome = await self._make_outcome(utterance, facts, self.sequence + 1, event, transaction)
                try:
                    with timed("store"):
                        await self._store(outcome, transaction, preconditions)
                except NotSaved:
                    await self._forget_jobs(facts)
                    raise
                if seen is not None:
                    self.reachability.remember(seen)
                self._commit(transaction, outcome)
                return outcome
            finally:
                self._changing = False
                self._run_due_tick()

    async def _perform(self, transaction: Transaction, utterance: Utterance) -> Performed:
        """The transaction afterwards, another object where a process did it, and the facts."""
        actions, work = utterance.actions, self.services.work
        sequence = self.sequence + 1
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
                self.services.store, problem, utterance.actions, utterance.language or self.language
            ) from None

    async def _start_jobs(self, facts: tuple[Fact, ...], utterance: Utterance) -> tuple[Fact, ...]:
        """Start what is asked for in the background. Raises `NotAvailable`, `QuotaExceeded` or `NotSaved`."""
        started: list[Fact] = []
        language = utterance.language or self.language
        for fact in facts:
            if isinstance(fact, JobAsked):
                fact = await start_evaluation(self.services.jobs, fact, language, self.id)
            elif isinstance(fact, JobTold):
                fact = await talk_of_evaluation(self.services.jobs, fact, self.id)
            started.append(fact)
        return tuple(started)

    async def _forget_jobs(self, facts: tuple[Fact, ...]) -> None:
        """Take back what was started, since nothing of the utterance is done."""
        jobs = self.services.jobs
        for fact in facts:
            if jobs is not None and isinstance(fact, JobAsked) and fact.job is not None:
                with suppress(NotSaved):  # the store does not answer; it is forgotten in memory all the same
                    await jobs.delete(fact.job)

    async def _make_outcome(
        self,
        utterance: Utterance,
        facts: tuple[Fact, ...],
        sequence: int,
        event: RoadEvent | None = None,
        transaction: Transaction | None = None,
    ) -> Outcome:
        """The outcome in words, made in a thread where slow. `event`: about the transaction's road."""
        notice = None
        if event is not None and transaction is not None:
            run = transaction.timeline.state
            notice = ReachabilityNotice(event, self.narrator.event(event, run), run)
        told = partial(make_outcome, self.narrator, self.run, utterance, facts, sequence, notice)
        timelines = question_timelines(facts)
        if any(uses_external_planner(timeline) for timeline in timelines):
            slow = is_slow_to_answer(self.run.config.planner, facts)
            return await run_in_thread(True, QUESTION_S, told) if slow else told()
        if not timelines:
            return told()
        units = answer_units(self.run, facts)
        if units <= THREAD:
            return await self.services.work.run(units, told)
        facts = tuple(
            replace(fact, talk=fact.talk.for_transfer()) if isinstance(fact, Asked) else fact
            for fact in facts
        )
        return await self.services.work.run(
            units, make_outcome, self.narrator, self.run, utterance, facts, sequence, notice
        )

    async def _store(self, outcome: Outcome, transaction: Transaction, preconditions: Preconditions) -> None:
        kept = await self._answer_to_keep(outcome, preconditions)
        entry = make_entry(outcome, self.timeline.tick, transaction)
        if self.paused != self.log_position.paused:
            entry = replace(entry, paused=self.paused)
        try:
            if transaction.timeline.tick < self.timeline.tick:
                # First: where time once stood must never be run on to from a log that has gone back.
                await self.services.store.save_ticks({self.id: transaction.timeline.tick})
            await self.services.store.append(self.id, entry, *kept)
        except StoreError as error:
            _LOG.error("a change was not saved", session=self.id, error=str(error))
            raise NotSaved from error
        self.log_position.append(entry)

    async def _answer_to_keep(
        self, outcome: Outcome, preconditions: Preconditions
    ) -> tuple[StoredResponse, ...]:
        """The answer to store with the change, made in a thread where it tells many ticks."""
        if preconditions.answer is None:
            return ()
        if len(outcome.ticks) > MAX_STREAMED_TICKS:
            return (await self.services.work.in_thread(preconditions.answer, outcome),)
        return (preconditions.answer(outcome),)

    def _commit(self, transaction: Transaction, outcome: Outcome) -> None:
        """Take over a transaction's state and publish the outcome."""
        before, began = self.run, self.timeline.tick
        if transaction.playback_speed != self.playback_speed:
            self.services.clock.remove(self)  # the turn it waits for is at the old speed
        step = transaction.undo_stack.is_step_after(self.undo_stack)
        self.adopt(transaction, outcome.sequence, performed_actions(outcome.utterance.actions, outcome.facts))
        self._latest = LatestDecision.of_steps(outcome)
        self.set_paused(transaction.paused)
        self.conversation.record(outcome, step=step)
        lines = [self.feed.log_line(began, CHANGED, outcome.done, transient=False)]
        playing = outcome.only_steps and len(outcome.ticks) <= MAX_STREAMED_TICKS
        for run, part in parts_with_events(outcome.facts):
            noted = self.feed.log_events(run, part)
            if isinstance(part, StepResult) and playing:
                self.feed.publish_tick(before, part, noted)
            else:
                lines += noted
            before = run
        if outcome.notice is not None:
            lines.append(self.feed.log_reachability(outcome.notice))
        text, views = outcome.utterance.text, merge_views(outcome.facts)
        self.feed.publish_change(text, outcome.reply, outcome.changes, lines, views)
        if self.after_change is not None:
            self.after_change(self)

    def adopt(self, transaction: Transaction, sequence: int, actions: Sequence[Action]) -> None:
        """Take over a transaction's state; for callers that have the session to themselves."""
        if is_partly_of_world(actions):
            self.partial_changes.add(sequence)
        self.timeline, self.undo_stack = transaction.timeline, transaction.undo_stack
        self.paused, self.playback_speed, self.sequence = (
            transaction.paused,
            transaction.playback_speed,
            sequence,
        )
        self.log_position.commit(transaction.paused, transaction.timeline.tick)

    def _run_due_tick(self) -> None:
        if self._tick_due:
            self._tick_due = False
            if not self.paused:
                self.tick()

    def start_from(self, way: ForkPoint) -> None:
        """Start from a fork point; for a session that nobody else has yet."""
        self.timeline, self.undo_stack = way.timeline, way.undo_stack(self.paused)
        self.sequence = way.branch.sequence
