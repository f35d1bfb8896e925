"""What a sentence would do if it were sent now: for whoever is still typing it.

Read by the grammar alone, tried on a copy, and thrown away: no model is asked, no question answered
and no long work begun. What chance decides (where a pothole falls) may fall otherwise when it is
sent, so only figures are told.
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
"""More ticks than this are not run for a preview."""

PreviewStatus = Literal["does", "asks", "ambiguous", "not_understood", "refused"]


@dataclass(frozen=True, slots=True)
class Preview:
    """How a sentence stands: what it would change, or why it would not be done.

    `actions` is what it means; `detail` the sentence it would be refused or asked about with.
    """

    standing: PreviewStatus
    actions: tuple[Action, ...] = ()
    changes: tuple[Change, ...] = ()
    detail: str | None = None
    unparsed: tuple[str, ...] = ()


def preview(parse: Parse, session: Session, language: str = DEFAULT_LANGUAGE) -> Preview:
    """What a parsed sentence would do to a session, which stays as it is; refused in a language."""
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
    if traits_of(doing[0]).changes_aliases or long:
        return Preview("does", actions)
    try:
        return Preview("does", actions, merge_changes(transaction.perform(session.sequence + 1, doing)))
    except ProblemError as problem:
        return Preview("refused", actions, detail=problem.detail)
