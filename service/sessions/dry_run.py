"""Whether something could be done just now, for those who offer it."""

from __future__ import annotations

from service.actions import Action, Load, Pause, Redo, Resume, Rewind, Undo
from service.problems import ProblemError
from service.sessions.availability import refusal
from service.sessions.facts import changes_of
from service.sessions.transaction import Draft
from sim.actions import Add, Remove, SetCount, SetMode
from sim.session.edits import Applied

TRIED = (Add, Remove, SetCount, SetMode, Undo, Redo, Pause, Resume, Rewind, Load)
"""Actions that are tried on a copy at once, to know whether they are possible."""


def possible(draft: Draft, sequence: int, actions: tuple[Action, ...]) -> bool:
    """Whether these would be done on a draft, and change something; long work is taken to be possible."""
    if any(not isinstance(action, TRIED) for action in actions):
        return all(refusal(action) is None for action in actions)
    if draft.asks_others(actions):
        return all(draft.could_take_back(action) for action in actions)
    try:
        facts = draft.perform(sequence + 1, actions)
    except ProblemError:
        return False
    return any(changes_of((fact,)) or not isinstance(fact, Applied) for fact in facts)
