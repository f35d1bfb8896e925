"""A live session: a timeline, its pause, its log and its watchers, changed one utterance at a time.

The order of a change: try all actions on a copy → store → publish → acknowledge. While the store
is waited for the clock does not tick this session; a tick that came due meanwhile is taken after.
A change that was begun is finished even when whoever asked for it has gone.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import structlog
from anyio import to_thread

from service.actions import Action, Advise, Ask, Hide, Show
from service.contract.encode.state import Standing, state_json
from service.problems import NotSaved, UnknownName, UnknownSession
from service.server_timing import part as timed
from service.sessions.bookmarks import told_where
from service.sessions.conversation import Conversation
from service.sessions.dry_run import possible
from service.sessions.facts import Fact, asked_about, happened_in, views_of
from service.sessions.fork import Way, is_mixed
from service.sessions.log import Log, LogEvent
from service.sessions.messages import changed_message, tick_message
from service.sessions.narrator_protocol import Words
from service.sessions.outcome import entry_of, long_to_answer, outcome_of
from service.sessions.persistence.log_position import Footing
from service.sessions.preconditions import ANY_TERMS, Terms
from service.sessions.reachability import Outlooks
from service.sessions.scheduler.background_task import Later
from service.sessions.scheduler.clock import Clock
from service.sessions.scheduler.external_planner import Asking
from service.sessions.scheduler.offload import QUESTION_S, STEPS_S, asks_others, names_another, off_loop
from service.sessions.scheduler.playback_speed import NORMAL, Pace, hurried, period_s, turn
from service.sessions.scheduler.tick_batch import Stages
from service.sessions.subscribers import Watchers
from service.sessions.transaction import Draft, check_ticks
from service.sessions.undo_stack import History
from service.sessions.utterance import Notice, Outcome, Utterance
from service.settings import Settings
from service.store import SessionRecord, Store, StoreError
from sim.actions import SetMode
from sim.events import Event
from sim.explain.summary import long_to_tell
from sim.plan import Decision
from sim.session.edits import Applied, Change
from sim.session.timeline import PlannerSilentError, Timeline
from sim.state import SimState, StepResult
from sim.types import Mode

_LOG = structlog.get_logger(__name__)

CHANGES_NOTHING = Ask | Advise | Show | Hide
"""Actions that leave the session as it is, and are not kept when nothing else is said with them."""

THREAD_TICKS = 200
"""Work of more ticks than this is done beside the event loop."""

PLAYED_TICKS = 8
"""Steps of up to so many ticks are shown to watchers tick by tick."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What a session needs around it."""

    store: Store
    clock: Clock
    words: Words
    settings: Settings


class Session:
    """One live session. All methods are for the event loop's thread."""

    def __init__(self, record: SessionRecord, timeline: Timeline, around: Surroundings) -> None:
        self.record = record
        self.timeline = timeline
        self.paused = record.paused
        self.pace: Pace = NORMAL
        self.sequence = 0
        self.history = History()
        self.mixed: set[int] = set()
        """changes of which the timeline has a part only: the others were no changes of the road"""
        self.conversation = Conversation()
        self.footing = Footing(record)
        self.after_change: Callable[[Session], None] | None = None
        self.log = Log(around.settings.log_events)
        self.watchers = Watchers()
        self.stages = Stages(self.watchers)
        self._later = Later(self._write_late)
        self._asking = Asking(self._planned)
        self.outlooks = Outlooks(lambda: self.run, self._tell_outlook)
        self._around = around
        self.words = around.words.in_language(record.language)
        self._turn = asyncio.Lock()
        self._changing = False
        self._tick_due = False
        self._ended = False
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
        """The present state."""
        return self.timeline.state

    @property
    def standing(self) -> Standing:
        """What of the session is not in its run."""
        steps, undone = self.history.steps, len(self.history.undone)
        return Standing(self.id, self.paused, self.sequence, self.pace, steps, undone)

    @property
    def period_s(self) -> float:
        """Seconds from one turn of the clock to the next."""
        return period_s(self.pace, self.timeline.state.config.step_seconds)

    def state(self) -> dict[str, Any]:
        """The present state as JSON values."""
        return state_json(self.standing, self.run)

    def latest_decision(self) -> tuple[Decision, SimState] | None:
        """The decision that led to the present state, and the state it was taken in."""
        return self.decision_at(self.timeline.tick - 1) if self.timeline.tick else None

    def decision_at(self, tick: int) -> tuple[Decision, SimState] | None:
        """The decision taken at a past tick, and the state it was taken in; None while a result stood."""
        run = self.timeline.at(tick)
        decision = self.timeline.decided(run)
        return None if decision is None else (decision, run)

    # Time

    def set_paused(self, paused: bool) -> None:
        """Stand still or go on; the clock is told."""
        self.paused = paused
        if paused:
            self._around.clock.remove(self)
        else:
            self._around.clock.add(self)

    def tick(self) -> None:
        """One turn of the clock: a tick, or several where they follow each other in no time."""
        if self._changing:
            self._tick_due = True
            return
        for _ in turn(self.pace, self.timeline.state.config.step_seconds):
            # In real time the words of an ending are done by the next tick; in a hurry they are waited for.
            if self._changing or self.paused or (self._later.busy and hurried(self.pace)):
                return
            if self._asking.busy or self._asking.begin(self.timeline.state):
                return  # a planner of another package decides this one, and nobody waits for it here
            self._tick_once()

    def _planned(self, run: SimState, decision: Decision) -> None:
        """A planner of another package has decided, or has not in time."""
        if self._ended or self._changing or self.paused or self.timeline.state is not run:
            return  # asked anew when its turn comes
        try:
            self._tick_once(decision)
        except Exception as error:
            self._around.clock.remove(self)
            self.tick_failed(error)

    def _tick_once(self, decided: Decision | None = None) -> None:
        before = self.timeline.state
        try:
            tick = self.timeline.advance(decided)
        except PlannerSilentError as silence:
            self._hand_over(silence)
            return
        if tick.events and long_to_tell(tick.state):
            self._later.begin(lambda: self._worded(tick.state, tick))
            self._publish_tick(before, tick, ())
        else:
            self._publish_tick(before, tick, self._note(tick.state, tick))
        if tick.events and tick.state.world.episode_tick == 0:
            self.outlooks.begun(tick.state)

    def _hand_over(self, silence: PlannerSilentError) -> None:
        """Let a person drive, as a change like any other: a replay does not ask that planner again."""
        self._changing = True  # no tick until it is done
        text = self.words.silent(silence.planner, silence.fault)
        task = asyncio.ensure_future(self._handed_over(text))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _handed_over(self, text: str) -> None:
        await self._change(Utterance(actions=(SetMode(mode=Mode.MANUAL),)), dry_run=False)
        self._publish_changed(None, text, (), [self._line(self.timeline.tick, "event", text)])

    def tick_failed(self, error: Exception) -> None:
        """A defect of the world's rules: stand still and say so, rather than fail twice a second."""
        _LOG.error("session paused after a failed tick", session=self.id, error=repr(error))
        self.paused = True
        line = self._line(self.timeline.tick, "failed", self.words.failed())
        self._publish_changed(None, line.text, (), [line])

    @property
    def busy(self) -> bool:
        """Whether something is being done to it just now."""
        return self._turn.locked() or bool(self._tasks) or self._later.busy

    def retire(self) -> None:
        """Stand still for good; whoever still holds it must ask for the session anew."""
        self._ended = True
        self._around.clock.remove(self)

    async def end(self) -> None:
        """Stand still for good, once the change under way is done; later changes find no session."""
        async with self._turn:
            self._ended = True
            self.set_paused(True)

    def tell(self, kind: str, text: str | None, reply: str) -> None:
        """Tell watchers of something that changed nothing in the session itself."""
        self._publish_changed(text, reply, (), [self._line(self.timeline.tick, kind, reply)])

    # Change

    def possible(self, actions: tuple[Action, ...]) -> bool:
        """Whether these would be done, and change something; long work is taken to be possible."""
        return possible(self._draft(), self.sequence, actions)

    def _draft(self, language: str | None = None) -> Draft:
        return Draft(self.timeline, self.paused, self.history, self.pace, language or self.language)

    @asynccontextmanager
    async def held(self, terms: Terms) -> AsyncIterator[None]:
        """Nothing is changed by anyone meanwhile. Raises `Stale`."""
        async with self._turn:
            terms.check(self.sequence)
            yield

    async def change(
        self,
        utterance: Utterance | Callable[[Timeline], Utterance],
        *,
        dry_run: bool = False,
        terms: Terms = ANY_TERMS,
    ) -> Outcome:
        """Do an utterance, or one made once it is its turn, all or nothing.

        Raises a `ProblemError`; the session is then as it was.
        """
        if isinstance(utterance, Utterance):
            language = utterance.language or self.language
            check_ticks(utterance.actions, self._around.settings.max_step_ticks, language)
        task = asyncio.ensure_future(self._change(utterance, dry_run, terms))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return await asyncio.shield(task)

    async def _change(
        self,
        utterance: Utterance | Callable[[Timeline], Utterance],
        dry_run: bool,
        terms: Terms = ANY_TERMS,
    ) -> Outcome:
        async with self._turn:
            if self._ended:
                raise UnknownSession
            terms.check(self.sequence)
            if not isinstance(utterance, Utterance):
                utterance = utterance(self.timeline)
            self._changing = True
            try:
                draft = self._draft(utterance.language)
                with timed("apply"):
                    facts = await self._perform(draft, utterance)
                seen = await self.outlooks.after(draft.timeline.state, facts)
                event = None if seen is None else self.outlooks.notice(seen, draft.timeline.state)
                if dry_run:
                    return await self._told(utterance, facts, self.sequence, event, draft)
                if all(isinstance(action, CHANGES_NOTHING) for action in utterance.actions):
                    outcome = await self._told(utterance, facts, self.sequence)
                    self.conversation.note(outcome, passing=True)
                    if views := views_of(facts):
                        self._publish_changed(utterance.text, outcome.reply, (), (), views)
                    return outcome
                outcome = await self._told(utterance, facts, self.sequence + 1, event, draft)
                with timed("store"):
                    await self._save(outcome, draft, terms)
                if seen is not None:
                    self.outlooks.know(seen)
                self._become(draft, outcome)
                return outcome
            finally:
                self._changing = False
                self._take_tick_due()

    async def _perform(self, draft: Draft, utterance: Utterance) -> tuple[Fact, ...]:
        actions = utterance.actions
        sequence = self.sequence + 1
        try:
            if draft.asks_others(actions):
                foreign = asks_others(draft.timeline) or names_another(actions)
                return await off_loop(foreign, STEPS_S, partial(draft.perform, sequence, actions))
            if draft.work_ticks(actions) > THREAD_TICKS:
                return await to_thread.run_sync(draft.perform, sequence, actions)
            return draft.perform(sequence, actions)
        except UnknownName as problem:
            raise await told_where(
                self._around.store, problem, utterance.actions, utterance.language or self.language
            ) from None

    async def _told(
        self,
        utterance: Utterance,
        facts: tuple[Fact, ...],
        sequence: int,
        event: Event | None = None,
        draft: Draft | None = None,
    ) -> Outcome:
        """The outcome in words; beside the event loop where that takes long. `event`: of the draft's road."""
        notice = None
        if event is not None and draft is not None:
            run = draft.timeline.state
            notice = Notice(event, self.words.event(event, run), run)
        told = partial(outcome_of, self.words, self.run, utterance, facts, sequence, notice)
        if not long_to_answer(self.run.config.planner, facts):
            return told()
        return await off_loop(any(asks_others(timeline) for timeline in asked_about(facts)), QUESTION_S, told)

    async def _save(self, outcome: Outcome, draft: Draft, terms: Terms) -> None:
        kept = () if terms.answer is None else (terms.answer(outcome),)
        entry = entry_of(outcome, self.timeline.tick, draft)
        if self.paused != self.footing.paused:
            entry = replace(entry, paused=self.paused)
        try:
            if draft.timeline.tick < self.timeline.tick:
                # First: where time once stood must never be run on to from a log that has gone back.
                await self._around.store.save_ticks({self.id: draft.timeline.tick})
            await self._around.store.append(self.id, entry, *kept)
        except StoreError as error:
            _LOG.error("a change was not saved", session=self.id, error=str(error))
            raise NotSaved from error
        self.footing.kept(entry)

    def _become(self, draft: Draft, outcome: Outcome) -> None:
        """Take the draft's state and tell watchers."""
        before, began = self.run, self.timeline.tick
        if draft.pace != self.pace:
            self._around.clock.remove(self)  # the turn it waits for is at the old speed
        self.adopt(draft, outcome.sequence, outcome.utterance.actions)
        self.set_paused(draft.paused)
        self.conversation.note(outcome)
        lines = [self._line(began, "changed", outcome.done, passing=False)]
        playing = outcome.only_steps and len(outcome.ticks) <= PLAYED_TICKS
        for run, part in happened_in(outcome.facts):
            noted = self._note(run, part)
            if isinstance(part, StepResult) and playing:
                self._publish_tick(before, part, noted)
            else:
                lines += noted
            before = run
        if outcome.notice is not None:
            lines.append(self._outlook_line(outcome.notice))
        text, views = outcome.utterance.text, views_of(outcome.facts)
        self._publish_changed(text, outcome.reply, outcome.changes, lines, views)
        if self.after_change is not None:
            self.after_change(self)

    def adopt(self, draft: Draft, sequence: int, actions: Sequence[Action]) -> None:
        """Take a draft's state, made by these actions; for who has the session to itself."""
        if is_mixed(actions):
            self.mixed.add(sequence)
        self.timeline, self.history = draft.timeline, draft.history
        self.paused, self.pace, self.sequence = draft.paused, draft.pace, sequence
        self.footing.become(draft.paused, draft.timeline.tick)

    def _take_tick_due(self) -> None:
        if self._tick_due:
            self._tick_due = False
            if not self.paused:
                self.tick()

    def begin_with(self, way: Way) -> None:
        """Begin where another session's log has led to; for a session that nobody else has yet."""
        self.timeline, self.history = way.timeline, way.history(self.paused)
        self.sequence = way.branch.sequence

    # Telling

    def _note(self, run: SimState, part: Applied | StepResult) -> list[LogEvent]:
        """Write the events of a tick or an action to the log."""
        self._later.settle()
        return self._write(self._worded(run, part)) if part.events else []

    def _worded(self, run: SimState, part: Applied | StepResult) -> list[tuple[Event, str]]:
        return [(event, self.words.event(event, run)) for event in part.events]

    def _write(self, worded: list[tuple[Event, str]]) -> list[LogEvent]:
        return [self.log.add(event.tick, event.type, text, event.ids, event.cell) for event, text in worded]

    def _write_late(self, worded: list[tuple[Event, str]]) -> None:
        """Lines that were worded beside the clock, told as soon as they are there."""
        lines = self._write(worded)
        self._publish_changed(None, lines[-1].text, (), lines)

    def _tell_outlook(self, event: Event) -> None:
        """That a road which began by itself has no way through; once that is found out."""
        if not self._ended:
            line = self._outlook_line(Notice(event, self.words.event(event, self.run), self.run))
            self._publish_changed(None, line.text, (), [line])

    def _outlook_line(self, notice: Notice) -> LogEvent:
        self._later.settle()
        event = notice.event
        return self.log.add(event.tick, event.type, notice.text, event.ids, passing=True)

    def _line(self, tick: int, kind: str, text: str, *, passing: bool = True) -> LogEvent:
        self._later.settle()
        return self.log.add(tick, kind, text, passing=passing)

    def _publish_tick(self, before: SimState, tick: StepResult, lines: Sequence[LogEvent]) -> None:
        def message() -> bytes:
            decision = tick.decision
            taken, words = tick.of(), self.words
            narration = None if taken is None else words.decision(taken.decision, before, taken.forecast)
            return tick_message(
                self.sequence, lambda: self.standing, before, tick.state, decision, narration, lines
            )

        self.stages.tick(tick.state.world.tick, message)

    def _publish_changed(
        self,
        text: str | None,
        reply: str,
        changes: Sequence[Change],
        lines: Sequence[LogEvent],
        views: Mapping[str, bool] | None = None,
    ) -> None:
        def message() -> bytes:
            return changed_message(self.standing, self.run, text, reply, changes, lines, views)

        self.stages.now(self.timeline.tick, message)
