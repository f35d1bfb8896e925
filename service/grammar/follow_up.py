"""Reads sentences that lean on the one before: "and in lane 5?", "the same on the right", "I said three".

What is said stands in the place of a part of the last request, or continues it, as it would within one
sentence. Nothing else changes: the outcome is as many requests, of the same kinds. A correction takes the
last request back first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from service.actions import Action
from service.actions.table import traits_of
from service.grammar.answer_words import AFTER, BEFORE, CORRECTS, FOLLOWS, INSTEAD, TOO, TOTAL
from service.grammar.engine import Language
from service.grammar.incomplete import ask_elsewhere, ask_what_is_missing
from service.grammar.last_request import asked_anew
from service.grammar.listed_options import choose_listed
from service.grammar.parse_types import Ambiguous, Choice, Parse, Refused, Understood
from service.grammar.repairs import about_the_same
from service.grammar.said_before import can_be_corrected, done_anew, said_before
from service.grammar.sentences import Unsayable
from service.grammar.setting_talk import read_of_setting
from service.grammar.short_talk import read_short
from service.grammar.same_request import to_other_things
from service.grammar.thing_talk import read_asked, read_of_things
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import Topic
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Add, SetCount

MAX_SHORT = 4
"""A sentence of so many words after "and" may ask the last question once more."""

MAX_WORDS = 15
"""Longer sentences say themselves what they are about."""

Actions: TypeAlias = tuple[Action, ...]


def read_in_conversation(language: Language, text: str, topic: Topic, parsed: Parse) -> Parse:
    """What a sentence means after the one before it; `parsed` is what it means by itself.

    A sentence that is understood by itself means that, but for a short one that goes on with a question:
    "and left?" asks the same of the left.
    """
    alone = isinstance(parsed, Refused) and parsed.reason == "not_understood"
    if alone and (listed := choose_listed(language, text, topic)) is not None:
        return listed
    if alone or _asks(parsed):
        of_setting = read_of_setting(language, text, topic, parsed)
        if of_setting is not None:
            return of_setting
    if alone and (said := read_short(language, text, topic) or read_asked(language, text, topic)):
        return said
    if not topic.actions or topic.undone:
        return _completed(language, text, topic, parsed)
    if isinstance(parsed, Understood) and _takes_the_place(language, text, topic, parsed):
        return replace(parsed, actions=done_anew(topic, parsed.actions))
    if isinstance(parsed, Understood | Refused) and (
        elsewhere := ask_elsewhere(language, text, topic, parsed)
    ):
        return elsewhere
    if not (alone or _goes_on_asking(topic, parsed)):
        return _completed(language, text, topic, parsed)
    tokens = tokenise(normalise(text), language.data.contractions)
    if len(tokens) > MAX_WORDS:
        return parsed
    leaning = _Leaning(language, text, tokens, topic)
    try:
        found = leaning.read()
    except BudgetExceededError:
        return parsed
    if alone:
        of_things = None if leaning.corrects else read_of_things(language, text, topic)
        return found or of_things or _completed(language, text, topic, parsed)
    assert isinstance(parsed, Understood)
    return _after_question(language, leaning, found, parsed)


def _completed(language: Language, text: str, topic: Topic, parsed: Parse) -> Parse:
    """The question about what a request lacks; else what it means by itself."""
    lacking = isinstance(parsed, Refused) and parsed.reason in ("not_understood", "negation")
    return (ask_what_is_missing(language, text, topic) if lacking else None) or parsed


def _asks(parsed: Parse) -> bool:
    return isinstance(parsed, Understood) and all(traits_of(action).is_question for action in parsed.actions)


def _takes_the_place(language: Language, text: str, topic: Topic, parsed: Understood) -> bool:
    """Whether a request says at its end that it is meant instead of the last one: "left, I mean"."""
    if not topic.steps or not about_the_same(topic.actions, parsed.actions):
        return False
    tokens = _without_marks(tokenise(normalise(text), language.data.contractions))
    return language.data.answers.ending(tokens, INSTEAD) > 0


def _goes_on_asking(topic: Topic, parsed: Parse) -> bool:
    asked = all(traits_of(action).is_question for action in topic.actions)
    return asked and isinstance(parsed, Understood)


def _after_question(language: Language, leaning: _Leaning, found: Parse | None, alone: Understood) -> Parse:
    """What a sentence means that goes on with a question and is a request by itself.

    "And left?" asks; "and left" may be either, so it is asked about. One that asks what cannot be found out
    is refused: it must not act.
    """
    if not leaning.goes_on or all(traits_of(action).is_question for action in alone.actions):
        return alone if found is None or not leaning.goes_on else found
    if found is None:
        meant = asked_anew(leaning.done, alone.actions)
        found = None if meant is None else Understood(alone.text, meant)
    asks = alone.text.rstrip().endswith("?")
    if found is None:
        counted = any(isinstance(action, Add) and action.count > 1 for action in alone.actions)
        return leaning.refusal(alone.text) if asks and leaning.short and not counted else alone
    return found if asks else _which(language, alone.text, found, alone)


def _which(language: Language, text: str, found: Parse, alone: Understood) -> Parse:
    """The question whether the last question goes on or a request is made."""
    if not isinstance(found, Understood):
        return found
    readings = (found.actions, alone.actions)
    try:
        choices = tuple(Choice(language.sentence(actions), actions) for actions in readings)
    except Unsayable:
        return alone
    return Ambiguous(text, language.data.messages["which"], choices)


class _Leaning:
    """One sentence that may lean on the one before it."""

    def __init__(self, language: Language, text: str, tokens: Sequence[Token], topic: Topic) -> None:
        self._language = language
        self._answers = language.data.answers
        self._text = text
        self._plain = normalise(text)
        self._tokens = _without_marks(tokens)
        self._topic = topic
        self._spoken_of = replace(topic, actions=(), kind=None, removed=False, undone=False)
        self._work = WorkBudget()
        follows = self._answers.beginning(self._tokens, FOLLOWS)
        self.done = topic.actions
        asked = all(traits_of(action).is_question for action in topic.actions)
        self._asks_on = asked and text.rstrip().endswith("?")
        self.corrects = self._answers.beginning(self._tokens, CORRECTS) > 0
        """whether it begins as what corrects the last request"""
        self.goes_on = follows > 0
        """whether it begins as what goes on with the last request"""
        self.short = len(self._tokens) - follows <= MAX_SHORT

    def refusal(self, text: str) -> Refused:
        """The refusal of all of it."""
        said, messages = text.strip(), self._language.data.messages
        return Refused(
            text, "not_understood", messages["not_understood"].format(phrases=f'"{said}"'), (said,)
        )

    def read(self) -> Parse | None:
        """The reading; None where the sentence does not lean on another, or fits nowhere."""
        tokens, answers = self._tokens, self._answers
        read = self._language.data.numbers.read
        numbers = {at: found for at in range(min(len(tokens), MAX_SHORT)) if (found := read(tokens, at))}
        follows = answers.beginning(tokens, FOLLOWS)
        corrects = answers.beginning(tokens, CORRECTS, numbers)
        instead, too = answers.ending(tokens, INSTEAD), answers.ending(tokens, TOO)
        if not (follows or corrects or instead or too or self._asks_on):
            return None
        correcting = bool(corrects > follows or instead)
        start = corrects if corrects > follows else follows
        rest = tokens[start : len(tokens) - max(instead, too)]
        if not rest:
            return None
        done = self._topic.actions
        if correcting and not can_be_corrected(self._topic):
            return None
        if correcting and (total := self._total(rest)) is not None:
            return total
        base = said_before(self._language, self._topic, self._work)
        if base is None or not all(traits_of(action).amendable for action in done):
            return None
        if (other := to_other_things(self._language, self._written(rest), self._spoken_of, done)) is not None:
            return Understood(self._text, self._whole(other, correcting))
        meant = self._amended(base, done, rest, goes_on=not correcting)
        meant = meant or self._elsewhere(done, rest)
        if meant is not None:
            return Understood(self._text, self._whole(meant, correcting))
        return self._question(base, done, rest, correcting)

    def _total(self, rest: Sequence[Token]) -> Parse | None:
        """What "make it twelve" means of things that were added: how many there shall be of their kind.

        Where there were others, so many more may be meant: that is asked about, unless others would go.
        """
        number, done = self._language.data.numbers.read(rest, 0), self._topic.actions
        if not self._answers.beginning(self._tokens, TOTAL) or number is None or number.end != len(rest):
            return None
        if len(done) != 1 or not isinstance(number.value, int) or number.value < 1:
            return None
        if not isinstance(done[0], Add | SetCount) or getattr(done[0], "where", None) is not None:
            return None
        total: Actions = (SetCount(kind=done[0].kind, count=number.value),)
        if isinstance(done[0], SetCount) or not self._topic.others:
            return Understood(self._text, total)
        anew = done_anew(self._topic, (Add(kind=done[0].kind, count=number.value),))
        if number.value <= self._topic.others:
            return Understood(self._text, anew)
        told = tuple(Choice(self._language.sentence(each), each) for each in (total, anew))
        return Ambiguous(self._text, self._language.data.messages["which"], told)

    def _whole(self, meant: Actions, correcting: bool) -> Actions:
        return done_anew(self._topic, meant) if correcting else meant

    def _amended(self, base: str, done: Actions, rest: Sequence[Token], *, goes_on: bool) -> Actions | None:
        """The last request with what was said in the place of a part of it, or added to it."""
        if goes_on and self._tokens[0].text in self._language.joiners:
            parsed = self._read(f"{base} {self._written(self._tokens)}")
            if (
                parsed is not None
                and parsed[: len(done)] == done
                and shape(parsed[len(done) :]) == shape(done)
            ):
                return parsed[len(done) :]
        for part in self._parts(rest):
            said = self._written(part)
            for whole in (f"{base}, {self._answers.replaces} {said}", f"{base} {said}"):
                parsed = self._read(whole)
                if parsed is not None and parsed != done and self._alike(parsed, done, goes_on=goes_on):
                    return parsed
        return None

    @staticmethod
    def _alike(parsed: Actions, done: Actions, *, goes_on: bool) -> bool:
        """Whether both are as many requests of the same kinds; a correction may be another of its group."""
        if goes_on:
            return shape(parsed) == shape(done)
        return len(parsed) == len(done) and about_the_same(parsed, done)

    def _elsewhere(self, done: Actions, rest: Sequence[Token]) -> Actions | None:
        """The last request at another place, where the place as it was said cannot be replaced by words."""
        if not all(getattr(action, "where", None) for action in done):
            return None
        anywhere = _anywhere(done)
        try:
            base = self._language.sentence(anywhere)
        except Unsayable:
            return None
        parsed = self._read(f"{base} {self._written(rest)}")
        if (
            parsed is None
            or len(parsed) != len(done)
            or not all(getattr(each, "where", None) for each in parsed)
        ):
            return None
        return parsed if _anywhere(parsed) == anywhere and parsed != done else None

    def _question(self, base: str, done: Actions, rest: Sequence[Token], correcting: bool) -> Parse | None:
        """The question which part of the last request is meant, where there are several."""
        text = f"{base}, {self._answers.replaces} {self._written(rest)}"
        parsed = self._language.read(text, self._spoken_of, self._work, asking=True)
        if not isinstance(parsed, Ambiguous):
            return None
        meant = [choice.actions for choice in parsed.choices if shape(choice.actions) == shape(done)]
        try:
            choices = [self._whole(actions, correcting) for actions in meant]
            told = tuple(Choice(self._language.sentence(actions), actions) for actions in choices)
        except Unsayable:
            return None
        return Ambiguous(self._text, parsed.question, told) if len(told) > 1 else None

    def _parts(self, tokens: Sequence[Token]) -> Iterator[Sequence[Token]]:
        """The tokens, and then without the words before and after that say nothing."""
        yield tokens
        start = self._answers.beginning(tokens, BEFORE)
        end = len(tokens) - self._answers.ending(tokens, AFTER)
        if start < end and (start, end) != (0, len(tokens)):
            yield tokens[start:end]

    def _read(self, text: str) -> Actions | None:
        parsed = self._language.read(text, self._spoken_of, self._work, asking=False)
        return parsed.actions if isinstance(parsed, Understood) else None

    def _written(self, tokens: Sequence[Token]) -> str:
        return self._plain[tokens[0].start : tokens[-1].end]


def _anywhere(actions: Sequence[Any]) -> Actions:
    """The actions without their places."""
    return tuple(replace(action, where=None) for action in actions)


def shape(actions: Sequence[Action]) -> list[object]:
    """What kinds of request some actions are."""
    return [
        (action.do, getattr(action, "about", None), getattr(action, "parameter", None)) for action in actions
    ]


def _without_marks(tokens: Sequence[Token]) -> Sequence[Token]:
    """The tokens without marks at the end."""
    end = len(tokens)
    while end and not any(char.isalnum() for char in tokens[end - 1].text):
        end -= 1
    return tokens[:end]
