"""Actions tried on a copy: either all of them are possible, or the copy is thrown away.

A `Draft` is what one utterance would make of a session. It does actions at their place in the
order and answers a fact for each; it becomes the session once the store has the utterance.
Restoring a session and replaying a recording run through here as well, which is why they end in
the same state.
"""

from __future__ import annotations

from collections.abc import Sequence

from service.actions import Action, Advise, Ask, Forget, Pause, Redo, Resume, Teach, Undo
from service.actions import Step as StepTicks
from service.problems import DoesNotFit, FieldProblem, Invalid, NotAvailable, NothingToUndo, ProblemError
from service.sessions import availability
from service.sessions.facts import Advised, Asked, Fact, PauseSet, Stepped, Undone
from service.sessions.history import History, Step
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
from sim.advice import NoAdviceError, advise
from sim.edit import differences
from sim.edit_error import EditError
from sim.kinds import Kind
from sim.timeline import PlannerSilentError, Timeline

WORLD_ACTIONS = (Add, Remove, SetCount, Scenario, Reset, SetMode, Drive, Set, Adjust, Prefer)


class Draft:
    """A session's changeable part, on a copy."""

    def __init__(self, timeline: Timeline, paused: bool, history: History) -> None:
        self.timeline = timeline.copy()
        self.paused = paused
        self.history = history.copy()
        self._open = _Mark(self.timeline, paused)

    def perform(self, sequence: int, actions: Sequence[Action]) -> tuple[Fact, ...]:
        """Do the actions of one utterance. Raises a `ProblemError` naming the first that cannot be."""
        earlier, began = self.history.copy(), _Mark(self.timeline, self.paused)
        self._open = _Mark(self.timeline, self.paused)
        facts = []
        for position, action in enumerate(actions):
            facts.append(self._do(sequence, position, action))
            began.kept = min(began.kept, self._open.kept)
        if any(isinstance(action, WORLD_ACTIONS) for action in actions):
            # Whatever it undid on the way, the utterance is one step.
            self.history = earlier
            self._add_step(began)
        return tuple(facts)

    def work_ticks(self, actions: Sequence[Action]) -> int:
        """About how many ticks are to be run: those of steps, and those since what is undone or redone."""
        ticks = ticks_to_run(actions)
        for kind, steps in ((Undo, self.history.done), (Redo, self.history.undone)):
            if steps and any(isinstance(action, kind) for action in actions):
                ticks += self.timeline.tick - steps[-1].since
        return ticks

    def _do(self, sequence: int, position: int, action: Action) -> Fact:
        sentence = availability.refusal(action)
        if sentence is not None:
            raise NotAvailable(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
        match action:
            case Ask():
                return Asked(action, self.timeline.copy())
            case Advise():
                return self._advise(position, action)
            case Pause() | Resume():
                return self._set_paused(isinstance(action, Pause))
            case StepTicks():
                return self._step(action.ticks)
            case Undo():
                return self._undo(position)
            case Redo():
                return self._redo(position)
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
                sentence = "A phrase is taught or forgotten by itself, outside of any session."
                raise Invalid(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
            case _:
                raise AssertionError(f"{action.do} is offered but nobody does it")

    def _apply(self, sequence: int, position: int, action: WorldAction) -> Fact:
        try:
            (applied,) = self.timeline.apply(sequence, [action])
        except EditError as error:
            raise _edit_problem(error, position) from error
        return applied

    def _advise(self, position: int, action: Advise) -> Advised:
        weather: Weather = getattr(self.timeline.run.config, "weather", "clear")
        try:
            advice = advise(Kind(action.hazard), action.distance_m, action.speed_kmh, weather)
        except NoAdviceError as error:
            where = f"actions.{position}.{error.field}"
            raise Invalid(error.message, errors=[FieldProblem(where, error.message)]) from error
        return Advised(advice, self.timeline.tick)

    def _set_paused(self, paused: bool) -> PauseSet:
        before, self.paused = self.paused, paused
        return PauseSet(before, paused, self.timeline.tick)

    def _step(self, ticks: int) -> Stepped:
        self.paused = True
        try:
            return Stepped(self.timeline.tick, tuple(self.timeline.advance() for _ in range(ticks)))
        except PlannerSilentError as silence:
            sentence = f"{silence}. Drive yourself, or choose another planner."
            raise NotAvailable(sentence, errors=[FieldProblem("planner", sentence)]) from silence

    def _undo(self, position: int) -> Undone:
        self._close_step()
        if not self.history.done:
            raise _nothing("There is no change to take back.", position)
        step = self.history.done.pop()
        self.history.undone.append(step)
        return self._take(step.reversed, again=False)

    def _redo(self, position: int) -> Undone:
        self._close_step()
        if not self.history.undone:
            raise _nothing("No change has been taken back that could be made again.", position)
        step = self.history.undone.pop()
        self.history.done.append(step)
        return self._take(step, again=True)

    def _close_step(self) -> None:
        """What this utterance has changed so far is the latest change: an undo takes it back first."""
        self._add_step(self._open)

    def _add_step(self, since: _Mark) -> None:
        log = self.timeline.entries
        step = Step(tuple(since.log[since.kept :]), tuple(log[since.kept :]), since.paused, self.paused)
        if not step.empty:
            self.history.add(step)

    def _take(self, step: Step, *, again: bool) -> Undone:
        """Put the log's tail as the step left it, and replay."""
        before = self.timeline.run
        kept = len(self.timeline.entries) - len(step.before)
        self.timeline.rewrite([*self.timeline.entries[:kept], *step.after], step.since)
        if self.paused == step.paused_before:
            self.paused = step.paused_after
        self._open = _Mark(self.timeline, self.paused, kept)
        return Undone(again, differences(before, self.timeline.run))


class _Mark:
    """A log as it once was, and how many of its first entries are untouched since."""

    def __init__(self, timeline: Timeline, paused: bool, kept: int | None = None) -> None:
        self.log = list(timeline.entries)
        self.paused = paused
        self.kept = len(self.log) if kept is None else kept


def ticks_to_run(actions: Sequence[Action]) -> int:
    """Ticks that the steps of an utterance run at once."""
    return sum(action.ticks for action in actions if isinstance(action, StepTicks))


def check_ticks(actions: Sequence[Action], most: int) -> None:
    """Raise `Invalid` where an utterance would step further than is run at once."""
    if ticks_to_run(actions) > most:
        sentence = f"At most {most} ticks can be run at once."
        raise Invalid(sentence, errors=[FieldProblem("ticks", sentence)])


def _edit_problem(error: EditError, position: int) -> ProblemError:
    kind = NotAvailable if error.code == "not-available" else DoesNotFit
    return kind(error.message, errors=[FieldProblem(f"actions.{position}.{error.field}", error.message)])


def _nothing(sentence: str, position: int) -> NothingToUndo:
    return NothingToUndo(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
