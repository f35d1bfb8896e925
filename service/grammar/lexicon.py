"""Words → concepts: a graph of all phrases, and the phrases at a place in a sentence.

The graph is a trie in which equal endings are one node (a DAWG); see `phrase_graph` for how it is built.
A phrase may have several senses ("clear" removes things and is a kind of weather); which one is
meant is for the frames to find out. A concept written `v.add/ing` is `v.add` in the form `ing`,
which only counts where that form is in place ("would you mind adding").
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

from service.grammar.numbers import Found
from service.grammar.patterns import DECIMAL, GAP, ID, NUMBER, ORDINAL, Pattern, Words, read_pattern
from service.grammar.phrase_graph import PhraseGraph
from service.grammar.tokens import Token


class Sense(NamedTuple):
    """One thing a phrase can mean: a concept, its value (None when it needs none) and its form."""

    concept: str
    value: Any = None
    form: str = ""


Match = tuple[int, Sequence[Sense], Words]
"""The end token of a phrase, its senses, and for half of a split phrase the whole of it."""

SECOND = "second_part"
"""Concept of the second half of a split phrase ("away" of "take ... away")."""

Meant = tuple[tuple[Sense, Words], ...]
"""Senses, each with the whole phrase where it is half of a split one."""


@dataclass(frozen=True, slots=True)
class PhraseMeaning:
    """All that one phrase means. "set" begins hundreds of split phrases, of which a sentence ends few."""

    pairs: Meant
    """all senses"""
    whole: Meant
    """the same without those it has as the first half of a split phrase"""
    whole_at: tuple[int, ...]
    """where those stand in `pairs`"""
    first_halves: Mapping[Words, tuple[int, ...]]
    """where the others stand, by the whole phrase"""
    concepts: frozenset[str]
    """the concepts of all of them"""

    @classmethod
    def of(cls, pairs: Sequence[tuple[Sense, Words]]) -> PhraseMeaning:
        """The meaning of senses, each with the whole phrase where it is half of one."""
        halves: dict[Words, tuple[int, ...]] = {}
        whole_at: list[int] = []
        for at, (sense, part) in enumerate(pairs):
            if part and sense.concept != SECOND:
                halves[part] = (*halves.get(part, ()), at)
            else:
                whole_at.append(at)
        whole = tuple(pairs[at] for at in whole_at)
        concepts = frozenset(sense.concept for sense, _ in pairs)
        return cls(tuple(pairs), whole, tuple(whole_at), halves, concepts)

    def ended_by(self, ended: Collection[Words]) -> Meant:
        """The senses without first halves of other split phrases than these, in the same order."""
        halves = self.first_halves
        begun = [at for whole in ended if whole in halves for at in halves[whole]]
        if not begun:
            return self.whole
        return tuple([self.pairs[at] for at in sorted((*self.whole_at, *begun))])


@dataclass(slots=True)
class Node:
    """A place in the graph of phrases."""

    next: dict[str, Node] = field(default_factory=dict)
    senses: list[Sense] | None = None
    split: dict[Words, list[Sense]] | None = None
    """Whole split phrase → the senses this half of it has."""
    _meant: PhraseMeaning | None = None

    @property
    def meant(self) -> PhraseMeaning:
        """All that the phrase which ends here means; for a lexicon that is complete."""
        if self._meant is None:
            pairs: list[tuple[Sense, Words]] = [(sense, ()) for sense in self.senses or ()]
            pairs += [(sense, whole) for whole, senses in (self.split or {}).items() for sense in senses]
            self._meant = PhraseMeaning.of(pairs)
        return self._meant


class _End(NamedTuple):
    """What a phrase ends in."""

    text: int
    """the number of the text that writes it"""
    sense: Sense
    whole: Words = ()
    """the whole of a split phrase, of which it is half"""


class Lexicon:
    """All phrases of a language."""

    def __init__(self, macros: Mapping[str, Pattern]) -> None:
        self._macros = macros
        self._graph = PhraseGraph[Node]()
        self._ends: list[_End] = []
        self._texts: list[str] = []
        self._collisions: list[str] = []
        self._repeats: list[str] = []
        self.words: set[str] = set()
        self.concepts: dict[str, set[str]] = {}
        """Concept → its forms."""
        self.begins: dict[str, set[str]] = {}
        """Concept → the first words of its phrases."""
        self.typical: dict[tuple[str, str], Words] = {}
        """Concept and value → its first phrase without a slot: how it is best said."""

    def add_section(self, data: Mapping[str, Any]) -> None:
        """Add one file of the lexicon: concept → phrases, value → phrases, or a list of both."""
        for key, content in data.items():
            concept, _, form = key.partition("/")
            self.concepts.setdefault(concept, set()).add(form)
            if isinstance(content, dict):
                for value, phrases in content.items():
                    self._add_phrases(phrases, Sense(concept, value, form))
            elif isinstance(content, list) and content and isinstance(content[0], dict):
                for entry in content:
                    self._add_phrases(entry["say"], Sense(concept, entry["is"], form))
            else:
                self._add_phrases(content, Sense(concept, None, form))
        self.__dict__.pop("root", None)

    def _add_phrases(self, phrases: str | Sequence[str], sense: Sense) -> None:
        """Add phrases: a list of them, or one string with commas between them."""
        for text in (phrases,) if isinstance(phrases, str) else phrases:
            self._add_pattern(str(text), sense)

    def _add_pattern(self, text: str, sense: Sense) -> None:
        pattern = read_pattern(text, self._macros)
        number = len(self._texts)
        self._texts.append(text)
        self.words.update(word for word in pattern.words() if word != GAP)
        self.begins.setdefault(sense.concept, set()).update(self._graph.first_words(pattern))
        if not sense.form and (best := (sense.concept, repr(sense.value))) not in self.typical:
            plain = pattern.without(slots=True, gaps=True)
            if (first := next(filter(None, plain.phrases()), None)) is not None:
                self.typical[best] = first
        if pattern.has_gap():
            for words in filter(None, pattern.phrases()):
                if GAP in words:
                    self._add_split(words, sense, number)
            pattern = pattern.without(gaps=True)
        assert self._graph.add(pattern) == len(self._ends)
        self._ends.append(_End(number, sense))

    def _add_split(self, words: Words, sense: Sense, text: int) -> None:
        """Add a phrase of two halves."""
        cut = words.index(GAP)
        if not 0 < cut < len(words) - 1:
            raise ValueError(f"a phrase of {sense.concept} may have nothing on one side of its gap: {words}")
        for half, half_sense in ((words[:cut], sense), (words[cut + 1 :], Sense(SECOND))):
            assert self._graph.add_words(half) == len(self._ends)
            self._ends.append(_End(text, half_sense, words))

    @cached_property
    def root(self) -> Node:
        """Where all phrases start."""
        self._collisions, said = [], set[int]()
        known: dict[int, Any] = {}

        def make(ends: Sequence[int], phrase: Words) -> Node:
            node = Node()
            for number in ends:
                end = self._ends[number]
                if self._take(end, node, phrase):
                    said.add(end.text)
            return node

        def sense_key(sense: Sense) -> Any:
            if (key := known.get(id(sense))) is None:
                key = known[id(sense)] = sense.concept, repr(sense.value), sense.form
            return key

        def key_of(node: Node) -> Hashable:
            return (
                None if node.senses is None else tuple(map(sense_key, node.senses)),
                None
                if node.split is None
                else tuple((whole, tuple(map(sense_key, each))) for whole, each in node.split.items()),
            )

        def link(node: Node, after: dict[str, Node]) -> None:
            node.next = after

        root = self._graph.root(make, key_of, link)
        self._repeats = [
            f"{self._texts[end.text]!r} is already among the phrases of {end.sense.concept}"
            for end in self._ends
            if not end.whole and end.text not in said
        ]
        return root

    def _take(self, end: _End, node: Node, phrase: Words) -> bool:
        """Take what a phrase means into the node it ends at; whether it is new there."""
        sense = end.sense
        if end.whole:
            node.split = {} if node.split is None else node.split
            senses = node.split.setdefault(end.whole, [])
            if sense in senses:
                return False
            senses.append(sense)
            return True
        node.senses = [] if node.senses is None else node.senses
        for other in node.senses:
            if other.concept == sense.concept and other.form == sense.form:
                if other.value != sense.value:
                    said = " ".join(phrase)
                    self._collisions.append(
                        f"{said!r} is both {other.value!r} and {sense.value!r} of {sense.concept}"
                    )
                    return True
                return False
        node.senses.append(sense)
        return True

    @property
    def collisions(self) -> Sequence[str]:
        """Phrases with two values of one concept."""
        return self._collisions if self.root else ()

    @property
    def repeats(self) -> Sequence[str]:
        """Written phrases that say only what is said already."""
        return self._repeats if self.root else ()

    def knows(self, word: str) -> bool:
        """Whether any phrase contains the word."""
        return word in self.words

    def leads_on(self, word: str) -> bool:
        """Whether several phrases of more than one word begin with it: "on", "the"."""
        node = self.root.next.get(word)
        return node is not None and len(node.next) > 1

    def senses_of(self, words: Words) -> tuple[Sense, ...]:
        """The senses of exactly this phrase."""
        node: Node | None = self.root
        for word in words:
            node = node.next.get(word) if node else None
        return tuple(node.senses or ()) if node else ()

    def matches(
        self,
        tokens: Sequence[Token],
        at: int,
        numbers: Mapping[int, Found],
        ordinals: Mapping[int, int],
    ) -> list[Match]:
        """All phrases that start at token `at`; numbers and ordinals are given by their place."""
        found: list[Match] = []
        size = len(tokens)
        open_paths: list[tuple[Node, int, tuple[Any, ...]]] = [(self.root, at, ())]
        while open_paths:
            node, here, slots = open_paths.pop()
            if node.senses is not None:
                senses = [_filled(sense, slots) for sense in node.senses] if slots else node.senses
                found.append((here, senses, ()))
            if node.split is not None:
                found.extend((here, senses, whole) for whole, senses in node.split.items())
            if here >= size or not node.next:
                continue
            if here in numbers and (after := node.next.get(NUMBER)) is not None:
                number = numbers[here]
                if isinstance(number.value, int) and number.value >= 0:
                    open_paths.append((after, number.end, (*slots, number.value)))
            if here in numbers and (after := node.next.get(DECIMAL)) is not None and numbers[here].value >= 0:
                open_paths.append((after, numbers[here].end, (*slots, numbers[here].value)))
            if tokens[here].id and (after := node.next.get(ID)) is not None:
                open_paths.append((after, here + 1, (*slots, tokens[here].text)))
            if here in ordinals and (after := node.next.get(ORDINAL)) is not None:
                open_paths.append((after, here + 1, (*slots, ordinals[here])))
            if (after := node.next.get(tokens[here].text)) is not None:
                open_paths.append((after, here + 1, slots))
        return found

    def plain_matches(
        self,
        tokens: Sequence[Token],
        at: int,
        numbers: Mapping[int, Found],
        ordinals: Mapping[int, int],
    ) -> list[tuple[int, Node]] | None:
        """The ends of all phrases that start at token `at`, in the order of `matches`.

        None where a number, an id or an ordinal may stand in one of them: that is for `matches`.
        """
        found: list[tuple[int, Node]] = []
        node = self.root
        for here in range(at, len(tokens)):
            following = node.next
            token = tokens[here]
            if (
                (here in numbers and (NUMBER in following or DECIMAL in following))
                or (token.id and ID in following)
                or (here in ordinals and ORDINAL in following)
            ):
                return None
            after = following.get(token.text)
            if after is None:
                break
            node = after
            if node.senses is not None or node.split is not None:
                found.append((here + 1, node))
            if not node.next:
                break
        return found

    def phrases(self) -> Iterator[tuple[Words, tuple[Sense, ...]]]:
        """Every phrase with its senses."""
        return self._below(self.root, ())

    def phrases_of(self, concept: str) -> Iterator[tuple[Words, tuple[Sense, ...]]]:
        """Every phrase with a sense of a concept; parts of the graph that lead to none are not walked."""
        leads: dict[int, bool] = {}
        for word in self.begins.get(concept, ()):
            yield from self._leading(self.root.next[word], (word,), concept, leads)

    def _leading(
        self, node: Node, words: Words, concept: str, leads: dict[int, bool]
    ) -> Iterator[tuple[Words, tuple[Sense, ...]]]:
        if not _leads_to(node, concept, leads):
            return
        if node.senses is not None and any(sense.concept == concept for sense in node.senses):
            yield words, tuple(node.senses)
        for word, after in node.next.items():
            yield from self._leading(after, (*words, word), concept, leads)

    @staticmethod
    def _below(node: Node, words: Words) -> Iterator[tuple[Words, tuple[Sense, ...]]]:
        stack: list[tuple[Node, Words]] = [(node, words)]
        while stack:
            node, words = stack.pop()
            if node.senses is not None:
                yield words, tuple(node.senses)
            stack.extend((after, (*words, word)) for word, after in node.next.items())


def _leads_to(node: Node, concept: str, known: dict[int, bool]) -> bool:
    """Whether a phrase with a sense of a concept ends at a node or behind it; `known`: those found, by id."""
    if id(node) not in known:
        known[id(node)] = any(sense.concept == concept for sense in node.senses or ()) or any(
            _leads_to(after, concept, known) for after in node.next.values()
        )
    return known[id(node)]


def _filled(sense: Sense, slots: tuple[Any, ...]) -> Sense:
    """The sense with `$1`, `$2` in its value replaced by the numbers said."""
    return Sense(sense.concept, _substitute(sense.value, slots), sense.form)


def _substitute(value: Any, slots: tuple[Any, ...]) -> Any:
    if isinstance(value, str) and value.startswith("$"):
        return slots[int(value[1:]) - 1]
    if isinstance(value, dict):
        return {key: _substitute(part, slots) for key, part in value.items()}
    if isinstance(value, list):
        return [_substitute(part, slots) for part in value]
    return value
