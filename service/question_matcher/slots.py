"""The slots of a question, such as the move, the thing or the planner it names, and its other words."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

from service.grammar import Language
from service.grammar.free_text import TEACH
from service.grammar.lattice import Edge, Lattice
from service.grammar.tokens import Token, normalise, tokenise
from service.yaml_files import read_yaml

NO_PROSE = re.compile(r"[{}\[\]]")
"""Marks of code and of data, which no question holds."""
STAY = "stay"
FORWARD = "forward"
TEACHES_BEFORE = 2
"""Words behind which the words of teaching teach nothing."""
MIN_WORDS = 3
"""With fewer a question leans on what was said before, which is not looked at here."""


@dataclass(frozen=True, slots=True)
class Question:
    """A question taken apart."""

    words: tuple[str, ...]
    """its words, with a mark such as "<move>" in the place of each slot"""
    slots: Mapping[str, str]
    """the words that a canonical sentence has for each slot"""
    binding: frozenset[str]
    """slots that an answer must not leave out"""
    named: Mapping[str, frozenset[str]] = field(default_factory=dict)
    """by mark, what is named, as the lexicon has it"""
    restated: frozenset[str] = frozenset()
    """slots that only say what is so anyway, such as the planner that drives"""
    others: Mapping[tuple[str, str], Mapping[str, str]] = field(default_factory=dict)
    """the words for slots of all sensors and weathers that are named, by mark and value"""

    def asked(self, facts: Collection[tuple[str, str]]) -> Question:
        """The same question, asked where these are the facts (`Now.facts`).

        Of two sensors, or weathers, it is about the one that there is not: "cameras or lidar, which is best?"
        """
        marks = (mark for mark, values in self.named.items() if all((mark, each) in facts for each in values))
        slots = dict(self.slots)
        for (mark, value), said in self.others.items():
            if (mark, value) not in facts and any((mark, each) in facts for each in self.named[mark]):
                slots |= said
        return replace(self, slots=slots, restated=frozenset(marks))


@dataclass(frozen=True, slots=True)
class _Span:
    """Tokens `[start, end)` that name something: the mark in their place, and the words for slots."""

    start: int
    end: int
    mark: str
    slots: Mapping[str, str]
    value: str = ""
    """what is named, as the lexicon has it"""


class SlotWords:
    """The words that name slots in one language."""

    def __init__(self, language: Language, folder: Path) -> None:
        """`folder`: of `prompts/questions`. Raises `YamlError` or `OSError` where its file is unfit."""
        self._language = language
        self._data: Mapping[str, Any] = read_yaml(folder / "words.yaml")

    @cached_property
    def _kinds(self) -> dict[str, str]:
        """The kind that a word beside the lexicon's names."""
        return {word: kind for kind, names in self._data["things"].items() for word in names["also"]}

    def question(self, text: str) -> Question:
        """A text taken apart."""
        language = self._language
        tokens = [
            token
            for token in tokenise(normalise(text), language.data.contractions)
            if token.id or token.text.replace("*", "").isalnum()
        ]
        if not tokens:
            return Question((), {}, frozenset())
        lattice = language.scan(tokens)
        # "When I say …, I mean …" asks nothing; "does it learn from this?" teaches nothing.
        if any(edge.concept == TEACH and edge.start < TEACHES_BEFORE for edge in lattice.all()):
            return Question((), {}, frozenset())
        spans = self._spans(tokens, lattice)
        words = _masked(tokens, spans)
        slots: dict[str, str] = {}
        binding: set[str] = set()
        # What the vehicle is called lends its words only where no other thing is named.
        for span in sorted(spans, key=lambda span: span.mark == _EGO):
            if span.mark not in binding:
                slots |= {slot: text for slot, text in span.slots.items() if slot not in slots}
                binding.add(span.mark)
            elif span.mark in _SECOND:
                second, slot = _SECOND[span.mark]
                if span.mark == "planner" and span.slots[slot] in (slots[slot], slots.get(second)):
                    continue
                binding.add(_THIRD if span.mark == "planner" and second in binding else second)
                slots[second] = span.slots[slot]
        if "move" not in binding:
            # Beside a side that may be a move, straight on may be the second of two moves.
            alone = (STAY,) if self._names_a_side(tokens, lattice) else (STAY, FORWARD)
            moves = (move for move in alone if any(word in self._data[move] for word in words))
            slots |= next((self._data["moves"][move] for move in moves), {})
        elif "instead" not in binding and self._goes_straight_after(words):
            # "I went left, what if I had gone straight?" is of two moves, and not of the first alone.
            binding.add("instead")
            slots["instead"] = self._data["moves"][FORWARD]["going"]
        slots |= self._term(tokens, lattice)
        named: dict[str, frozenset[str]] = {}
        for span in spans:
            named[span.mark] = named.get(span.mark, frozenset()) | {span.value}
        others = {(span.mark, span.value): span.slots for span in spans if span.mark in _OF_THE_SESSION}
        return Question(words, slots, frozenset(binding - _LOOSE), named, others=others)

    def _term(self, tokens: Sequence[Token], lattice: Lattice) -> dict[str, str]:
        """The slot of the first word of the glossary, the longest there; every question may leave it out."""
        terms = [edge for edge in lattice.all() if edge.concept == "term" and not edge.part]
        first = min(terms, key=lambda edge: (edge.start, -edge.end), default=None)
        return {} if first is None else {"term": _text(tokens, first.start, first.end)}

    def _goes_straight_after(self, words: Sequence[str]) -> bool:
        """Whether straight on is named behind a move."""
        return any(word in self._data[FORWARD] for word in words[words.index("<move>") :])

    def _names_a_side(self, tokens: Sequence[Token], lattice: Lattice) -> bool:
        aside = self._data["moves"].keys() - {FORWARD, STAY}
        return any(
            edge.concept == "dir" and str(edge.sense.value) in aside and not self._comes_from(edge, tokens)
            for edge in lattice.all()
        )

    def _comes_from(self, edge: Edge, tokens: Sequence[Token]) -> bool:
        """Whether a side is where something comes from: "the car from the left"."""
        start = edge.start
        while start > 0 and tokens[start - 1].text in self._data["determiners"]:
            start -= 1
        return start > 0 and tokens[start - 1].text in self._data.get("origin", ())

    def says_something(self, question: Question) -> bool:
        """Whether a question has a word of its own, beside slots and openers, and is no stump."""
        own = [word for word in question.words if word[0] != "<" and word not in self._data["openers"]]
        return bool(own) and (len(question.words) >= MIN_WORDS or len(own) > 1 or bool(question.binding))

    def denies(self, question: Question) -> bool:
        """Whether a word makes a question its contrary."""
        return not set(self._data.get("negations", ())).isdisjoint(question.words)

    def is_a_name(self, text: str) -> bool:
        """Whether a text is one word, but for articles and the like: "fog", "the night"."""
        lead = {*self._data["determiners"], *self._data["indefinite"]}
        return sum(word not in lead for word in text.casefold().split()) <= 1

    def is_a_circumstance(self, text: str) -> bool:
        """Whether a text tells a time, a place or a manner, by its first word: "at night", "tick 10"."""
        return text.casefold().split(maxsplit=1)[0] in self._data.get("circumstances", ())

    def asks(self, text: str, question: Question) -> bool:
        """Whether a text has the form of a question, or of a wish to be told."""
        if NO_PROSE.search(text):
            return False
        words = question.words
        return (
            "?" in text
            or not self._asking.isdisjoint(words)
            or any(
                word in self._inverted and (at == 0 or then[0] == "<" or then in self._subjects)
                for at, (word, then) in enumerate(pairwise((*words, "$")))
            )
        )

    @cached_property
    def _asking(self) -> frozenset[str]:
        return frozenset(self._data["asking"])

    @cached_property
    def _inverted(self) -> frozenset[str]:
        return frozenset(self._data["asking_before_subject"])

    @cached_property
    def _subjects(self) -> frozenset[str]:
        return frozenset(self._data["subjects"])

    def _spans(self, tokens: Sequence[Token], lattice: Lattice) -> list[_Span]:
        found: list[_Span] = []
        taken = [False] * len(tokens)
        for spotted in (self._values, self._things, self._places):
            for span in sorted(spotted(tokens, lattice), key=lambda span: (span.start, -span.end)):
                if not any(taken[span.start : span.end]):
                    taken[span.start : span.end] = [True] * (span.end - span.start)
                    found.append(span)
        return sorted(found, key=lambda span: span.start)

    def _values(self, tokens: Sequence[Token], lattice: Lattice) -> Iterator[_Span]:
        """Lanes and rows by their numbers; ticks, planners, sensors, weathers."""
        for edge in lattice.all():
            numbered, value = _NUMBERED.get(edge.concept), edge.sense.value
            if numbered is not None and isinstance(value, Mapping) and numbered in value:
                yield _Span(edge.start, edge.end, numbered, {numbered: str(value[numbered])})
            mark = _VALUES.get(edge.concept)
            if mark is None or edge.sense.value is None or edge.part:
                continue
            if mark == "planner" and self._is_no_planner(tokens, edge):
                continue
            value = said = str(edge.sense.value)
            if mark == "weather":
                if not self._is_no_weather(tokens, edge):
                    yield _Span(edge.start, edge.end, mark, self._weather(value), value)
                continue
            if mark in ("planner", "sensor"):
                said = _text(tokens, edge.start, edge.end)
            yield _Span(edge.start, edge.end, mark, {mark: said}, value)

    def _weather(self, value: str) -> dict[str, str]:
        """The words for a weather or a time of day: how it is, what it is, and how it is if that hampers."""
        said = self._data["weathers"].get(value, value)
        noun = self._data.get("weather_nouns", {}).get(value, said)
        hampers = {} if value in self._data.get("hampers_nothing", ()) else {"bad_weather": said}
        return {"weather": said, "weather_noun": noun, **hampers}

    def _is_no_weather(self, tokens: Sequence[Token], edge: Edge) -> bool:
        """Whether a word that may name a weather says something else: "the way was clear"."""
        loose = self._data.get("loose_weathers")
        if loose is None or _text(tokens, edge.start, edge.end) not in loose["names"]:
            return False
        before = tokens[edge.start - 1].text if edge.start else ""
        return before not in loose["after"] and not any(token.text in loose["beside"] for token in tokens)

    def _is_no_planner(self, tokens: Sequence[Token], edge: Edge) -> bool:
        """Whether words that may name a planner are meant as such only after others: "rules"."""
        loose = self._data.get("loose_planners")
        if loose is None or _text(tokens, edge.start, edge.end) not in loose["names"]:
            return False
        return edge.start == 0 or tokens[edge.start - 1].text not in loose["after"]

    def _things(self, tokens: Sequence[Token], lattice: Lattice) -> Iterator[_Span]:
        """Things: one that is meant, with the words around it that say which; or a kind of things."""
        nouns = [(edge.start, edge.end, edge.concept, str(edge.sense.value)) for edge in lattice.all()]
        for at, token in enumerate(tokens):
            if token.text in self._kinds:
                nouns.append((at, at + 1, _ONE, self._kinds[token.text]))
            if token.text in self._data["pronouns"]:
                nouns.append((at, at + 1, _ONE, self._data["pronouns"][token.text]))
        for first, end, concept, kind in nouns:
            names = self._data["things"].get(kind)
            if concept not in (_ONE, _MANY) or names is None:
                continue
            start = first
            while start > 0 and tokens[start - 1].text in self._data["determiners"]:
                start -= 1
            slots = {"things": names["many"], "nearest": names["nearest"], "a_thing": names["a"]}
            if concept == _MANY or (start and tokens[start - 1].text in self._data["indefinite"]):
                yield _Span(first, end, "things", slots)
                continue
            at = end
            while at < len(tokens) - 1 and tokens[at].text in self._data.get("before_a_place", ()):
                at += 1
            places = lattice.edges[at] if at < len(tokens) else ()
            place = next((edge for edge in places if _is_place(edge)), None)
            if place is None and self._is_a_distance(tokens, lattice, end):
                yield _Span(start, end + 2, "elsewhere", {})
            elif place is None:
                mark = _EGO if self._is_the_ego(tokens, start, end) else "thing"
                yield _Span(start, end, mark, slots | {"thing": names["this"]})
            else:
                where = _text(tokens, place.start, place.end)
                yield _Span(start, place.end, "thing", slots | {"thing": f"{names['one']} {where}"})

    def _is_a_distance(self, tokens: Sequence[Token], lattice: Lattice, at: int) -> bool:
        """Whether a number of lanes or cells follows that tells no side: "the car two lanes over"."""
        if at + 1 >= len(tokens) or tokens[at + 1].text not in self._data.get("distances", ()):
            return False
        return any(edge.concept == "number" and edge.end == at + 1 for edge in lattice.edges[at])

    def _is_the_ego(self, tokens: Sequence[Token], start: int, end: int) -> bool:
        """Whether a thing is called as the vehicle itself is: "the car", but not "the car that turned"."""
        called = self._data.get("ego")
        if called is None or end - start != 2:
            return False
        then = tokens[end].text if end < len(tokens) else ""
        return (
            tokens[start].text in called["determiners"]
            and tokens[start + 1].text in called["nouns"]
            and then not in called["another_before"]
        )

    def _is_a_move(self, edge: Edge, tokens: Sequence[Token], lattice: Lattice) -> bool:
        before = tokens[edge.start - 1].text if edge.start else ""
        after = tokens[edge.end].text if edge.end < len(tokens) else ""
        beside = self._data["no_move"]
        if before in beside["after"] or self._comes_from(edge, tokens):
            return False
        if after not in beside["before"]:
            return True
        then = lattice.edges[edge.end]
        return tokens[edge.start].text not in beside["exactly"] and any(
            each.concept == "tick" for each in then
        )

    def _places(self, tokens: Sequence[Token], lattice: Lattice) -> Iterator[_Span]:
        """Sides, directions and numbers."""
        for edge in lattice.all():
            if edge.part:
                continue
            opening = tokens[edge.start].text
            if edge.concept == "side" and opening in self._data["sides"]:
                end = edge.end
                while end < len(tokens) and tokens[end].text in self._data["of_a_side"]:
                    end += 1
                if end < len(tokens) and tokens[end].text in self._data["elsewhere"]:
                    yield _Span(edge.start, end + 1, "elsewhere", {})
                else:
                    side = _text(tokens, edge.start, edge.end)
                    yield _Span(
                        edge.start, end, "side", {"side": self._data.get("said_of", {}).get(side, side)}
                    )
            elif edge.concept == "dir" and opening not in self._data["sides"]:
                value = str(edge.sense.value)
                if self._data["moves"].keys() - {FORWARD, STAY} >= {value} and self._is_a_move(
                    edge, tokens, lattice
                ):
                    yield _Span(edge.start, edge.end, "move", self._data["moves"][value])
            elif edge.concept == "number" and edge.sense.value not in (0, 1):
                counted = edge.start > 0 and tokens[edge.start - 1].text in self._data.get("counted", ())
                value = str(edge.sense.value)
                yield _Span(edge.start, edge.end, "n", {"n": value}, f"the {value}" if counted else value)


_ONE, _MANY = "noun.thing.one", "noun.thing.many"
_VALUES = {
    "tick": "tick",
    "ticks_back": "ticks",
    "planner": "planner",
    "sensor": "sensor",
    "weather": "weather",
    "time_of_day": "weather",
}
_NUMBERED = {"past.been_lane": "lane", "place.row": "row"}
"""Concepts whose value is a mapping, and the key in it of a number: "lane 3", "row 12"."""
_SECOND = {"move": ("instead", "going"), "tick": ("until", "tick"), "planner": ("planner_too", "planner")}
"""The slot of a second one, and which of its words."""
_THIRD = "third"
"""Binding where three planners are named: no sentence has room for them."""
_EGO = "ego"
_OF_THE_SESSION = ("sensor", "weather")
"""Marks of which a session has one of its own, beside which another may be named."""
_LOOSE = frozenset(("things", _EGO))
"""Marks of what a question may name in passing."""


def _masked(tokens: Sequence[Token], spans: Sequence[_Span]) -> tuple[str, ...]:
    """The words, with a mark in the place of each span."""
    starts = {span.start: span for span in spans}
    words: list[str] = []
    at = 0
    while at < len(tokens):
        span = starts.get(at)
        words.append(tokens[at].text if span is None else f"<{span.mark}>")
        at = at + 1 if span is None else span.end
    return tuple(words)


def _is_place(edge: Edge) -> bool:
    return edge.concept in ("side", "place") and not edge.part


def _text(tokens: Sequence[Token], start: int, end: int) -> str:
    return " ".join(token.text for token in tokens[start:end])
