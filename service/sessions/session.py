"""A live session: a timeline, its clock, its log and its subscribers.

It is changed by one utterance at a time (`service.sessions.change`) and ticks when its clock says so
(`service.sessions.live_ticks`).
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from contextlib import AbstractAsyncContextManager, suppress
from typing import Any

from service.actions import Action
from service.contract.encode.state import SessionStatus
from service.problems import ProblemError
from service.sessions.change import Changes
from service.sessions.conversation import Conversation
from service.sessions.dry_run import is_possible
from service.sessions.event_feed import EventFeed
from service.sessions.fork import ForkPoint, is_partly_of_world
from service.sessions.latest_decision import LatestDecision
from service.sessions.live_ticks import LiveTicks
from service.sessions.pending import PendingQuestion, Talk
from service.sessions.persistence.log_position import LogPosition
from service.sessions.preconditions import NO_PRECONDITIONS, Preconditions
from service.sessions.reachability import ReachabilityMonitor
from service.sessions.scheduler.live_decision import is_dear_to_decide
from service.sessions.scheduler.playback_speed import (
    NORMAL,
    PlaybackSpeed,
    period_s,
)
from service.sessions.services import SessionServices
from service.sessions.state_cache import StateCache
from service.sessions.transaction import Transaction
from service.sessions.undo_stack import UndoStack
from service.sessions.utterance import Outcome, Utterance
from service.sessions.worker_calls import decision_before
from service.store import SessionRecord
from service.work.units import move_units, state_tick_units
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.state import SimState


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
        self.reachability = ReachabilityMonitor(self.feed.present, self.feed.announce_reachability)
        self._state_cache = StateCache()
        self.latest: LatestDecision | None = None
        """the decision that led to the present state, where it is known"""
        self.services = services
        self.narrator = services.narrator.in_language(record.language)
        self.closed = False
        self.tasks: set[asyncio.Task[Any]] = set()
        """what is under way on this session, whoever waits for it"""
        self.changes = Changes(self)
        self.ticks = LiveTicks(self)

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
        if self.latest is None or self.latest.key != (self.sequence, tick):
            run = self.timeline.at(tick - 1)
            if is_dear_to_decide(run):
                return None
            self.latest = LatestDecision((self.sequence, tick), run, self.timeline.decided(run))
        decision = self.latest.decision
        return None if decision is None else (decision, self.latest.state)

    async def load_latest_decision(self) -> None:
        """Take the decision that led to the present state anew where it is dear and not known any more."""
        tick, timeline = self.timeline.tick, self.timeline.copy()
        key = self.sequence, tick
        if not tick or (self.latest is not None and self.latest.key == key):
            return
        if is_dear_to_decide(timeline.state):
            units = state_tick_units(timeline.state) + timeline.work_to(tick - 1) * move_units(timeline.state)
            with suppress(ProblemError):  # whoever asked gets the rest without it
                run, decision = await self.services.work.run(units, decision_before, timeline)
                self.latest = LatestDecision(key, run, decision)

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
        self.ticks.run()

    def tick_failed(self, error: Exception) -> None:
        """Pause and log a defect of the rules, rather than fail twice a second."""
        self.ticks.fail(error)

    @property
    def busy(self) -> bool:
        """Whether work is under way on this session."""
        return self.changes.busy or bool(self.tasks) or self.feed.narrating

    def retire(self) -> None:
        """Stop for good, at once; whoever holds the session must ask the manager for it again."""
        self.closed = True
        self.ticks.cancel()
        self.services.clock.remove(self)

    async def close(self) -> None:
        """Stop for good, after the change under way; later changes raise `UnknownSession`."""
        async with self.changes.locked():
            self.closed = True
            self.ticks.cancel()
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

    def locked(self, preconditions: Preconditions) -> AbstractAsyncContextManager[None]:
        """Hold the session's lock, so that nothing changes meanwhile. Raises `PreconditionFailed`."""
        return self.changes.locked(preconditions)

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
        return await self.changes.start(utterance, dry_run, preconditions)

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

    def start_from(self, way: ForkPoint) -> None:
        """Start from a fork point; for a session that nobody else has yet."""
        self.timeline, self.undo_stack = way.timeline, way.undo_stack(self.paused)
        self.sequence = way.branch.sequence
