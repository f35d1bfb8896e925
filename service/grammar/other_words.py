"""Sentences that say in other words what the language has a sentence for, or cannot do for a known reason.

`other_words.yaml` holds them: patterns with places for any words, and what each comes to. A pattern names a
sentence of the language that is read in its place, or what is made of the present state of the road ("double
the cars"), or a question with choices, or the reason why nothing like it can be done. It is tried only where
nothing else reads the sentence, and every word has to fit; so what is not understood stays refused.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic import ValidationError

from service.actions import Action, dump, load
from service.grammar.clause_patterns import Choice as Ways
from service.grammar.clause_patterns import Patterns, Sentence, Slots
from service.grammar.lattice import GLUE
from service.grammar.parse_types import Ambiguous, Choice, Parse, Reason, Refused, Understood
from service.grammar.paths import SEPARATOR
from service.grammar.said_before import take_back_change
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import Topic
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Add, Adjust, Remove, Set, SetCount

if TYPE_CHECKING:
    from service.grammar.engine import Language

MAX_PARTS = 4
"""Into how many requests a sentence is divided at most."""
MATCH_STEPS = 40
"""What looking for the patterns in one stretch costs."""
MOST_WORDS = 40
"""Longer sentences are not looked at: places for any words fit them in too many ways."""
MOST_LETTERS = 300
"""Nor are texts so long, whose words need not be counted then."""
_READ, _SCALE, _LASTS, _BACK, _ASK, _WHY = "read", "scale", "lasts", "back", "ask", "why"
_OUTCOMES = frozenset((_READ, _SCALE, _LASTS, _BACK, _ASK, _WHY))
_KINDS, _ONE = "kinds", "one"
"""Slots for a kind of thing, by its word for many or for one."""
_QUESTION_MARK = "?"
_WHOLE = "marker.whole"
"""Concept of words that mean something together alone."""
_NEW_ROAD = frozenset(("columns", "rows", "seed", "traffic", "playback_speed"))
"""Settings that are not as before where they are set back: the road is another one, or no rule sets them."""


@dataclass(frozen=True, slots=True)
class _Entry:
    """What some patterns come to."""

    patterns: tuple[tuple[Ways, frozenset[str]], ...]
    """each with what it may begin with, "{}" for a number or any words"""
    outcome: str
    value: Any
    does: frozenset[str] | None
    """the actions that a sentence read in its place may come to; None: any"""
    asks: bool
    """whether the sentence in its place may be asked about"""
    choices: tuple[str, ...] = ()


class _Found(NamedTuple):
    """A pattern that fits from a token on."""

    order: tuple[int, int]
    """the numbers of entry and pattern: the first ones count"""
    entry: _Entry
    stop: int
    slots: Slots


@dataclass(frozen=True, slots=True)
class OtherWords:
    """The patterns of one language; none in a language without that file."""

    patterns: Patterns = field(default_factory=lambda: Patterns({}, {}, {}))
    entries: tuple[_Entry, ...] = ()
    messages: Mapping[str, str] = field(default_factory=dict)
    leans: tuple[str, ...] = ()
    """verbs: what makes a request after each of them leaves its own verb out"""

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> OtherWords:
        """The patterns of `other_words.yaml`. Raises `PatternError`, or `KeyError` for an unknown outcome."""
        if not data:
            return cls()
        texts = frozenset(str(data.get("texts", "")).split())
        patterns = Patterns(data.get("macros", {}), data.get("units", {}), data.get("kinds", {}), texts)
        entries = []
        for entry in data["entries"]:
            (outcome,) = _OUTCOMES & entry.keys()
            does = entry.get("does")
            says = entry["say"]
            entries.append(
                _Entry(
                    tuple(
                        (read := patterns.read(text), patterns.openings(read))
                        for text in ([says] if isinstance(says, str) else says)
                    ),
                    outcome,
                    entry[outcome],
                    None if does is None else frozenset(does.split()),
                    bool(entry.get("asks", False)),
                    tuple(entry.get("choices", ())),
                )
            )
        return cls(patterns, tuple(entries), data["messages"], tuple(data["leans"]))

    def read(self, language: Language, text: str, refused: Refused, topic: Topic, work: WorkBudget) -> Parse:
        """What a refused text comes to; the refusal itself where nothing here fits it."""
        if not self.entries or refused.reason == "empty" or len(text) > MOST_LETTERS:
            return refused
        try:
            reading = _Reading(self, language, text, refused, topic, work)
            return reading.parse() if reading.size <= MOST_WORDS else refused
        except BudgetExceededError:
            return refused


class _Reading:
    """One text on its way."""

    def __init__(
        self,
        words: OtherWords,
        language: Language,
        text: str,
        refused: Refused,
        topic: Topic,
        work: WorkBudget,
    ) -> None:
        self._words, self._language, self._text, self._refused = words, language, text, refused
        self._topic, self._work = topic, work
        self._plain = normalise(text)
        tokens = tokenise(self._plain, language.data.contractions)
        numbers = language.data.numbers
        self._said = Sentence(
            tokens,
            {at: found for at in range(len(tokens)) if (found := numbers.read(tokens, at)) is not None},
            {at: nth for at, token in enumerate(tokens) if (nth := numbers.ordinal(token)) is not None},
        )
        self._lattice = language.scan(tokens)
        self._known: dict[tuple[int, int], tuple[Action, ...] | None] = {}
        self._found: dict[int, list[_Found]] = {}
        self._why: str | None = None

    @property
    def size(self) -> int:
        """How many words and marks the text has."""
        return len(self._said.tokens)

    @property
    def _tokens(self) -> Sequence[Token]:
        return self._said.tokens

    def parse(self) -> Parse:
        """What the whole text comes to."""
        size = len(self._tokens)
        if self._refused.reason != "negation":
            whole = self._actions(0, size) or self._divided()
            if whole is not None:
                return Understood(self._text, whole)
            if (question := self._question(0, size)) is not None:
                return question
        self._actions(0, size)
        why = self._why or self._reason()
        if why is None:
            return self._refused
        reason: Reason = "negation" if self._refused.reason == "negation" else "impossible"
        message = f"{why} {self._words.messages['unchanged']}"
        told = self._refused
        return Refused(self._text, reason, message, told.unparsed, told.understood, told.suggestions)

    def _divided(self) -> tuple[Action, ...] | None:
        """The actions of a text of several requests, of which one at least is in other words."""
        size = len(self._tokens)
        for end, following in sorted(self._ends(0)):  # the end of a request may be another one alone
            if end < size and (last := self._actions(following, size)):
                first = self._actions(0, end) or self._plainly(0, end, leaning=False)
                if first is not None:
                    return (*first, *last)
        return self._after(0, MAX_PARTS, fits=False) or None

    def _after(self, start: int, parts: int, *, fits: bool) -> tuple[Action, ...] | None:
        """The actions of the requests from a token on. `fits`: one before was in other words."""
        size = len(self._tokens)
        for end, following in self._ends(start):
            if end < size and parts == 1:
                continue
            own = self._actions(start, end)
            actions = own or self._plainly(start, end, leaning=fits)
            if actions is None:
                continue
            if end == size:
                if own or fits:
                    return actions
                continue
            rest = self._after(following, parts - 1, fits=fits or own is not None)
            if rest is not None:
                return (*actions, *rest)
        return None

    def _ends(self, start: int) -> Iterator[tuple[int, int]]:
        """Where a request from a token on may end, and where the next one begins; the longest first."""
        size = len(self._tokens)
        yield size, size
        for at in range(size - 1, start, -1):
            ends = [edge.end for edge in self._lattice.edges[at] if edge.concept == SEPARATOR]
            if ends and max(ends) < size:
                yield at, max(ends)

    def _plainly(self, start: int, end: int, *, leaning: bool) -> tuple[Action, ...] | None:
        """What a stretch means as a sentence of its own; `leaning`: it has to say itself what to do."""
        said = self._written(start, end)
        parsed = self._language.read(said, self._topic, self._work, asking=False)
        if not isinstance(parsed, Understood):
            return None
        after = (f"{verb} {said}" for verb in self._words.leans) if leaning else ()
        others = [self._language.read(each, self._topic, self._work, asking=False) for each in after]
        if others and all(isinstance(other, Understood) for other in others):
            return None
        return parsed.actions

    def _actions(self, start: int, end: int) -> tuple[Action, ...] | None:
        """What a stretch comes to in other words; None where that is nothing, or more than one thing."""
        key = start, end
        if key not in self._known:
            found = list(dict.fromkeys(self._readings(start, end)))
            self._known[key] = found[0] if len(found) == 1 else None
        return self._known[key]

    def _readings(self, start: int, end: int) -> Iterator[tuple[Action, ...]]:
        for entry, slots in self._matches(start, end, (_READ, _SCALE, _LASTS, _BACK)):
            made: tuple[Action, ...] | None = None
            match entry.outcome:
                case "read":
                    templates = [entry.value] if isinstance(entry.value, str) else entry.value
                    tried = (self._read(entry, each, slots) for each in templates)
                    made = next((each for each in tried if each is not None), None)
                case "scale":
                    made = self._scaled(entry.value, slots)
                case "lasts":
                    made = self._lasting(slots)
                case "back":
                    made = self._put_back(slots)
            if made is not None:
                yield made

    def _matches(self, start: int, end: int, outcomes: Sequence[str]) -> Iterator[tuple[_Entry, Slots]]:
        """The entries that fit the whole of a stretch, words that say nothing at its ends aside."""
        opening, closing = self._opening(start, end), self._closing(start, end)
        self._work.spend(MATCH_STEPS)
        found = [each for at in opening for each in self._from(at) if each.stop in closing]
        for each in sorted(found, key=lambda each: each.order):
            if each.entry.outcome in outcomes:
                yield each.entry, each.slots

    def _from(self, at: int) -> list[_Found]:
        """All that fits from a token on, wherever it ends."""
        if at not in self._found:
            begins = {self._tokens[at].text, "{}"}
            self._found[at] = [
                _Found((number, nth), entry, stop, slots)
                for number, entry in enumerate(self._words.entries)
                for nth, (pattern, openings) in enumerate(entry.patterns)
                if not openings.isdisjoint(begins)
                for stop, slots in self._words.patterns.matches(pattern, self._said, at)
            ]
        return self._found[at]

    def _read(self, entry: _Entry, template: str, slots: Slots) -> tuple[Action, ...] | None:
        """The actions of the sentence in its place, if they are of those that it may come to."""
        actions = self._language.meaning(self._filled(template, slots), self._topic, self._work)
        return actions if actions and _does(entry, actions) else None

    def _scaled(self, factor: Any, slots: Slots) -> tuple[Action, ...] | None:
        """So many times as many things of a kind as there are now."""
        kind = slots[_KINDS]
        if self._topic.now is None:
            self._because("not_now", slots)
            return None
        now = self._topic.now.count(kind)
        if now == 0:
            self._because("none_to_scale", slots)
            return None
        if isinstance(factor, str):
            said = float(slots["x"])
            factor = {"times": said, "more": 1 + said / 100, "less": 1 - said / 100}[factor]
        count = math.floor(now * float(factor) + 0.5)
        try:
            return load([{"do": "set_count", "kind": kind, "count": count}])
        except ValidationError:
            self._because("too_many", slots)
            return None

    def _lasting(self, slots: Slots) -> tuple[Action, ...] | None:
        """A setting that is changed now and set back by a rule, once so many ticks or seconds are over."""
        first, last = slots["request"]
        if any(edge.concept == SEPARATOR for at in range(first, last) for edge in self._lattice.edges[at]):
            return None
        asked = self._plainly(first, last, leaning=False)
        if asked is None:
            return None
        if any(isinstance(each, Add | Remove | SetCount) for each in asked):
            self._because("not_for_a_time", slots)
            return None
        if not all(isinstance(each, Set | Adjust) and each.parameter not in _NEW_ROAD for each in asked):
            return None
        if self._topic.now is None:
            self._because("not_set_back", slots)
            return None
        old = []
        for each in asked:
            assert isinstance(each, Set | Adjust)
            value = self._topic.now.value(each.parameter)
            if value is None or (isinstance(each, Set) and each.value == value):
                self._because("not_set_back" if value is None else "so_already", slots)
                return None
            old.append({"do": "set", "parameter": each.parameter, "value": value})
        after = {name: slots[key] for name, key in (("ticks", "n"), ("seconds", "seconds")) if key in slots}
        try:
            return load([*dump(asked), {"do": "trigger", "when": {"fact": "after", **after}, "then": old}])
        except ValidationError:
            return None

    def _put_back(self, slots: Slots) -> tuple[Action, ...] | None:
        """The undo of the last change, where that took away things of this kind and nothing else."""
        changed = self._topic.changed
        kind = slots.get(_KINDS) or slots[_ONE]
        fits = all(isinstance(each, Remove) and each.kind == kind for each in changed)
        if changed and fits and self._topic.changed_steps and not self._topic.undone:
            return (take_back_change(self._topic),)
        self._because("not_removed_last", slots)
        return None

    def _because(self, key: str, slots: Slots) -> None:
        """Nothing, for a reason that is told."""
        self._why = self._why or self._filled(self._words.messages[key], slots)

    def _question(self, start: int, end: int) -> Ambiguous | None:
        """The question that a stretch is answered with."""
        for entry, slots in self._matches(start, end, (_ASK, _READ)):
            if entry.outcome == _ASK:
                choices: list[Choice] = []
                for template in entry.choices:
                    said = self._filled(template, slots)
                    parsed = self._language.read(said, self._topic, self._work, asking=False)
                    known = any(
                        isinstance(parsed, Understood) and c.actions == parsed.actions for c in choices
                    )
                    if isinstance(parsed, Understood) and not known:
                        choices.append(Choice(said, parsed.actions))
                if len(choices) == len(entry.choices):
                    return Ambiguous(self._text, str(entry.value), tuple(choices))
            elif entry.asks:
                said = self._filled(str(entry.value), slots)
                asked = self._language.read(said, self._topic, self._work, asking=True)
                if isinstance(asked, Ambiguous) and all(_does(entry, each.actions) for each in asked.choices):
                    return Ambiguous(self._text, asked.question, asked.choices)
        return None

    def _reason(self) -> str | None:
        """Why nothing like one of the requests in the text can be done."""
        size = len(self._tokens)
        for entry, slots in self._matches(0, size, (_WHY,)):
            return self._filled(str(entry.value), slots)
        unknown = self._refused.unparsed
        if self._text.rstrip().endswith(_QUESTION_MARK):
            return None  # what is asked is for whoever answers questions
        starts = [0, *sorted(following for _, following in self._ends(0) if following < size)]
        for start in starts:
            end = min((at for at, _ in self._ends(start)), default=size)
            said = self._written(start, end)
            if not unknown or any(phrase not in said for phrase in unknown):
                continue  # something else was not understood either
            for entry, slots in self._matches(start, end, (_WHY,)):
                return self._filled(str(entry.value), slots)
        return None

    def _filled(self, template: str, slots: Slots) -> str:
        """A sentence with what was said in its places."""
        said = {
            name: self._written(*value)
            if isinstance(value, tuple)
            else self._language.sentences.names(value).get("one" if name == _ONE else "many", value)
            if name in (_KINDS, _ONE)
            else f"{value:g}"
            if isinstance(value, float)
            else value
            for name, value in slots.items()
        }
        return template.format_map(said)

    def _written(self, start: int, end: int) -> str:
        """The words of a stretch as they were written."""
        return self._plain[self._tokens[start].start : self._tokens[end - 1].end] if start < end else ""

    def _opening(self, start: int, end: int) -> list[int]:
        """The places to which nothing but words that say nothing lead from the start of a stretch."""
        places = {start}
        for at in range(start, end):
            if at in places:
                edges = self._lattice.edges[at]
                # Of words such as "instead of", each says nothing by itself.
                least = max((edge.end for edge in edges if edge.concept == _WHOLE), default=at)
                places.update(e.end for e in edges if least <= e.end < end and self._is_idle(e))
        return sorted(places)

    def _closing(self, start: int, end: int) -> set[int]:
        """The places from which nothing but words that say nothing leads to the end of a stretch."""
        places = {end}
        for at in range(end - 1, start, -1):
            if any(e.end in places and self._is_idle(e) for e in self._lattice.edges[at]):
                places.add(at)
        return places

    @staticmethod
    def _is_idle(edge: Any) -> bool:
        return edge.concept in (GLUE, SEPARATOR) and not edge.sense.form


def _does(entry: _Entry, actions: Sequence[Action]) -> bool:
    """Whether some actions are of those that an entry may come to."""
    return bool(actions) and (entry.does is None or all(action.do in entry.does for action in actions))
