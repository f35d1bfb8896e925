"""Suggests sentences that can be said, for one that was not understood: of the same intent, or none.

A saying is offered where what was said shares its verb and its object, or enough of one of them that
hardly anything else can be meant. Likeness of letters alone is no reason: it only ranks. What may be lost by
doing it is offered only where verb and object are both there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, reduce
from operator import or_
from types import MappingProxyType
from typing import Final

from service.actions import Action, Ask
from service.actions.table import traits_of
from service.grammar.accounting import DEGREE
from service.grammar.frames import Frame
from service.grammar.lattice import GLUE, Lattice
from service.grammar.lexicon import SECOND
from service.grammar.noun_phrases import NOUN, QUANTITY
from service.grammar.paths import ALLOWS, NEGATION, SEPARATOR, SPEAKER
from service.grammar.unparsed_span import Gap

HOW_MANY = 3
LEAST = 0.22
"""How sure a meaning must make an intent: the share of sayings with this meaning that are of the intent."""
_SAME_VALUE = 0.3
"""What it counts that the saying names the very value: the potholes, and not some other thing."""
_ALIKE = 0.3
"""The least share of meanings that two words have in common, to be taken for alike."""
_LIKENESS = 0.3
"""What full likeness of letters counts."""

REMEMBERED = 4_096
"""For so many words it is kept what they tell of."""

_LOOSE = frozenset((GLUE, SEPARATOR, QUANTITY, ALLOWS, SPEAKER, SECOND))
"""Concepts that say nothing of what a sentence is about."""

_NO_NOUNS: Final[Mapping[str, str]] = MappingProxyType({})

Meaning = tuple[str, str]
"""A concept and its value as a word, empty where it has none."""


@dataclass(frozen=True, slots=True)
class Meanings:
    """All that tokens `[start, end)` of a sentence may mean."""

    start: int
    end: int
    all: frozenset[Meaning]


def meanings_of(lattice: Lattice) -> tuple[Meanings, ...]:
    """What each stretch of a sentence may mean."""
    found: dict[tuple[int, int], set[Meaning]] = {}
    for edge in lattice.all():
        if edge.concept not in _LOOSE:
            value = edge.sense.value if isinstance(edge.sense.value, str) else ""
            found.setdefault((edge.start, edge.end), set()).add((_base(edge.concept), value))
    return tuple(Meanings(*stretch, frozenset(meant)) for stretch, meant in found.items())


def turned_round(lattice: Lattice) -> bool:
    """Whether a sentence may mean the opposite of what its words do: "don't …", "too dark"."""
    return not lattice.concepts.isdisjoint((NEGATION, DEGREE))


def _base(concept: str) -> str:
    """A concept as frames and lattices both call it: nouns without their number and quantity."""
    name, _, rest = concept.partition(".")
    if concept.startswith(NOUN):
        return rest.partition(".")[0]
    return name if name == "thing" else concept


def _intent(action: Action) -> str:
    """What kind of request an action is: its verb, and what it is about."""
    about = action.about if isinstance(action, Ask) else getattr(action, "parameter", "")
    return f"{action.do} {about}"


def _loses(action: Action) -> bool:
    return traits_of(action).loses


@dataclass(frozen=True)
class Saying:
    """A sentence that can be said: its frame, its actions, and what its words may mean."""

    text: str
    frame: Frame
    actions: tuple[Action, ...]
    meanings: tuple[Meanings, ...]

    @cached_property
    def intent(self) -> str:
        """What kind of request it is, by its first action."""
        return _intent(self.actions[0])

    @cached_property
    def loses(self) -> bool:
        """Whether something may be lost by doing it."""
        return any(map(_loses, self.actions))

    @cached_property
    def needs(self) -> tuple[frozenset[Meaning], ...]:
        """For each thing that its frame needs, the meanings in it that are that thing."""
        said = frozenset(meaning for each in self.meanings for meaning in each.all)
        groups = (frozenset(map(_base, group)) for group in self.frame.needs)
        return tuple(
            meant for group in groups if (meant := frozenset(each for each in said if each[0] in group))
        )

    @cached_property
    def needed(self) -> tuple[frozenset[str], ...]:
        """The concepts of each of them."""
        return tuple(frozenset(concept for concept, _ in need) for need in self.needs)

    @cached_property
    def only_asks(self) -> bool:
        """Whether it does nothing but ask."""
        return all(traits_of(action).is_question for action in self.actions)

    @cached_property
    def lowered(self) -> str:
        """Its text in small letters."""
        return self.text.lower()


class Suggestions:
    """The sayings of a language, ranked by how sure what was said makes their intent.

    Sets of sayings are whole numbers, with a bit for each saying.
    """

    def __init__(
        self,
        sayings: Iterable[Saying],
        nouns: Mapping[str, str] = _NO_NOUNS,
        offered: Callable[[Action], bool] | None = None,
    ) -> None:
        """`nouns`: concepts that stand for those of their values ("weather"); `offered`: what may be said."""
        self._offered = offered or (lambda _: True)
        self._sayings = list(sayings)
        self._nouns = nouns
        self._of: dict[str, int] = {}
        words: dict[frozenset[Meaning], list[int]] = {}
        for at, saying in enumerate(self._sayings):
            self._of[saying.intent] = self._of.get(saying.intent, 0) | 1 << at
            needs = frozenset().union(*saying.needs)
            for each in saying.meanings:
                known = words.setdefault(self._meant(each), [0, 0])
                known[0] |= 1 << at
                known[1] |= (not needs.isdisjoint(each.all)) << at
        self._words = [_Word(meant, *masks) for meant, masks in words.items()]
        self._meaning: dict[Meaning, list[int]] = {}
        for at, word in enumerate(self._words):
            for one in word.meant:
                self._meaning.setdefault(one, []).append(at)
        needed = (saying.needs for saying in self._sayings)
        self._needed = frozenset(name for needs in needed for need in needs for name, _ in need)
        self._tellings: dict[frozenset[Meaning], _Telling] = {}

    def nearest(
        self,
        text: str,
        meanings: Sequence[Meanings],
        *,
        harmless: bool = False,
        gap: Gap | None = None,
    ) -> tuple[str, ...]:
        """Up to three sayings of the same intent, the surest first; with `harmless`, questions alone.

        What is left of the sentence without its `gap` comes first, unless something may be lost by doing it;
        all sayings are of its intents.
        """
        text = text.lower()[:200]
        told = self._telling(meanings)
        first = () if gap is None or harmless or not self._may_offer(gap) else (gap.rest,)
        intents = None if gap is None else {_intent(action) for action in gap.actions}
        # "Why is" alone, as in "why is radar worse", must not hide that "why" asks for a reason.
        scored = self._scored(text, _longest(told), intents, harmless=harmless) or self._scored(
            text, [telling for _, telling in told], intents, harmless=harmless
        )
        return tuple(dict.fromkeys((*first, *(text for _, text in scored))))[:HOW_MANY]

    def _scored(
        self, text: str, telling: Sequence[_Telling], intents: set[str] | None, *, harmless: bool
    ) -> list[tuple[float, str]]:
        """The sayings that may be offered with their scores, the surest first."""
        from rapidfuzz import fuzz  # needed at the first refusal, not before

        scored: list[tuple[float, str]] = []
        needing = reduce(or_, (each.needing for each in telling), 0)
        for saying in self._sayings if telling else ():
            if not self._of[saying.intent] & needing:
                continue
            if harmless and not saying.only_asks:
                continue
            if intents is not None and saying.intent not in intents:
                continue
            score = _score(saying, self._of[saying.intent], telling)
            if score >= LEAST:
                likeness = fuzz.token_set_ratio(text, saying.lowered) / 100
                scored.append((-score - _LIKENESS * likeness, saying.text))
        scored.sort()
        return scored

    def _may_offer(self, gap: Gap) -> bool:
        return gap.whole and all(self._offered(action) and not _loses(action) for action in gap.actions)

    def _meant(self, meanings: Meanings) -> frozenset[Meaning]:
        """What a stretch may mean: values also as some value, and nouns as some value of theirs."""
        return meanings.all | {(self._nouns.get(name, name), "") for name, _ in meanings.all}

    def _telling(self, meanings: Sequence[Meanings]) -> list[tuple[Meanings, _Telling]]:
        """The stretches that tell of an intent."""
        found: list[tuple[Meanings, _Telling]] = []
        for each in meanings:
            meant = self._meant(each)
            if not any(name in self._needed for name, _ in meant):
                continue
            telling = self._tellings.get(meant)
            if telling is None:
                if len(self._tellings) >= REMEMBERED:
                    self._tellings.clear()
                telling = self._tellings[meant] = self._new_telling(meant)
            if telling.needing:
                found.append((each, telling))
        return found

    def _new_telling(self, meant: frozenset[Meaning]) -> _Telling:
        near = sorted({at for one in meant for at in self._meaning.get(one, ())})
        shared = ((_share(meant, self._words[at].meant), self._words[at]) for at in near)
        alike = [(share, word) for share, word in shared if share >= _ALIKE]
        needing = reduce(or_, (word.needing for _, word in alike), 0)
        return _Telling(meant, frozenset(name for name, _ in meant), alike, needing)


@dataclass(frozen=True, slots=True)
class _Word:
    """What a word or phrase of sayings may mean, the sayings that hold such a one, and those that need it."""

    meant: frozenset[Meaning]
    holding: int
    needing: int


@dataclass(slots=True)
class _Telling:
    """A stretch that tells of an intent, with the words of sayings that mean about the same."""

    meant: frozenset[Meaning]
    concepts: frozenset[str]
    alike: list[tuple[float, _Word]]
    needing: int
    _chances: dict[int, float] = field(default_factory=dict)

    def chance(self, intent: int) -> float:
        """The share of the sayings with such a word that need it and are of an intent."""
        found = self._chances.get(intent)
        if found is None:
            needing = sum(share * (word.needing & intent).bit_count() for share, word in self.alike)
            found = needing / sum(share * word.holding.bit_count() for share, word in self.alike)
            self._chances[intent] = found
        return found


def _longest(told: Sequence[tuple[Meanings, _Telling]]) -> list[_Telling]:
    """What those stretches tell that are in no other."""
    return [
        telling
        for each, telling in told
        if not any(o.start <= each.start and each.end <= o.end and o is not each for o, _ in told)
    ]


def _share(meant: frozenset[Meaning], other: frozenset[Meaning]) -> float:
    """How much of what either of two words may mean both may mean, 0 to 1."""
    both = len(meant & other)
    return both / (len(meant) + len(other) - both)


def _score(saying: Saying, intent: int, telling: Sequence[_Telling]) -> float:
    """How sure it is that a saying is of the intent of what was said; 0 where it must not be offered."""
    score, met = 0.0, 0
    for need, concepts in zip(saying.needs, saying.needed, strict=True):
        chances = [
            chance
            + (_SAME_VALUE if any(value and (name, value) in need for name, value in each.meant) else 0.0)
            for each in telling
            if not concepts.isdisjoint(each.concepts) and (chance := each.chance(intent))
        ]
        met += bool(chances)
        score += max(chances, default=0.0)
    whole = met == len(saying.needs)
    if not met or (saying.loses and not (whole and met > 1)):
        return 0.0
    return score / len(saying.needs) if met >= len(saying.needs) - 1 else 0.0
