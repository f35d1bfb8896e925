"""Dry runs: whether an action is possible now, for completions and suggestions."""

from __future__ import annotations

from service.actions import Action
from service.actions.table import traits_of
from service.problems import ProblemError
from service.sessions.availability import refusal_of
from service.sessions.facts import merge_changes
from service.sessions.transaction import Transaction
from sim.session.edits import Applied


def is_possible(transaction: Transaction, sequence: int, actions: tuple[Action, ...]) -> bool:
    """Whether the actions would succeed and change something; actions too slow to try count as possible."""
    if not all(traits_of(action).tried for action in actions):
        return all(refusal_of(action) is None for action in actions)
    if transaction.needs_external_planner(actions):
        return all(transaction.can_undo_or_redo(action) for action in actions)
    try:
        facts = transaction.perform(sequence + 1, actions)
    except ProblemError:
        return False
    return any(merge_changes((fact,)) or not isinstance(fact, Applied) for fact in facts)
