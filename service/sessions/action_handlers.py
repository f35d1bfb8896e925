"""Handlers of actions: what a transaction does for each kind of action, registered in one place.

A handler gets the transaction, the action, the sequence number of the utterance and the action's position in
it, changes the transaction and returns a fact. It raises a `ProblemError` that names the field at fault.
Actions that change the world share one handler, since `sim.session.edits` applies them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from service.actions import (
    Advise,
    Ask,
    Chat,
    Drop,
    Evaluate,
    EvaluationTalk,
    FindWorst,
    Forget,
    Goal,
    Hide,
    Load,
    Pause,
    Redo,
    Resume,
    Rewind,
    Save,
    Show,
    Step,
    Style,
    Teach,
    Undo,
)
from service.actions.table import sets_playback_speed, types_where
from service.evaluations.refuse import refuse_evaluation
from service.evaluations.request import evaluation_of, falsification_of
from service.problems import DoesNotFit, FieldProblem, Invalid, NotAvailable
from service.sessions.bookmarks import MAX_BOOKMARKS, Bookmark, Bookmarked, Jumped, unknown_bookmark
from service.sessions.facts import (
    Advised,
    Asked,
    Chatted,
    Dropped,
    Fact,
    JobAsked,
    JobTold,
    PauseSet,
    Resolved,
    Stepped,
    Undone,
    Viewed,
)
from service.sessions.planner_timeout import planner_timeout_problem
from service.sessions.rewind import rewind_timeline
from service.sessions.scheduler.playback_speed import (
    PlaybackSpeedError,
    PlaybackSpeedSet,
    change_playback_speed,
)
from service.sessions.take_back import take_back
from service.styles import styles
from sim.actions import Adjust, Set, Weather, WorldAction
from sim.evaluate import EvaluationError
from sim.goals import Budget, CancelledError, find_goal
from sim.hazard_advice import NoAdviceError, advise
from sim.planner_names import canonical
from sim.session.edits import Applied
from sim.session.errors import EditError
from sim.session.timeline import PlannerSilentError, Timeline
from sim.session.triggers import pauses
from sim.state import StepResult
from sim.types import Kind

if TYPE_CHECKING:
    from service.sessions.transaction import Transaction

Handler: TypeAlias = Callable[["Transaction", Any, int, int], Fact]
"""Takes the transaction, the action, the utterance's sequence number and the action's position in it."""

HandlerT = TypeVar("HandlerT", bound=Handler)

HANDLERS: dict[type, Handler] = {}
"""The handler of each class of actions that is offered."""


def handles(*kinds: type) -> Callable[[HandlerT], HandlerT]:
    """Registers a function as the handler of some classes of actions."""

    def register(handler: HandlerT) -> HandlerT:
        HANDLERS.update(dict.fromkeys(kinds, handler))
        return handler

    return register


@handles(*types_where(lambda traits: traits.changes_world))
def _change_world(transaction: Transaction, action: WorldAction, sequence: int, position: int) -> Fact:
    if sets_playback_speed(action):
        assert isinstance(action, Set | Adjust)
        return _set_playback_speed(transaction, action, position)
    (applied,) = _apply(transaction, (action,), sequence, position)
    return applied


def _apply(
    transaction: Transaction, actions: Sequence[WorldAction], sequence: int, position: int
) -> tuple[Applied, ...]:
    try:
        return tuple(transaction.timeline.apply(sequence, actions))
    except EditError as error:
        raise _refused(transaction, error, position) from error


def _refused(transaction: Transaction, error: EditError, position: int) -> Invalid:
    sentence = transaction.refusals.edit(error)
    kind = NotAvailable if error.category == "not-available" else DoesNotFit
    errors = [FieldProblem(f"actions.{position}.{error.field}", sentence)]
    instead = transaction.refusals.instead(error)
    return kind(sentence, errors=errors, suggestions=instead) if instead else kind(sentence, errors=errors)


@handles(Goal)
def _reach_goal(transaction: Transaction, action: Goal, sequence: int, position: int) -> Resolved:
    budget = Budget(cancelled=transaction.abandoned.is_set)
    try:
        found = find_goal(
            transaction.timeline.state,
            action.goal,
            planners=tuple(canonical(planner) for planner in action.planners or ()),
            degree=action.degree,
            budget=budget,
        )
    except EditError as error:
        raise _refused(transaction, error, position) from error
    except CancelledError as cancelled:
        raise Invalid(transaction.refusals.session("abandoned")) from cancelled
    return Resolved(action, _apply(transaction, found.actions, sequence, position), found)


@handles(Evaluate)
def _evaluate(transaction: Transaction, action: Evaluate, _sequence: int, position: int) -> JobAsked:
    try:
        state = transaction.timeline.state
        saved = transaction.undo_stack.saved_states()
        return JobAsked(evaluation_of(action, state.config_of(), state, saved=saved))
    except EvaluationError as error:
        raise refuse_evaluation(error, transaction.refusals, f"actions.{position}.") from error


@handles(EvaluationTalk)
def _talk_of_evaluation(
    _transaction: Transaction, action: EvaluationTalk, _sequence: int, _position: int
) -> JobTold:
    return JobTold(action.want, action.planners)


@handles(FindWorst)
def _find_worst(transaction: Transaction, action: FindWorst, _sequence: int, position: int) -> JobAsked:
    try:
        return JobAsked(falsification_of(action, transaction.timeline.state.config_of()))
    except EvaluationError as error:
        raise refuse_evaluation(error, transaction.refusals, f"actions.{position}.") from error


@handles(Style)
def _set_style(transaction: Transaction, action: Style, sequence: int, position: int) -> Resolved:
    known = styles()
    if action.style not in known:
        sentence = transaction.refusals.session("no_such_style", choices=tuple(known))
        raise Invalid(sentence, errors=[FieldProblem(f"actions.{position}.style", sentence)])
    return Resolved(action, _apply(transaction, known[action.style], sequence, position))


def _set_playback_speed(transaction: Transaction, action: Set | Adjust, position: int) -> PlaybackSpeedSet:
    before = transaction.playback_speed
    try:
        transaction.playback_speed = change_playback_speed(before, action)
    except PlaybackSpeedError as error:
        sentence = transaction.refusals.playback_speed(error.code, error.facts)
        where = f"actions.{position}.{error.field}"
        raise Invalid(sentence, errors=[FieldProblem(where, sentence)]) from error
    return PlaybackSpeedSet(before, transaction.playback_speed, transaction.timeline.tick)


@handles(Ask)
def _ask(transaction: Transaction, action: Ask, _sequence: int, _position: int) -> Asked:
    return Asked(
        action,
        transaction.timeline.copy(),
        playback_speed=transaction.playback_speed,
        talk=transaction.talk,
        paused=transaction.paused,
    )


@handles(Chat)
def _chat(_transaction: Transaction, action: Chat, _sequence: int, _position: int) -> Chatted:
    return Chatted(action.kind)


@handles(Advise)
def _advise(transaction: Transaction, action: Advise, _sequence: int, position: int) -> Advised:
    weather: Weather = getattr(transaction.timeline.state.config, "weather", "clear")
    try:
        advice = advise(Kind(action.hazard), action.distance_m, action.speed_kmh, weather)
    except NoAdviceError as error:
        sentence, where = transaction.refusals.advice(error), f"actions.{position}.{error.field}"
        raise Invalid(sentence, errors=[FieldProblem(where, sentence)]) from error
    return Advised(advice, transaction.timeline.tick)


@handles(Show, Hide)
def _set_view(_transaction: Transaction, action: Show | Hide, _sequence: int, _position: int) -> Viewed:
    return Viewed(action.view, isinstance(action, Show))


@handles(Pause, Resume)
def _set_paused(transaction: Transaction, action: Pause | Resume, _sequence: int, _position: int) -> PauseSet:
    before, transaction.paused = transaction.paused, isinstance(action, Pause)
    return PauseSet(before, transaction.paused, transaction.timeline.tick)


@handles(Step)
def _step(transaction: Transaction, action: Step, _sequence: int, _position: int) -> Stepped:
    transaction.paused = True
    timeline = transaction.timeline
    try:
        first = timeline.tick
        return Stepped(first, tuple(_until_paused(timeline, action.ticks)))
    except PlannerSilentError as silence:
        raise planner_timeout_problem(silence, transaction.language) from silence


def _until_paused(timeline: Timeline, ticks: int) -> Iterator[StepResult]:
    """So many ticks, or those up to one in which a rule stops the clock."""
    for _ in range(ticks):
        tick = timeline.advance()
        yield tick
        if pauses(tick.events):
            return


@handles(Undo, Redo)
def _undo(transaction: Transaction, action: Undo | Redo, _sequence: int, position: int) -> Undone:
    return take_back(transaction, action, position)


@handles(Drop)
def _drop(transaction: Transaction, _action: Drop, _sequence: int, _position: int) -> Dropped:
    pending = transaction.talk.pending
    return Dropped(None if pending is None else pending.question)


@handles(Rewind)
def _rewind(transaction: Transaction, action: Rewind, _sequence: int, position: int) -> Jumped:
    before = transaction.timeline.state
    rewind_timeline(transaction.timeline, action, f"actions.{position}", transaction.language)
    return transaction.jump(before, len(transaction.timeline.entries))


@handles(Save)
def _save(transaction: Transaction, action: Save, sequence: int, position: int) -> Bookmarked:
    stack, name = transaction.undo_stack, action.name
    again = name in stack.bookmarks
    if not again and len(stack.bookmarks) >= MAX_BOOKMARKS:
        sentence = transaction.refusals.session("names", most=MAX_BOOKMARKS)
        raise Invalid(sentence, errors=[FieldProblem(f"actions.{position}.name", sentence)])
    bookmark = Bookmark(name, sequence, transaction.timeline.copy())
    stack.bookmarks = {**stack.bookmarks, name: bookmark}
    return Bookmarked(name, transaction.timeline.tick, again)


@handles(Load)
def _load(transaction: Transaction, action: Load, _sequence: int, position: int) -> Jumped:
    bookmarks = transaction.undo_stack.bookmarks
    bookmark = bookmarks.get(action.name)
    if bookmark is None:
        raise unknown_bookmark(action.name, bookmarks, f"actions.{position}.name", transaction.language)
    before, log = transaction.timeline.state, transaction.timeline.entries
    transaction.timeline = bookmark.timeline.copy()
    kept = log.common_prefix_length(transaction.timeline.entries)
    return transaction.jump(before, kept, action.name)


@handles(Teach, Forget)
def _refuse_aliases(transaction: Transaction, _action: Teach | Forget, _sequence: int, position: int) -> Fact:
    sentence = transaction.refusals.session("alone")
    raise Invalid(sentence, errors=[FieldProblem(f"actions.{position}", sentence)])
