"""Transactions: the actions of one utterance, done on a copy of a session, all or none.

The copy becomes the session once the store has the utterance; it is thrown away when an action is refused.
Restoring a session and replaying a recording run through here as well, so they end in the same state. What
each kind of action does is in `service.sessions.action_handlers`.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, islice
from typing import Any

from service.actions import Action, Redo, Rewind, Undo
from service.actions import Step as StepTicks
from service.actions.table import sets_playback_speed, traits_of
from service.problems import FieldProblem, Invalid, NotAvailable
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions import availability
from service.sessions.action_handlers import HANDLERS
from service.sessions.bookmarks import Jumped
from service.sessions.facts import Fact
from service.sessions.pending import NO_TALK, Talk
from service.sessions.rewind import TimeJump, tick_meant
from service.sessions.scheduler.playback_speed import NORMAL, PlaybackSpeed
from service.sessions.undo_stack import UndoStack, UndoStep
from sim.planner_names import installed
from sim.session.edits import differences
from sim.session.timeline import Timeline
from sim.state import SimState


class Flag:
    """Set once, by one thread, and looked at by another; a `threading.Event` takes a lock to be made."""

    __slots__ = ("_set",)

    def __init__(self) -> None:
        self._set = False

    def set(self) -> None:
        """Set it for good."""
        self._set = True

    def is_set(self) -> bool:
        """Whether it is set."""
        return self._set


class Transaction:
    """A session's changeable part, on a copy."""

    def __init__(
        self,
        timeline: Timeline,
        paused: bool,
        history: UndoStack,
        speed: PlaybackSpeed = NORMAL,
        language: str = DEFAULT_LANGUAGE,
        talk: Talk = NO_TALK,
        *,
        stored: bool = False,
    ) -> None:
        """`language`: the one in which actions are refused; `stored`: they are read from a log."""
        self.talk = talk
        self.stored = stored
        self.language = language
        self.refusals = refusals(language)
        self.timeline = timeline.copy()
        self.paused = paused
        self.playback_speed = speed
        self.undo_stack = history.copy()
        self.abandoned = Flag()
        """set where nobody waits for the outcome any more: a search ends then"""
        self._jumped = False
        self._savepoint = _Savepoint(timeline, paused, speed)

    def __getstate__(self) -> dict[str, Any]:
        """All but what belongs to this process, so that a worker process can perform it."""
        return {key: value for key, value in self.__dict__.items() if key not in ("refusals", "abandoned")}

    def __setstate__(self, parts: dict[str, Any]) -> None:
        self.__dict__.update(parts, refusals=refusals(parts["language"]), abandoned=Flag())

    def perform(self, sequence: int, actions: Sequence[Action]) -> tuple[Fact, ...]:
        """Do the actions of one utterance. Raises a `ProblemError` naming the first that cannot be."""
        began = _Savepoint(self.timeline.copy(), self.paused, self.playback_speed)
        earlier, self._savepoint = self.undo_stack.copy(), began.copy()
        self._jumped = False
        facts = []
        for position, action in enumerate(actions):
            facts.append(self._do(sequence, position, action))
            began.kept = min(began.kept, self._savepoint.kept)
            began.jumped = began.jumped or self._jumped
        takes_over_speed = sequence == self.undo_stack.fork_sequence and all(
            map(sets_playback_speed, actions)
        )
        if any(traits_of(action).undo_step for action in actions) and not takes_over_speed:
            # Whatever it undid on the way, the utterance is one step.
            earlier.bookmarks = self.undo_stack.bookmarks
            self.undo_stack = earlier
            self._add_step(began)
        return tuple(facts)

    def estimate_ticks(self, actions: Sequence[Action]) -> int:
        """About how many ticks are to be run: those of steps, and those since what is undone or redone."""
        if not any(traits_of(action).runs_ticks for action in actions):
            return 0
        timeline = self.timeline
        undos, redos = (_steps_of(actions, kind) for kind in (Undo, Redo))
        back = list(islice(self.undo_stack.iter_undoable(timeline.entries), undos))
        # Whether what is redone was undone before or here, it comes last first.
        forth = list(islice(chain(reversed(back), reversed(self.undo_stack.undone)), redos))
        ticks = step_ticks(actions)
        for step in (*back, *forth):
            if step.jump is None and not step.only_speed and step.since < timeline.tick:
                ticks += timeline.work_since(step.since)
        for action in actions:
            if isinstance(action, Rewind):
                tick = tick_meant(timeline, action)
                if tick is not None and 0 <= tick <= timeline.tick:
                    ticks += timeline.work_to(tick)
        return ticks

    def needs_external_planner(self, actions: Sequence[Action]) -> bool:
        """Whether a planner of another package may have to be asked for these."""
        return bool(installed()) and any(traits_of(action).takes_decisions for action in actions)

    def can_undo_or_redo(self, action: Action) -> bool:
        """Whether there is something to undo or to redo, where that is the action."""
        if isinstance(action, Undo):
            return next(iter(self.undo_stack.iter_undoable(self.timeline.entries)), None) is not None
        return not isinstance(action, Redo) or bool(self.undo_stack.undone)

    def _do(self, sequence: int, position: int, action: Action) -> Fact:
        sentence = availability.refusal_of(action, self.language)
        if sentence is not None:
            raise NotAvailable(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
        return HANDLERS[type(action)](self, action, sequence, position)

    def jump(self, before: SimState, kept: int, name: str | None = None) -> Jumped:
        """Record that time moved away from `before`; `kept`: how many entries of the log are as they were."""
        self._savepoint.kept = min(self._savepoint.kept, kept)
        self._savepoint.jumped = self._jumped = True
        run = self.timeline.state
        return Jumped(before.world.tick, run.world.tick, differences(before, run), name)

    def close_step(self) -> None:
        """Make a step of what the utterance has changed so far, since an undo takes that back first."""
        self._add_step(self._savepoint)

    def _add_step(self, since: _Savepoint) -> None:
        log = self.timeline.entries
        speed = None if since.speed == self.playback_speed else (since.speed, self.playback_speed)
        jump = TimeJump(since.timeline, self.timeline.copy()) if since.jumped else None
        was = since.timeline.entries
        step = UndoStep(
            tuple(was.after(since.kept)), tuple(log.after(since.kept)), since.paused, self.paused, jump, speed
        )
        if not step.empty:
            self.undo_stack.add(step)

    def move_time(self, timeline: Timeline) -> None:
        """Take another timeline in the place of this one."""
        self.timeline = timeline.copy()
        self._jumped = True

    def begin_step(self, kept: int) -> None:
        """Begin another step here; `kept`: how many entries of the log are as they were."""
        self._savepoint = _Savepoint(self.timeline.copy(), self.paused, self.playback_speed, kept)


class _Savepoint:
    """What a step begins with: a timeline, how many of its first entries are untouched since, and the clock.

    Nothing else may change the timeline.
    """

    def __init__(
        self, timeline: Timeline, paused: bool, speed: PlaybackSpeed, kept: int | None = None
    ) -> None:
        self.timeline = timeline
        self.paused = paused
        self.speed = speed
        self.kept = len(timeline.entries) if kept is None else kept
        self.jumped = False

    def copy(self) -> _Savepoint:
        """Another for the same moment."""
        return _Savepoint(self.timeline, self.paused, self.speed, self.kept)


def _steps_of(actions: Sequence[Action], kind: type[Undo | Redo]) -> int | None:
    """How many steps some actions undo or redo; None for all there are."""
    steps = [action.steps for action in actions if isinstance(action, kind)]
    numbers = [1 if each is None else each for each in steps if each != "all"]
    return sum(numbers) if len(numbers) == len(steps) else None


def step_ticks(actions: Sequence[Action]) -> int:
    """Ticks that the steps of an utterance run at once."""
    return sum(action.ticks for action in actions if isinstance(action, StepTicks))


def check_step_ticks(actions: Sequence[Action], most: int, language: str = DEFAULT_LANGUAGE) -> None:
    """Raise `Invalid` where an utterance would step further than is run at once."""
    if step_ticks(actions) > most:
        sentence = refusals(language).session("too_many_ticks", most=most)
        raise Invalid(sentence, errors=[FieldProblem("ticks", sentence)])
