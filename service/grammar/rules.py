"""Reads rules: "every 10 ticks add a car", "pause when something is closer than 10 m", "forget all rules".

A rule is a request with a condition at its beginning or end, both of which are read whole: what stands
beside the condition is a sentence that means actions a rule can do. It is tried where a sentence is refused
otherwise, so that no sentence loses a meaning. Where a sentence may be several rules, it is asked about.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias, get_args

from pydantic import ValidationError

from service.actions import Action, Pause, Resume, dump, load
from service.grammar.accounting import WHOLE
from service.grammar.clause_patterns import Sentence
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.parse_types import Ambiguous, Choice, Correction, Parse, Refused, Understood
from service.grammar.paths import SEPARATOR
from service.grammar.rule_words import COMMAND, JOINT, KEEP, ONCE, PARTS, TIMES, UNTIL, WHEN, RuleWords
from service.grammar.sentences import Unsayable
from service.grammar.tokens import Token, normalise, tokenise, with_text
from service.grammar.topic import Topic
from service.grammar.typos import Typos
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import RuleAction

if TYPE_CHECKING:
    from service.grammar.engine import Language

Readings: TypeAlias = list[tuple[Action, ...]]

MAX_PARTS = 3
"""How many sentences with rules one text may have."""
MATCH_STEPS = 20
"""What looking for a condition at one token costs."""
_STOP = "stop"
_RULE_ACTIONS = get_args(RuleAction)


@dataclass(frozen=True, slots=True)
class _Rest:
    """What is left of a sentence: the tokens `[start, end)` of a request, and the parts beside it."""

    start: int
    end: int
    parts: Mapping[str, Any]


class RuleReader:
    """Reads the rules of one language."""

    def __init__(self, language: Language, words: RuleWords) -> None:
        self._language = language
        self._words = words

    @cached_property
    def _typos(self) -> Typos:
        numbers = self._language.data.numbers.words()
        known = self._language.data.lexicon.words | numbers | self._words.patterns.words
        return Typos(self._language.data.typos, known, numbers, lambda one, other: one == other)

    def read(self, text: str, topic: Topic, work: WorkBudget) -> Parse | None:
        """What a sentence with rules means, or which of several is meant; None for any other."""
        plain = normalise(text)
        tokens = tokenise(plain, self._language.data.contractions)
        if not tokens or not self._words.begins:
            return None
        corrections = []
        for at, token in enumerate(tokens):
            if (meant := self._meant(token.text)) is not None:
                corrections.append(Correction(plain[token.start : token.end], meant))
                tokens[at] = with_text(token, meant)
        if self._words.begins.isdisjoint(token.text for token in tokens):
            return None
        if self._has_words_for_others(tokens):
            return None
        numbers = self._language.data.numbers
        said = Sentence(
            tokens,
            {at: found for at in range(len(tokens)) if (found := numbers.read(tokens, at)) is not None},
            {at: nth for at, token in enumerate(tokens) if (nth := numbers.ordinal(token)) is not None},
        )
        reading = _Reading(self._language, self._words, plain, said, topic, work)
        try:
            readings = reading.all()
        except BudgetExceededError:
            return None
        if len(readings) == 1:
            return Understood(text, readings[0], tuple(corrections))
        return self._which(text, readings)

    def _has_words_for_others(self, tokens: Sequence[Token]) -> bool:
        """Whether there are words that no rule has a use for, and that turn what it says: "instead of"."""
        return any(
            edge.concept == WHOLE
            and self._words.begins.isdisjoint(token.text for token in tokens[edge.start : edge.end])
            for starting in self._language.scan(tokens).edges
            for edge in starting
        )

    def _meant(self, word: str) -> str | None:
        if not word.isalpha() or self._language.data.knows(word) or word in self._words.patterns.words:
            return None
        return self._typos.repair(word)

    def _which(self, text: str, found: Readings) -> Ambiguous | None:
        try:
            choices = tuple(Choice(self._language.sentence(actions), actions) for actions in found)
        except Unsayable:
            return None
        return Ambiguous(text, self._language.data.messages["which"], choices) if choices else None


class _Reading:
    """One text on its way."""

    def __init__(
        self, language: Language, words: RuleWords, plain: str, said: Sentence, topic: Topic, work: WorkBudget
    ) -> None:
        self._language, self._words, self._plain, self._said = language, words, plain, said
        self._topic, self._work = topic, work
        self._lattice: Lattice = language.scan(said.tokens)
        self._known: dict[tuple[int, int, bool], Readings] = {}

    def all(self) -> Readings:
        """All that the text may mean; nothing where there is no rule in it."""
        sentences = list(self._sentences())
        if len(sentences) > MAX_PARTS:
            return []
        whole: Readings = [()]
        rules = False
        for start, end in sentences:
            found = self._with_rules(start, end, MAX_PARTS)
            rules = rules or bool(found)
            found = found or self._plainly(start, end)
            whole = [(*before, *after) for before in whole for after in found]
        return _distinct(whole) if rules else []

    def _sentences(self) -> Iterator[tuple[int, int]]:
        """The stretches between full stops."""
        start, size = 0, len(self._said.tokens)
        for at in range(size + 1):
            if at == size or any(
                edge.concept == SEPARATOR and edge.sense.value == _STOP and edge.end == at + 1
                for edge in self._lattice.edges[at]
            ):
                if start < at:
                    yield start, at
                start = at + 1

    def _with_rules(self, start: int, end: int, parts: int) -> Readings:
        """What a sentence means that is a rule, or ends in one after other requests."""
        found = self._rule(start, end)
        for at in range(start + 1, end - 1) if parts > 1 else ():
            for edge in self._lattice.edges[at]:
                if edge.concept != SEPARATOR or edge.end >= end:
                    continue
                # "Stop, then go for two seconds" contradicts itself.
                if last := [each for each in self._rule(edge.end, end) if not isinstance(each[0], Resume)]:
                    first = self._with_rules(start, at, parts - 1) or self._plainly(start, at)
                    found += [(*one, *other) for one in first for other in last]
        return _distinct(found)

    def _rule(self, start: int, end: int) -> Readings:
        """What a stretch means that is one rule, or a sentence about rules."""
        closing = self._closing(start, end)
        found: Readings = []
        for at in self._opening(start, end):
            found += [load([value]) for stop, value in self._at(COMMAND, at) if stop in closing]
        for rest in self._rests(_Rest(start, end, {})):
            found += self._of_rest(rest)
        return _distinct(found)

    def _rests(self, rest: _Rest) -> Iterator[_Rest]:
        """What may be left when conditions are taken off both ends."""
        opening, closing = self._opening(rest.start, rest.end), self._closing(rest.start, rest.end)
        for part in PARTS:
            if part in rest.parts or (part in (WHEN, ONCE) and rest.parts.keys() & {WHEN, ONCE}):
                continue
            for begin in opening:
                for stop, value in self._at(part, begin):
                    if stop <= rest.end:
                        first = self._joined(stop, rest.end)
                        yield from self._left(_Rest(first, rest.end, {**rest.parts, part: value}))
            for at in range(rest.start + 1, rest.end):
                if part == TIMES and rest.parts.keys() & {WHEN, ONCE} and not self._follows_mark(at):
                    continue  # "turn left twice every ten ticks" turns twice each time
                for stop, value in self._at(part, at):
                    if stop in closing:
                        yield from self._left(_Rest(rest.start, at, {**rest.parts, part: value}))

    def _follows_mark(self, at: int) -> bool:
        return any(e.end == at and e.concept == SEPARATOR for e in self._lattice.edges[at - 1])

    def _left(self, rest: _Rest) -> Iterator[_Rest]:
        yield rest
        yield from self._rests(rest)

    def _at(self, part: str, at: int) -> list[tuple[int, Any]]:
        self._work.spend(MATCH_STEPS)
        longest: dict[str, tuple[int, Any]] = {}
        for stop, value in self._words.at(part, self._said, at):
            key = repr(value)
            if key not in longest or longest[key][0] < stop:
                longest[key] = stop, value
        return list(longest.values())

    def _of_rest(self, rest: _Rest) -> Readings:
        """The rules that a request and its conditions are."""
        kept = max((end for end, _ in self._at(KEEP, rest.start)), default=rest.start)
        keeps = rest.start < kept < rest.end
        bodies = list(self._plainly(kept, rest.end, keeps=True)) if keeps else []
        found = [made for body in bodies for made in self._made(body, rest.parts, keeps=True)]
        if rest.start < rest.end:
            bodies = self._plainly(rest.start, rest.end)
            if any(value["fact"] == "after" for _, value in self._at(UNTIL, rest.end)):
                # "Pause for 3 seconds" says how long the pause lasts, and not how long the rule stands.
                bodies = [body for body in bodies if not isinstance(body[-1], Pause)]
            found += [made for body in bodies for made in self._made(body, rest.parts, keeps=False)]
        return found

    def _made(self, body: tuple[Action, ...], parts: Mapping[str, Any], *, keeps: bool) -> Readings:
        """The actions of a rule, if it can be one."""
        when, until, times = parts.get(WHEN) or parts.get(ONCE), parts.get(UNTIL), parts.get(TIMES)
        if when is None and until is not None and not keeps and body == (Resume(),):
            return _loaded(
                [*dump(body), {"do": "trigger", "when": until, "then": [{"do": "pause"}], "times": 1}]
            )
        if not all(isinstance(action, _RULE_ACTIONS) for action in body):
            return []
        if keeps and when is not None and when["fact"] != "every":
            return []
        if when is None:
            if not keeps or until is None:
                return []
            when = {"fact": "every", "ticks": 1}
        if ONCE in parts:
            if times is not None:
                return []
            times = 1
        rule = {"do": "trigger", "when": when, "then": dump(body)}
        return _loaded(
            [rule | {key: value for key, value in ((UNTIL, until), (TIMES, times)) if value is not None}]
        )

    def _plainly(self, start: int, end: int, *, keeps: bool = False) -> Readings:
        """What a stretch means as a sentence of its own; each of the choices where it is asked about."""
        key = start, end, keeps
        if key not in self._known:
            self._known[key] = self._read(start, end, keeps=keeps)
        return self._known[key]

    def _read(self, start: int, end: int, *, keeps: bool) -> Readings:
        tokens = self._said.tokens
        text = self._plain[tokens[start].start : tokens[end - 1].end]
        if keeps:
            text = f"{self._words.asks_as} {text}"
        parsed = self._language.read(text, self._topic, self._work, asking=True)
        if isinstance(parsed, Refused):
            return []
        if isinstance(parsed, Understood):
            return [parsed.actions]
        choices = [choice.actions for choice in parsed.choices]
        # "Keep adding potholes" says how many there shall be in the end, and so one at a time.
        return choices[:1] if keeps and all(map(_adds_one, choices[:1])) else choices

    def _joined(self, at: int, end: int) -> int:
        """Past what stands between a condition and a request."""
        return max([stop for stop, _ in self._at(JOINT, at) if stop <= end], default=at)

    def _opening(self, start: int, end: int) -> list[int]:
        """The places to which nothing but words that say nothing lead from the start."""
        places = {start}
        for at in range(start, end):
            if at in places:
                places.update([e.end for e in self._lattice.edges[at] if e.end <= end and _is_idle(e)])
        return sorted(places - {end})

    def _closing(self, start: int, end: int) -> set[int]:
        """The places from which nothing but words that say nothing leads to the end."""
        places = {end}
        for at in range(end - 1, start, -1):
            if any(e.end in places and _is_idle(e) for e in self._lattice.edges[at]):
                places.add(at)
        return places


def _is_idle(edge: Edge) -> bool:
    return edge.concept in (GLUE, SEPARATOR) and not edge.sense.form


def _adds_one(actions: tuple[Action, ...]) -> bool:
    return all(getattr(action, "count", None) == 1 for action in actions)


def _loaded(values: Sequence[Mapping[str, Any]]) -> Readings:
    try:
        return [load(list(values))]
    except ValidationError:
        return []


def _distinct(readings: Readings) -> Readings:
    return list(dict.fromkeys(readings))
