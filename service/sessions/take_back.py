"""Undo and redo of one or several steps, as one change of a transaction.

Steps that moved no time are taken back together, so that the ticks since the earliest of them are decided
again once. An undo or redo that was stored without a number of steps is from the time when playback speed
could not be undone; it passes over the playback speed, so that old logs lead to the states they led to.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from service.actions import Action, Redo, Undo
from service.problems import FieldProblem, NothingToUndo
from service.sessions.facts import Fact, Undone
from service.sessions.planner_timeout import planner_timeout_problem
from service.sessions.undo_stack import UndoStep
from sim.session.edits import Change, differences
from sim.session.persistent_list import PersistentList
from sim.session.timeline import Entry, PlannerSilentError

if TYPE_CHECKING:
    from service.sessions.transaction import Transaction


def take_back(transaction: Transaction, action: Undo | Redo, position: int) -> Undone:
    """Undo or redo as many steps as an action says. Raises `NothingToUndo` or `NotAvailable`."""
    transaction.close_step()
    steps = _count(transaction, action, position)
    before, speed, paused = transaction.timeline.state, transaction.playback_speed, transaction.paused
    changed = _Rewriting(transaction)
    for _ in range(steps):
        changed.add(_next_step(transaction, action, changed), with_speed=not _of_old_log(transaction, action))
    changed.finish()
    changes = differences(before, transaction.timeline.state)
    if before.world.tick != transaction.timeline.tick:
        changes = (Change("tick", before.world.tick, transaction.timeline.tick), *changes)
    if speed != transaction.playback_speed:
        changes = (*changes, Change("playback_speed", speed, transaction.playback_speed))
    if paused != transaction.paused:
        changes = (*changes, Change("paused", paused, transaction.paused))
    return Undone(isinstance(action, Redo), changes, steps)


def settled(actions: tuple[Action, ...], facts: tuple[Fact, ...]) -> tuple[Action, ...]:
    """Actions as they are stored: undo and redo with the number of steps that they took."""
    pairs = zip(actions, facts, strict=False)
    return tuple(
        replace(action, steps=fact.steps)
        if isinstance(action, Undo | Redo) and isinstance(fact, Undone)
        else action
        for action, fact in pairs
    )


def _of_old_log(transaction: Transaction, action: Undo | Redo) -> bool:
    return transaction.stored and action.steps is None


def _count(transaction: Transaction, action: Undo | Redo, position: int) -> int:
    """How many steps to take. Raises `NothingToUndo` where there are not so many."""
    stack, words = transaction.undo_stack, transaction.refusals
    undoing = isinstance(action, Undo)
    if _of_old_log(transaction, action):
        there = int(any(not step.only_speed for step in _steps(transaction, action)))
    else:
        there = stack.steps if undoing else len(stack.undone)
    wanted = there if action.steps == "all" else action.steps or 1
    if there and wanted <= there:
        return wanted
    do = "undo" if undoing else "redo"
    if not there:
        raise _refused(words.session(f"nothing_to_{do}"), f"actions.{position}")
    sentence = words.session(f"too_few_to_{do}", there=there, steps=wanted)
    raise _refused(sentence, f"actions.{position}.steps")


def _refused(sentence: str, where: str) -> NothingToUndo:
    return NothingToUndo(sentence, errors=[FieldProblem(where, sentence)])


def _steps(transaction: Transaction, action: Undo | Redo) -> Iterator[UndoStep]:
    """The steps that can be undone or redone, the next one first."""
    stack = transaction.undo_stack
    if isinstance(action, Undo):
        return stack.iter_undoable(transaction.timeline.entries)
    return reversed(stack.undone)


def _next_step(transaction: Transaction, action: Undo | Redo, changed: _Rewriting) -> UndoStep:
    """Take the next step off the stack, and return it in the direction in which it is to be done."""
    stack, old = transaction.undo_stack, _of_old_log(transaction, action)
    if next(_steps(transaction, action)).jump is not None:
        changed.finish()  # a step that moved time keeps the timeline as it stands then
    take = stack.undo if isinstance(action, Undo) else stack.redo
    step = take(transaction.timeline, world_only=old)
    assert step is not None
    return step.inverse if isinstance(action, Undo) else step


class _Rewriting:
    """The log of a transaction while steps are taken back; it is replayed when the last of them is known."""

    def __init__(self, transaction: Transaction) -> None:
        self._transaction = transaction
        self._entries: PersistentList[Entry] = transaction.timeline.entries
        self._since: int | None = None
        self._kept = len(self._entries)

    def add(self, step: UndoStep, *, with_speed: bool) -> None:
        """Do a step: what its `before` is becomes its `after`."""
        transaction = self._transaction
        if step.jump is not None:
            self.finish()
            self._kept = min(self._kept, len(self._entries) - len(step.before))
            transaction.move_time(step.jump.after)
            self._entries = transaction.timeline.entries
        elif step.before or step.after:
            kept = len(self._entries) - len(step.before)
            self._entries = self._entries.first(kept).plus(step.after)
            self._kept = min(self._kept, kept)
            self._since = step.since if self._since is None else min(self._since, step.since)
        if transaction.paused == step.paused_before:
            transaction.paused = step.paused_after
        if with_speed and step.speed is not None:
            transaction.playback_speed = step.speed[1]

    def finish(self) -> None:
        """Replay the ticks that may differ. Raises `NotAvailable`."""
        transaction = self._transaction
        if self._since is not None:
            try:
                transaction.timeline.rewrite(self._entries, self._since)
            except PlannerSilentError as silence:
                raise planner_timeout_problem(silence, transaction.language) from silence
            self._since = None
        transaction.begin_step(self._kept)
