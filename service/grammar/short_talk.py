"""Reads short sentences about the last request as a whole: "and now?", "twice more", "a bit more".

Whatever is repeated is repeated as it was meant, at most `MAX_TIMES` times.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

from service.actions import Action, Goal, Hide, Rewind, Show, Step
from service.actions.table import traits_of
from service.grammar.answer_words import (
    ASKS_AGAIN,
    FOLLOWS,
    GOING_ON,
    MORE_TICKS,
    MUCH_MORE,
    REWORDED,
    STILL,
    TIMES,
    TOO,
    VIEW_SAID,
)
from service.grammar.engine import Language
from service.grammar.parse_types import Ambiguous, Parse, Understood
from service.grammar.said_before import shape
from service.grammar.sentences import Unsayable
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Adjust, Degree, Replace

MAX_TIMES = 10
"""How often a request is repeated at most."""

MAX_REPEATED = 50
"""How many actions come of that at most."""

MAX_WORDS = 10
"""Longer sentences name what they are about."""


def read_short(language: Language, text: str, topic: Topic) -> Parse | None:
    """What a short sentence means after the last request or question; None where it is none of these."""
    tokens = without_marks(tokenise(normalise(text), language.data.contractions))
    if not tokens or len(tokens) > MAX_WORDS:
        return None
    answers = language.data.answers
    if topic.asked and answers.beginning(tokens, ASKS_AGAIN) == len(tokens):
        return Understood(text, topic.asked)
    if not topic.request or topic.undone:
        return None
    read = language.data.numbers.read
    numbers = {at: found for at in range(len(tokens)) if (found := read(tokens, at))}
    for concept, meaning in ((TIMES, _times), (MORE_TICKS, _more_ticks)):
        number = answers.meant(tokens, concept, numbers)
        if isinstance(number, int) and (actions := meaning(topic.request, number)):
            return Understood(text, actions)
    end, beginning = answers.longest(tokens, 0, REWORDED)
    if beginning is not None and end < len(tokens):
        said = f"{beginning} {normalise(text)[tokens[end].start : tokens[-1].end]}"
        parsed = language.read(said, topic, WorkBudget(), asking=False)
        if isinstance(parsed, Understood) and all(isinstance(each, Replace) for each in parsed.actions):
            return Understood(text, parsed.actions)
    degree = answers.meant(tokens, MUCH_MORE)
    if degree is not None and (actions := _to_degree(topic.request, degree)):
        return Understood(text, actions)
    try:
        return (
            _of_view(language, text, tokens, topic)
            or _still(language, text, tokens, topic)
            or _continued(language, text, tokens, topic)
        )
    except (BudgetExceededError, Unsayable):
        return None


def _times(request: Sequence[Action], number: int) -> tuple[Action, ...]:
    """The last change or steps of time so many times; nothing where that is too often."""
    again = all(traits_of(action).undo_step or isinstance(action, Step) for action in request)
    if not again or not 1 <= number <= MAX_TIMES or number * len(request) > MAX_REPEATED:
        return ()
    return (*request,) * number


def _more_ticks(request: Sequence[Action], number: int) -> tuple[Action, ...]:
    """As many ticks more in the direction of the last request."""
    if len(request) != 1 or number < 1:
        return ()
    match request[0]:
        case Step() as step:
            return (replace(step, ticks=number),)
        case Rewind(ticks=int()) as rewind:
            return (replace(rewind, ticks=number),)
        case _:
            return ()


def _to_degree(request: Sequence[Action], degree: str) -> tuple[Action, ...]:
    """The last goal again, a little or a lot more."""
    if len(request) != 1 or not isinstance(request[0], Goal) or request[0].goal not in ("harder", "easier"):
        return ()
    return (replace(request[0], degree=None if degree == "same" else cast(Degree, degree)),)


def _of_view(language: Language, text: str, tokens: Sequence[Token], topic: Topic) -> Parse | None:
    """A request about the view spoken of last: "hide it"."""
    if len(topic.request) != 1 or not isinstance(topic.request[0], Show | Hide):
        return None
    last, answers, plain = topic.request[0], language.data.answers, normalise(text)
    rest = tokens[answers.beginning(tokens, FOLLOWS) : len(tokens) - answers.ending(tokens, TOO)]
    if not rest:
        return None
    sentences = []
    for at in range(len(rest)):
        end, _ = answers.longest(rest, at, VIEW_SAID)
        if end > at:
            before = plain[rest[0].start : rest[at].start]
            after = plain[rest[end - 1].end : rest[-1].end]
            sentences.append(f"{before}{language.sentences.view(last.view)}{after}")
    for said in sentences:
        parsed = language.read(said, ALONE, WorkBudget(), asking=False)
        if isinstance(parsed, Understood) and all(
            isinstance(action, Show | Hide) and action.view == last.view for action in parsed.actions
        ):
            return Understood(text, parsed.actions)
    return None


def _still(language: Language, text: str, tokens: Sequence[Token], topic: Topic) -> Parse | None:
    """A comparison without the word that says it goes on: "a bit harder still"."""
    answers, plain = language.data.answers, normalise(text)
    start, end = answers.beginning(tokens, STILL), len(tokens) - answers.ending(tokens, STILL)
    if start >= end or (start, end) == (0, len(tokens)):
        return None
    said = plain[tokens[start].start : tokens[end - 1].end]
    parsed = language.read(said, topic, WorkBudget(), asking=True)
    readings = [parsed] if isinstance(parsed, Understood) else []
    if isinstance(parsed, Ambiguous):
        readings = [Understood(text, choice.actions) for choice in parsed.choices]
        readings = [each for each in readings if shape(each.actions) == shape(topic.actions)]
    if len(readings) != 1 or not all(isinstance(action, Goal | Adjust) for action in readings[0].actions):
        return None
    return Understood(text, readings[0].actions)


def pick_going_on(language: Language, text: str, topic: Topic, parsed: Parse) -> Parse | None:
    """The reading that goes on with the last change where a sentence has several: "a bit slower still"."""
    tokens = without_marks(tokenise(normalise(text), language.data.contractions))
    answers = language.data.answers
    goes_on = answers.ending(tokens, GOING_ON) or answers.beginning(tokens, GOING_ON)
    if not isinstance(parsed, Ambiguous) or not goes_on or topic.undone:
        return None
    fits = [each for each in parsed.choices if shape(each.actions) == shape(topic.actions)]
    fits = [each for each in fits if all(isinstance(action, Adjust | Goal) for action in each.actions)]
    return Understood(text, fits[0].actions) if len(fits) == 1 else None


def _continued(language: Language, text: str, tokens: Sequence[Token], topic: Topic) -> Parse | None:
    """Another request of the kind of the last one, without its verb: "now as if you were in a hurry"."""
    answers, plain = language.data.answers, normalise(text)
    does = {action.do for action in topic.request}
    template = answers.continues.get(does.pop()) if len(does) == 1 else None
    start = max(answers.beginning(tokens, FOLLOWS), answers.beginning(tokens, STILL))
    end = len(tokens) - answers.ending(tokens, TOO)
    if template is None or start >= end or (not start and end == len(tokens) and topic.kind is not None):
        return None
    said = template.format(said=plain[tokens[start].start : tokens[end - 1].end])
    parsed = language.read(said, topic, WorkBudget(), asking=False)
    alike = isinstance(parsed, Understood) and all(each.do == topic.request[0].do for each in parsed.actions)
    return replace(parsed, text=text) if alike and isinstance(parsed, Understood) else None


def without_marks(tokens: Sequence[Token]) -> Sequence[Token]:
    """The tokens without marks at the end."""
    end = len(tokens)
    while end and not any(char.isalnum() for char in tokens[end - 1].text):
        end -= 1
    return tokens[:end]
