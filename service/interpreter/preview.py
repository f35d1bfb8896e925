"""Previews: what a sentence would do, for someone who is still typing it.

The grammar alone reads the sentence and a copy of the session performs it: no model is asked, no question
answered and no long work started. Random choices (where a pothole falls) may differ when the sentence is
sent, so a preview has changes of figures only.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from service.actions import Action
from service.actions.table import traits_of
from service.grammar.parse_types import Ambiguous, Parse, Refused, Understood
from service.problems import ProblemError
from service.resources import DEFAULT_LANGUAGE
from service.sessions.facts import merge_changes
from service.sessions.session import Session
from service.sessions.transaction import Transaction
from sim.session.edits import Change

MAX_TICKS = 64
"""A preview that would run more ticks is not tried."""

PreviewStatus = Literal["does", "asks", "ambiguous", "not_understood", "refused"]


@dataclass(frozen=True, slots=True)
class Preview:
    """What a sentence would change, or why it would not be done.

    `actions` is its meaning; `detail` is the sentence of the refusal or of the question to the user.
    """

    standing: PreviewStatus
    actions: tuple[Action, ...] = ()
    changes: tuple[Change, ...] = ()
    detail: str | None = None
    unparsed: tuple[str, ...] = ()


def preview(parse: Parse, session: Session, language: str = DEFAULT_LANGUAGE) -> Preview:
    """The preview of a parsed sentence; the session stays as it is. Refusals are in `language`."""
    match parse:
        case Refused():
            standing: PreviewStatus = "not_understood" if parse.reason == "not_understood" else "refused"
            return Preview(standing, detail=parse.message, unparsed=parse.unparsed)
        case Ambiguous():
            return Preview("ambiguous", detail=parse.question)
        case Understood():
            return _try(parse.actions, session, language)


def _try(actions: tuple[Action, ...], session: Session, language: str) -> Preview:
    doing = tuple(action for action in actions if not traits_of(action).is_question)
    if not doing:
        return Preview("asks", actions)
    transaction = Transaction(
        session.timeline, session.paused, session.undo_stack, session.playback_speed, language
    )
    long = transaction.needs_external_planner(doing) or transaction.estimate_ticks(doing) > MAX_TICKS
    long = long or any(traits_of(action).searches for action in doing)
    if traits_of(doing[0]).changes_aliases or long:
        return Preview("does", actions)
    try:
        return Preview("does", actions, merge_changes(transaction.perform(session.sequence + 1, doing)))
    except ProblemError as problem:
        return Preview("refused", actions, detail=problem.detail)
