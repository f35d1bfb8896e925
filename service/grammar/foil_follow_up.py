"""Reads a move that is said after a question about one: "and left?" asks why not that, of that decision."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

from service.actions import Action, Ask
from service.grammar.answer_words import FOLLOWS
from service.grammar.data import LanguageData
from service.grammar.parse_types import Parse, Refused, Understood
from service.grammar.sentences import Unsayable
from service.grammar.tokens import normalise, tokenise
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Drive
from sim.types import Move

MAX_WORDS = 6
"""Longer sentences say themselves what they are about."""
_BASES = (Move.LEFT, Move.FORWARD)
"""Moves in whose place another one is read."""


class Reader(Protocol):
    """What is needed of the language."""

    data: LanguageData

    def read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        """A sentence read."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""


def ask_of_foil(language: Reader, text: str, topic: Topic, parsed: Parse) -> Understood | None:
    """The question about another move than the one spoken of; None where a sentence is anything else.

    A sentence that is a request by itself asks only where it is a question by its mark.
    """
    last = _last_question(topic)
    if last is None or not (isinstance(parsed, Refused) or text.rstrip().endswith("?")):
        return None
    plain = normalise(text)
    tokens = tokenise(plain, language.data.contractions)
    follows = language.data.answers.beginning(tokens, FOLLOWS)
    if not follows or not follows < len(tokens) <= MAX_WORDS:
        return None
    try:
        said = _move_said(language, plain[tokens[follows].start :])
    except (BudgetExceededError, Unsayable):
        return None
    if said is None:
        return None
    tick = last.tick if last.tick is not None else topic.tick
    if last.about == "what_if":
        return Understood(text, (replace(last, move=said, tick=tick, ticks=None, seconds=None),))
    return Understood(text, (Ask(about="why_not", move=said, tick=tick),))


def _move_said(language: Reader, said: str) -> Move | None:
    """The move that some words name: as a request, as a question why not, or in the place of another move."""
    work = WorkBudget()
    whole = [said]
    for other in _BASES:
        base = language.sentence((Ask(about="why_not", move=other),))
        whole.append(f"{base}, {language.data.answers.replaces} {said}")
    for at, text in enumerate(whole):
        parsed = language.read(text, ALONE, work, asking=False)
        if not isinstance(parsed, Understood) or len(parsed.actions) != 1:
            continue
        (action,) = parsed.actions
        if at == 0 and isinstance(action, Drive) and action.ego is None:
            return action.move
        same = at > 0 and action == Ask(about="why_not", move=_BASES[at - 1])
        if (
            isinstance(action, Ask)
            and action == Ask(about="why_not", move=action.move or Move.STAY)
            and not same
        ):
            return action.move
    return None


def _last_question(topic: Topic) -> Ask | None:
    """The last question, where it was about a move that was made, or was not."""
    if len(topic.actions) != 1:
        return None
    (last,) = topic.actions
    if not isinstance(last, Ask) or last.about not in ("why", "why_not", "what_if", "detail"):
        return None
    return None if last.about == "what_if" and last.move is None else last
