"""Finds why a changed sentence may mean what it meant: reasons are data, each in words, and counted."""

from __future__ import annotations

from collections.abc import Sequence

from service.grammar.fuzz.mutations import Mutant
from service.grammar.fuzz.vocabulary import Excuse


def excused(mutant: Mutant, excuses: Sequence[Excuse]) -> Excuse | None:
    """The first reason for which this mutant may mean the same; None where there is none."""
    return next((each for each in excuses if _holds(each, mutant)), None)


def _holds(excuse: Excuse, mutant: Mutant) -> bool:
    if mutant.kind not in excuse.kinds and "any" not in excuse.kinds:
        return False
    if excuse.changes and mutant.change not in excuse.changes:
        return False
    if excuse.does and not {str(action["do"]) for action in mutant.source.actions} <= excuse.does:
        return False
    said = f" {mutant.source.text.casefold().rstrip('.!?')} "
    return not excuse.beside or any(f" {each} " in said for each in excuse.beside)
