"""Actions tried on a copy: either all of them are possible, or the copy is thrown away.

A `Transaction` is what one utterance would make of a session. It does actions at their place in the
order and answers a fact for each; it becomes the session once the store has the utterance.
Restoring a session and replaying a recording run through here as well, which is why they end in
the same state.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, islice

from service.actions import (
    Action,
    Advise,
    Ask,
    Forget,
    Hide,
    Load,
    Pause,
    Redo,
    Resume,
    Rewind,
    Save,
    Show,
    Teach,
    Undo,
)
from service.actions import Step as StepTicks
from service.problems import DoesNotFit, FieldProblem, Invalid, NotAvailable, NothingToUndo
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions import availability
from service.sessions.bookmarks import MAX_BOOKMARKS, Bookmark, Bookmarked, Jumped, unknown_bookmark
from service.sessions.facts import Advised, Asked, Fact, PauseSet, Stepped, Undone, Viewed
from service.sessions.rewind import TimeJump, rewind_timeline
from service.sessions.scheduler.playback_speed import (
    NORMAL,
    PlaybackSpeed,
    PlaybackSpeedError,
    PlaybackSpeedSet,
    change_playback_speed,
    sets_playback_speed,
)
from service.sessions.undo_stack import UndoStack, UndoStep
from sim.actions import (
    Add,
    Adjust,
    Drive,
    Prefer,
    Remove,
    Reset,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Weather,
    WorldAction,
)
from sim.hazard_advice import NoAdviceError, advise
from sim.planner_names import installed
from sim.session.edits import Change, differences
from sim.session.errors import EditError
from sim.session.timeline import PlannerSilentError, Timeline
from sim.state import SimState
from sim.types import Kind

WORLD_ACTIONS = (Add, Remove, SetCount, Scenario, Reset, SetMode, Drive, Set, Adjust, Prefer)
STEPS = (*WORLD_ACTIONS, Rewind, Load)
"""Actions that are a step to undo."""

_MOVES_TIME = (StepTicks, Undo, Redo, Rewind)
"""Actions for which ticks are run."""

_DECIDES_ANEW = (StepTicks, Undo, Redo)
"""Those for which decisions are taken."""


class Transaction:
    """A session's changeable part, on a copy."""

    def __init__(
        self,
        timeline: Timeline,
        paused: bool,
        history: UndoStack,
        speed: PlaybackSpeed = NORMAL,
        language: str = DEFAULT_LANGUAGE,
    ) -> None:
        """`language`: the one in which actions are refused."""
        self._language = language
        self._refusals = refusals(language)
        self.timeline = timeline.copy()
        self.paused = paused
        self.playback_speed = speed
        self.undo_stack = history.copy()
        self._jumped = False
        self._savepoint = _Savepoint(timeline, paused)

    def perform(self, sequence: int, actions: Sequence[Action]) -> tuple[Fact, ...]:
        """Do the actions of one utterance. Raises a `ProblemError` naming the first that cannot be."""
        began = _Savepoint(self.timeline.copy(), self.paused)
        earlier, self._savepoint = self.undo_stack.copy(), began.copy()
        self._jumped = False
        facts = []
        for position, action in enumerate(actions):
            facts.append(self._do(sequence, position, action))
            began.kept = min(began.kept, self._savepoint.kept)
            began.jumped = began.jumped or self._jumped
        if any(isinstance(action, STEPS) and not sets_playback_speed(action) for action in actions):
            # Whatever it undid on the way, the utterance is one step.
            earlier.bookmarks = self.undo_stack.bookmarks
            self.undo_stack = earlier
            self._add_step(began)
        return tuple(facts)

    def estimate_ticks(self, actions: Sequence[Action]) -> int:
        """About how many ticks are to be run: those of steps, and those since what is undone or redone."""
        if not any(isinstance(action, _MOVES_TIME) for action in actions):
            return 0
        timeline = self.timeline
        undos, redos = (sum(isinstance(action, kind) for action in actions) for kind in (Undo, Redo))
        back = list(islice(self.undo_stack.iter_undoable(timeline.entries), undos))
        # Whether what is redone was undone before or here, it comes last first.
        forth = list(islice(chain(reversed(back), reversed(self.undo_stack.undone)), redos))
        ticks = step_ticks(actions)
        for step in (*back, *forth):
            if step.jump is None and step.since < timeline.tick:
                ticks += timeline.work_since(step.since)
        for action in actions:
            if isinstance(action, Rewind) and action.ticks <= timeline.tick:
                ticks += timeline.work_to(timeline.tick - action.ticks)
        return ticks

    def needs_external_planner(self, actions: Sequence[Action]) -> bool:
        """Whether a planner of another package may have to be asked for these."""
        return bool(installed()) and any(isinstance(action, _DECIDES_ANEW) for action in actions)

    def can_undo_or_redo(self, action: Action) -> bool:
        """Whether there is something to undo or to redo, where that is the action."""
        if isinstance(action, Undo):
            return next(iter(self.undo_stack.iter_undoable(self.timeline.entries)), None) is not None
        return not isinstance(action, Redo) or bool(self.undo_stack.undone)

    def _do(self, sequence: int, position: int, action: Action) -> Fact:
        sentence = availability.refusal_of(action, self._language)
        if sentence is not None:
            raise NotAvailable(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
        match action:
            case Ask():
                return Asked(action, self.timeline.copy())
            case Advise():
                return self._advise(position, action)
            case Show() | Hide():
                return Viewed(action.view, isinstance(action, Show))
            case Pause() | Resume():
                return self._set_paused(isinstance(action, Pause))
            case StepTicks():
                return self._step(action.ticks)
            case Set() | Adjust() if sets_playback_speed(action):
                return self._set_playback_speed(position, action)
            case Undo():
                return self._undo(position)
            case Redo():
                return self._redo(position)
            case Rewind():
                return self._rewind(position, action.ticks)
            case Save():
                return self._save(sequence, position, action.name)
            case Load():
                return self._load(position, action.name)
            case (
                Add()
                | Remove()
                | SetCount()
                | Scenario()
                | Reset()
                | SetMode()
                | Drive()
                | Set()
                | Adjust()
                | Prefer()
            ):
                return self._apply(sequence, position, action)
            case Teach() | Forget():
                sentence = self._refusals.session("alone")
                raise Invalid(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
            case _:
                raise AssertionError(f"{action.do} is offered but nobody does it")

    def _apply(self, sequence: int, position: int, action: WorldAction) -> Fact:
        try:
            (applied,) = self.timeline.apply(sequence, [action])
        except EditError as error:
            sentence = self._refusals.edit(error)
            kind = NotAvailable if error.category == "not-available" else DoesNotFit
            where = f"actions.{position}.{error.field}"
            raise kind(sentence, errors=[FieldProblem(where, sentence)]) from error
        return applied

    def _advise(self, position: int, action: Advise) -> Advised:
        weather: Weather = getattr(self.timeline.state.config, "weather", "clear")
        try:
            advice = advise(Kind(action.hazard), action.distance_m, action.speed_kmh, weather)
        except NoAdviceError as error:
            sentence, where = self._refusals.advice(error), f"actions.{position}.{error.field}"
            raise Invalid(sentence, errors=[FieldProblem(where, sentence)]) from error
        return Advised(advice, self.timeline.tick)

    def _set_paused(self, paused: bool) -> PauseSet:
        before, self.paused = self.paused, paused
        return PauseSet(before, paused, self.timeline.tick)

    def _set_playback_speed(self, position: int, action: Set | Adjust) -> PlaybackSpeedSet:
        before = self.playback_speed
        try:
            self.playback_speed = change_playback_speed(before, action)
        except PlaybackSpeedError as error:
            sentence = self._refusals.playback_speed(error.code, error.facts)
            where = f"actions.{position}.{error.field}"
            raise Invalid(sentence, errors=[FieldProblem(where, sentence)]) from error
        return PlaybackSpeedSet(before, self.playback_speed, self.timeline.tick)

    def _step(self, ticks: int) -> Stepped:
        self.paused = True
        try:
            return Stepped(self.timeline.tick, tuple(self.timeline.advance() for _ in range(ticks)))
        except PlannerSilentError as silence:
            raise planner_timeout_problem(silence, self._language) from silence

    def _undo(self, position: int) -> Undone:
        self._close_step()
        step = self.undo_stack.undo(self.timeline)
        if step is None:
            raise _nothing_to_undo(self._refusals.session("nothing_to_undo"), position)
        return self._replace_tail(step.inverse, again=False)

    def _redo(self, position: int) -> Undone:
        self._close_step()
        step = self.undo_stack.redo(self.timeline)
        if step is None:
            raise _nothing_to_undo(self._refusals.session("nothing_to_redo"), position)
        return self._replace_tail(step, again=True)

    def _rewind(self, position: int, ticks: int) -> Jumped:
        before = self.timeline.state
        rewind_timeline(self.timeline, ticks, f"actions.{position}.ticks", self._language)
        return self._jump(before, len(self.timeline.entries))

    def _save(self, sequence: int, position: int, name: str) -> Bookmarked:
        saved = self.undo_stack.bookmarks
        if name not in saved and len(saved) >= MAX_BOOKMARKS:
            sentence = self._refusals.session("names", most=MAX_BOOKMARKS)
            raise Invalid(sentence, errors=[FieldProblem(f"actions.{position}.name", sentence)])
        again = name in saved
        self.undo_stack.bookmarks = {**saved, name: Bookmark(name, sequence, self.timeline.copy())}
        return Bookmarked(name, self.timeline.tick, again)

    def _load(self, position: int, name: str) -> Jumped:
        moment = self.undo_stack.bookmarks.get(name)
        if moment is None:
            raise unknown_bookmark(
                name, self.undo_stack.bookmarks, f"actions.{position}.name", self._language
            )
        before, log = self.timeline.state, self.timeline.entries
        self.timeline = moment.timeline.copy()
        return self._jump(before, log.common_prefix_length(self.timeline.entries), name)

    def _jump(self, before: SimState, kept: int, name: str | None = None) -> Jumped:
        self._savepoint.kept = min(self._savepoint.kept, kept)
        self._savepoint.jumped = self._jumped = True
        run = self.timeline.state
        return Jumped(before.world.tick, run.world.tick, differences(before, run), name)

    def _close_step(self) -> None:
        """What this utterance has changed so far is the latest change: an undo takes it back first."""
        self._add_step(self._savepoint)

    def _add_step(self, since: _Savepoint) -> None:
        log = self.timeline.entries
        jump = TimeJump(since.timeline, self.timeline.copy()) if since.jumped else None
        was = since.timeline.entries
        step = UndoStep(
            tuple(was.after(since.kept)), tuple(log.after(since.kept)), since.paused, self.paused, jump
        )
        if not step.empty:
            self.undo_stack.add(step)

    def _replace_tail(self, step: UndoStep, *, again: bool) -> Undone:
        """Put the log's tail as the step left it, and replay."""
        before = self.timeline.state
        kept = len(self.timeline.entries) - len(step.before)
        if step.jump is None:
            try:
                self.timeline.rewrite(self.timeline.entries.first(kept).plus(step.after), step.since)
            except PlannerSilentError as silence:
                raise planner_timeout_problem(silence, self._language) from silence
        else:
            self.timeline = step.jump.after.copy()
            self._jumped = True
        paused = self.paused
        if paused == step.paused_before:
            self.paused = step.paused_after
        self._savepoint = _Savepoint(self.timeline.copy(), self.paused, kept)
        changes = differences(before, self.timeline.state)
        if before.world.tick != self.timeline.tick:
            changes = (Change("tick", before.world.tick, self.timeline.tick), *changes)
        if paused != self.paused:
            changes = (*changes, Change("paused", paused, self.paused))
        return Undone(again, changes)


class _Savepoint:
    """A timeline as it was, how many of its first entries are untouched since, and whether time moved.

    The timeline is nobody else's to change.
    """

    def __init__(self, timeline: Timeline, paused: bool, kept: int | None = None) -> None:
        self.timeline = timeline
        self.paused = paused
        self.kept = len(timeline.entries) if kept is None else kept
        self.jumped = False

    def copy(self) -> _Savepoint:
        """Another for the same moment."""
        return _Savepoint(self.timeline, self.paused, self.kept)


def planner_timeout_problem(silence: PlannerSilentError, language: str = DEFAULT_LANGUAGE) -> NotAvailable:
    """The problem of a planner that did not answer in time."""
    sentence = refusals(language).session("silent", planner=silence.planner, fault=silence.fault)
    return NotAvailable(sentence, errors=[FieldProblem("planner", sentence)])


def step_ticks(actions: Sequence[Action]) -> int:
    """Ticks that the steps of an utterance run at once."""
    return sum(action.ticks for action in actions if isinstance(action, StepTicks))


def check_step_ticks(actions: Sequence[Action], most: int, language: str = DEFAULT_LANGUAGE) -> None:
    """Raise `Invalid` where an utterance would step further than is run at once."""
    if step_ticks(actions) > most:
        sentence = refusals(language).session("too_many_ticks", most=most)
        raise Invalid(sentence, errors=[FieldProblem("ticks", sentence)])


def _nothing_to_undo(sentence: str, position: int) -> NothingToUndo:
    return NothingToUndo(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
