"""Questions of ours: how one becomes a session's pending question, and how the next sentence answers it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from service.actions import Action, Ask, Drop, Undo
from service.grammar import Language as Grammar
from service.grammar.answers import NoChoice, NoSuchChoice, read_answer
from service.grammar.parse_types import Ambiguous as AmbiguousParse
from service.grammar.parse_types import Choice, Parse, Refused, Understood
from service.problems import Ambiguous
from service.refusals import refusals
from service.sessions.availability import refusal_of
from service.sessions.pending import PendingChoice, PendingQuestion


class Asked(Ambiguous):
    """The problem of a sentence that is asked about, with the question as it may become pending."""

    def __init__(self, question: PendingQuestion, detail: str | None = None, *, likely: bool = False) -> None:
        """`detail`: what is said instead of the question alone; `likely`: whether the first choice is."""
        told = question.to_json()
        super().__init__(detail or question.question, choices=told["choices"], source=question.source)
        self.question = question
        self.likely = likely

    def becomes_pending(self) -> None:
        """Note in the document that the session waits for the answer."""
        self.more = {**self.more, "pending": self.question.to_json()}


def asked_by(parse: AmbiguousParse, language: str, pending: PendingQuestion | None = None) -> Asked:
    """The problem that asks what a sentence means; one that is `pending` already is asked again."""
    if pending is not None and [each.actions for each in parse.choices] == [
        each.actions for each in pending.choices
    ]:
        return Asked(pending, parse.question)
    choices = tuple(PendingChoice(choice.text, choice.actions) for choice in parse.choices)
    return Asked(PendingQuestion(parse.text, parse.question, choices, "grammar", language))


def only_doable(parse: Parse, language: str) -> Parse:
    """A question with the choices alone that this version offers; with all of them where it offers none."""
    if not isinstance(parse, AmbiguousParse):
        return parse
    refused = {each.text: why for each in parse.choices if (why := _why_not(each, language)) is not None}
    doable = tuple(each for each in parse.choices if each.text not in refused)
    if not refused or not doable:
        return parse
    if len(doable) > 1:
        return AmbiguousParse(parse.text, parse.question, doable)
    why = " ".join(dict.fromkeys(refused.values()))
    question = refusals(language).said("means_one", sentence=doable[0].text, why=why)
    return AmbiguousParse(parse.text, question, doable)


def _why_not(choice: Choice, language: str) -> str | None:
    """Why a choice cannot be done by this version, as a sentence; None if it can."""
    return next((why for each in choice.actions if (why := refusal_of(each, language))), None)


def answered(language: Any, code: str, text: str, parse: Parse, pending: PendingQuestion | None) -> Parse:
    """What a sentence means while a question is pending: an answer to it, or what it means by itself.

    A request of its own is an answer only where it says no more than the words of one choice.
    """
    if pending is None or not isinstance(language, Grammar):
        return parse
    choices = [Choice(each.text, each.actions) for each in pending.choices]
    corrects = isinstance(parse, Understood) and len(parse.actions) > 1 and isinstance(parse.actions[0], Undo)
    literal = not (isinstance(parse, Refused) or corrects) or code != pending.language
    answer = read_answer(language, text, choices, literal=literal, asked=pending.text)
    if isinstance(parse, AmbiguousParse) and not isinstance(answer, tuple):
        return parse
    match answer:
        case None:
            return parse
        case NoChoice.DROPPED:
            return Understood(text, (Drop(),))
        case NoChoice.UNCLEAR if isinstance(parse, Understood) and _asks_options(parse.actions):
            parameters = {getattr(action, "parameter", None) for each in choices for action in each.actions}
            about = parameters.pop() if len(parameters) == 1 else None
            return parse if about is None else Understood(text, (Ask(about="options", parameter=about),))
        case NoChoice.UNCLEAR:
            return parse if literal or corrects else AmbiguousParse(text, pending.question, tuple(choices))
        case NoSuchChoice(number=number):
            if literal:
                return parse
            said = language.data.answers.no_such_choice.format(number=number, count=len(choices))
            return AmbiguousParse(text, f"{said} {pending.question}", tuple(choices))
        case actions:
            return Understood(text, actions)


def _asks_options(actions: Sequence[Action]) -> bool:
    """Whether it is asked what there is to choose from."""
    return all(isinstance(action, Ask) and action.about == "options" for action in actions)
