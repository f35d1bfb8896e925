"""Reads sentences that leave out the noun of the things spoken of: "the one in lane 7", "remove two of them".

The noun gets its place, so that the sentence is read as if it had been said in full. Only requests and
questions about things of that kind come of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from service.actions import Action, Ask
from service.grammar.answer_words import (
    ALL_OF_THEM,
    COUNTED,
    ENDING_NOUN,
    FOLLOWS,
    NOUN,
    OF_THEM,
    OF_THINGS,
    TOO,
    TWO,
)
from service.grammar.engine import Language
from service.grammar.lattice import GLUE, Lattice
from service.grammar.noun_phrases import QUANTITY
from service.grammar.parse_types import Parse, Understood
from service.grammar.references import REFERS
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import Topic
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Add, Remove, Replace, SetCount

_MORE = ("more", "another")
"""Values of the quantities that add to what is there."""

MAX_WORDS = 14
"""Longer sentences name what they are about."""


def kind_spoken_of(topic: Topic) -> str | None:
    """The one kind of thing that the question asked, the last request or the things spoken of are about."""
    if topic.asked_kind is not None:
        return topic.asked_kind
    kinds = kinds_of(topic.actions)
    if not kinds:
        return None
    return kinds.pop() if len(kinds) == 1 else None


def kinds_of(actions: Sequence[Action]) -> set[str]:
    """The kinds of thing that some actions are about; of what was replaced, what it is now."""
    kinds: set[str] = set()
    for action in actions:
        if isinstance(action, Ask) and action.change:
            kinds |= kinds_of([each for each in action.change if isinstance(each, Add | Remove)])
        kind = action.by if isinstance(action, Replace) else getattr(action, "kind", None)
        if kind is not None:
            kinds.add(kind)
    return kinds


def read_asked(language: Language, text: str, topic: Topic) -> Parse | None:
    """A sentence about the kind spoken of, or about two things: "how many are left?", "swap them"."""
    tokens = _tokens(language, text)
    answers, kind = language.data.answers, kind_spoken_of(topic)
    names = language.sentences.names(kind) if kind is not None else {}
    said = None
    if names and (template := answers.meant(tokens, OF_THINGS)) is not None:
        said = str(template).format(**names)
    elif (both := two_things(topic)) is not None and (template := answers.meant(tokens, TWO)) is not None:
        said = str(template).format(*both)
    ordinals = [token for token in tokens if language.data.numbers.ordinal(token) is not None]
    pointed = said is None and len(ordinals) == 1 and bool(answers.one_after)
    if pointed:
        plain, end = normalise(text), ordinals[0].end
        said = answers.one_after[0].format(said=plain[:end]) + plain[end : tokens[-1].end]
    if said is None:
        return None
    try:
        meant = language.read(said, topic, WorkBudget(), asking=False)
    except BudgetExceededError:
        return None
    if not isinstance(meant, Understood) or (pointed and not all(map(_names_thing, meant.actions))):
        return None
    return replace(meant, text=text)


def _names_thing(action: Action) -> bool:
    where = getattr(action, "where", None)
    return where is not None and where.id is not None


def _tokens(language: Language, text: str) -> Sequence[Token]:
    """The words of a text, without marks at the end."""
    tokens = tokenise(normalise(text), language.data.contractions)
    while tokens and not any(char.isalnum() for char in tokens[-1].text):
        tokens = tokens[:-1]
    return tokens


def read_of_things(language: Language, text: str, topic: Topic, *, counted: bool = False) -> Parse | None:
    """What a sentence says of the kind of thing spoken of last; None where it says nothing of it.

    `counted`: only how many there shall be, for sentences that begin as a correction.
    """
    kind = kind_spoken_of(topic)
    names = language.sentences.names(kind) if kind is not None else {}
    if kind is None or not names:
        return None
    tokens = _tokens(language, text)
    if not tokens or len(tokens) > MAX_WORDS:
        return None
    work = WorkBudget()
    try:
        full = _InFull(language, text, tokens, topic, names)
        for said in dict.fromkeys(full.counted() if counted else full.sentences()):
            meant = language.read(said, topic, work, asking=False)
            if (
                isinstance(meant, Understood)
                and _all_of(kind, meant.actions)
                and _sure(language, text, topic, meant)
            ):
                return replace(meant, text=text)
    except BudgetExceededError:
        return None
    return None


def _sure(language: Language, text: str, topic: Topic, meant: Understood) -> bool:
    """Whether things are added only at a place, and by a verb or after others were.

    "Add one in lane 5" is another of them; "add three" may be three of anything.
    """
    adds = any(isinstance(action, Add) for action in meant.actions)
    if not adds:
        return True
    scan = language.scan(_tokens(language, text))
    if any(edge.concept == QUANTITY and edge.sense.value in _MORE for edge in scan.all()):
        return True
    placed = all(getattr(action, "where", None) is not None for action in meant.actions)
    return placed and (
        says_verb(language, text) or all(isinstance(action, Add | SetCount) for action in topic.actions)
    )


def _all_of(kind: str, actions: Sequence[Action]) -> bool:
    """Whether all of some actions are about things of a kind, and of no other."""
    return all(
        (getattr(action, "kind", None) == kind)
        or (isinstance(action, Ask) and bool(action.change) and kinds_of([action]) == {kind})
        for action in actions
    )


class _InFull:
    """One sentence, with the noun put in each place where it may have been left out."""

    def __init__(
        self,
        language: Language,
        text: str,
        tokens: Sequence[Token],
        topic: Topic,
        names: Mapping[str, str],
    ) -> None:
        self._language = language
        self._answers = language.data.answers
        self._plain = normalise(text)
        self._topic = topic
        self._names = names
        start = self._answers.beginning(tokens, FOLLOWS)
        self._tokens = tokens[start : len(tokens) - self._answers.ending(tokens, TOO)] or tokens
        read = language.data.numbers.read
        self._numbers = {at: found for at in range(len(tokens)) if (found := read(self._tokens, at))}

    def sentences(self) -> Iterator[str]:
        """The sentences in full, in the order in which they are tried."""
        yield from self.counted()
        yield from self._of_them(self._tokens)
        yield from self._with_noun(self._tokens)
        if self._answers.ending(self._tokens, ENDING_NOUN):
            yield self._joined(self._tokens, len(self._tokens), len(self._tokens), self._names["one"])

    def counted(self) -> Iterator[str]:
        """How many there shall be: "set it to four"."""
        about = self._topic.asked_kind is not None or all(
            isinstance(action, Add | Remove | SetCount)
            or (isinstance(action, Ask) and action.about == "scene")
            for action in self._topic.actions
        )
        counted = self._answers.meant(self._tokens, COUNTED, self._numbers) if about else None
        if counted is not None and tuple(counted.values()) != (
            1,
        ):  # "make it one" may be another of its kind
            ((form, count),) = counted.items()
            yield str(self._answers.counted_things[form]).format(count=count, **self._names)

    def _of_them(self, tokens: Sequence[Token]) -> Iterator[str]:
        """ "Half of them", "two of them": of all things of the kind, where these are all there are."""
        if self._topic.things and (self._topic.others or len(self._topic.things) < 2):
            return
        for at in range(1, len(tokens)):
            end, template = self._answers.longest(tokens, at, OF_THEM)
            # After some were taken away "them" are not what is left, but "two of them" are of these.
            whole = self._language.data.answers.longest(tokens, at, ALL_OF_THEM)[0] > at
            if end > at and (self._topic.things or not whole or _asked(self._topic)):
                yield self._joined(tokens, at, end, str(template).format(**self._names))

    def _with_noun(self, tokens: Sequence[Token]) -> Iterator[str]:
        """ "One in lane 5", "the ones on the left", "take two away"."""
        scan = self._language.scan(tokens)
        for at in range(len(tokens)):
            end, nouns = self._answers.longest(tokens, at, NOUN)
            refers = any(edge.start < end and at < edge.end for edge in scan.all() if edge.concept == REFERS)
            for noun in nouns if end > at and not refers else ():
                yield self._joined(tokens, at, end, str(noun).format(**self._names))
        for at in range(len(tokens)):
            found = self._language.data.numbers.read(tokens, at)
            if found is None or not isinstance(found.value, int) or found.value < 1:
                continue
            if not _in_phrase(scan, at, found.end):
                noun = self._names["one" if found.value == 1 else "many"]
                yield self._joined(tokens, found.end, found.end, noun)

    def _joined(self, tokens: Sequence[Token], start: int, end: int, words: str) -> str:
        """The sentence with words in the place of some tokens."""
        before = self._plain[tokens[0].start : tokens[start - 1].end] if start else ""
        after = self._plain[tokens[end].start : tokens[-1].end] if end < len(tokens) else ""
        return " ".join(part for part in (before, words, after) if part)


def _asked(topic: Topic) -> bool:
    return all(isinstance(action, Ask) for action in topic.actions)


def says_verb(language: Language, text: str) -> bool:
    """Whether a sentence has a verb of a request; words that may as well say nothing are none ("in")."""
    edges = list(language.scan(_tokens(language, text)).all())
    empty = {edge.start for edge in edges if edge.concept in (GLUE, "prep")}
    return any(edge.concept.startswith("v.") and edge.start not in empty for edge in edges)


def _in_phrase(scan: Lattice, start: int, end: int) -> bool:
    """Whether words are a part of a longer phrase, as the number of a lane is."""
    return any(
        edge.start <= start and end <= edge.end and edge.end - edge.start > end - start
        for edge in scan.all()
        if edge.concept != GLUE
    )


def two_things(topic: Topic) -> tuple[str, str] | None:
    """The two things that "them" are: those spoken of last, or that one and the one before it."""
    both = topic.things if len(topic.things) == 2 else (*topic.before, *topic.things)
    return (both[0], both[1]) if len(both) == 2 else None
