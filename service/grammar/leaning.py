"""One sentence that leans on the one before: what it says stands in the place of a part of that, or goes on.

Nothing else changes: the outcome is as many requests, of the same kinds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from service.actions import Action
from service.actions.table import traits_of
from service.grammar.answer_words import AFTER, BEFORE, CORRECTS, FOLLOWS, INSTEAD, TOO, TOTAL
from service.grammar.engine import Language
from service.grammar.parse_types import Ambiguous, Choice, Parse, Refused, Understood
from service.grammar.references import REFERS
from service.grammar.repairs import about_the_same
from service.grammar.said_before import can_be_corrected, done_anew, said_before, shape
from service.grammar.same_request import to_other_things
from service.grammar.sentences import Unsayable
from service.grammar.short_talk import without_marks
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import Topic
from service.grammar.work_budget import WorkBudget
from sim.actions import Add, SetCount

MAX_SHORT = 4
"""A sentence of so many words after "and" may ask the last question once more."""

Actions: TypeAlias = tuple[Action, ...]


class Leaning:
    """One sentence that may lean on the one before it."""

    def __init__(self, language: Language, text: str, tokens: Sequence[Token], topic: Topic) -> None:
        self._language = language
        self._answers = language.data.answers
        self._text = text
        self._plain = normalise(text)
        self._tokens = without_marks(tokens)
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

    @property
    def text(self) -> str:
        """All of it, as it was said."""
        return self._text

    @property
    def corrected(self) -> str:
        """What is said behind the words that begin a correction."""
        start = self._answers.beginning(self._tokens, CORRECTS)
        return self._written(self._tokens[start:]) if start < len(self._tokens) else ""

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
        denies = any(token.text in answers.denies for token in tokens)
        if not (follows or corrects or instead or too or denies or self._asks_on):
            return None
        correcting = bool(corrects > follows or instead)
        start = corrects if corrects > follows else follows
        if not follows and (denied := self._denied()) is not None:
            return Understood(self._text, done_anew(self._topic, denied))
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
        named = self._written(rest)
        words = self._language.data.numbers
        short = words.read(rest, 0) is not None or words.ordinal(rest[-1]) is not None
        after = self._answers.one_after if short else ()
        other = to_other_things(self._language, named, self._spoken_of, done, after)
        if other is None and self._points(rest):
            return None
        if other is not None and other != done:
            return Understood(self._text, self._whole(other, correcting))
        meant = self._amended_alike(base, done, rest, goes_on=not correcting)
        meant = meant or self._elsewhere(done, rest)
        if meant is not None:
            return Understood(self._text, self._whole(meant, correcting))
        return self._question(base, done, rest, correcting)

    def _points(self, rest: Sequence[Token]) -> bool:
        """Whether all that is said points at something ("the first"): that is added by nothing."""
        if not any(isinstance(action, Add | SetCount) for action in self.done):
            return False
        sentences = (
            self._written(rest),
            *(each.format(said=self._written(rest)) for each in self._answers.one_after),
        )
        for said in sentences[:2]:
            tokens = tokenise(normalise(said), self._language.data.contractions)
            if any(
                edge.concept == REFERS and edge.start == 0 and edge.end == len(tokens)
                for edge in self._language.scan(tokens).all()
            ):
                return True
        return False

    def _denied(self) -> Actions | None:
        """The last request with one part in the place of another: "five, not three", "not cars, potholes"."""
        at = next((at for at, token in enumerate(self._tokens) if token.text in self._answers.denies), None)
        base = None
        if at is not None and can_be_corrected(self._topic):
            base = said_before(self._language, self._topic, self._work)
        if at is None or base is None or not all(traits_of(each).amendable for each in self.done):
            return None
        before, after = self._tokens[:at], self._tokens[at + 1 :]
        commas = [place for place, token in enumerate(after) if token.text == ","]
        if before:
            start = self._answers.beginning(before, CORRECTS)
            meant, wrong = self._without_commas(before[start:]), after
        elif commas:
            meant, wrong = after[commas[0] + 1 :], after[: commas[0]]
        else:
            return None
        if not meant or not wrong:
            return None
        said = self._read(f"{base}, {self._answers.replaces} {self._written(wrong)}")
        if said != self.done:
            return None
        return self._amended_alike(base, self.done, meant, goes_on=False)

    @staticmethod
    def _without_commas(tokens: Sequence[Token]) -> Sequence[Token]:
        end = len(tokens)
        while end and tokens[end - 1].text == ",":
            end -= 1
        return tokens[:end]

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

    def _amended_alike(
        self, base: str, done: Actions, rest: Sequence[Token], *, goes_on: bool
    ) -> Actions | None:
        """`_amended`, of each of several equal requests; None where only some of one kind change."""
        times = len(done)
        if times > 1 and len(set(done)) == 1:
            meant = self._amended(self._language.sentence(done[:1]), done[:1], rest, goes_on=goes_on)
            return None if meant is None else meant * times
        meant = self._amended(base, done, rest, goes_on=goes_on)
        if meant is not None and times > 1 and len(set(shape(done))) == 1:
            kept = sum(before == after for before, after in zip(done, meant, strict=False))
            one_kind = len({getattr(each, "kind", None) for each in done}) == 1
            return None if kept and one_kind else meant
        return meant

    def _amended(self, base: str, done: Actions, rest: Sequence[Token], *, goes_on: bool) -> Actions | None:
        """The last request with what was said in the place of a part of it, or added to it."""
        if goes_on and self._tokens[0].text in self._language.joiners:
            parsed = self._read(f"{base} {self._written(self._tokens)}")
            if (
                parsed is not None
                and parsed[: len(done)] == done
                and shape(parsed[len(done) :]) == shape(done)
                and parsed[len(done) :] != done
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
