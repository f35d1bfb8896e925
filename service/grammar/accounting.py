"""Accounts for the words that decide what the words beside them mean, and for which words made an action.

"To", "by", "too", "for" say little alone and are glue in most places. Beside an amount or a value they change
what it means: "to 20 km/h" is no "by 20 km/h", "too dark" is no "dark". Such a word is a *marker*. Which
words are markers, and in which role, is data (`marker.…` in the lexicon). In its role a marker is never glue:
its readings without a meaning are withheld before any frame is tried, so that only a frame with a use for it
can take the sentence. Where none has, the refusal names the marker and what it stands with.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from contextlib import contextmanager

from service.grammar.fragments import TAG
from service.grammar.frames import Filled
from service.grammar.lattice import GLUE, NUMBER, Edge, Lattice, Withheld
from service.grammar.lexicon import SECOND, Sense
from service.grammar.noun_phrases import NOUN, QUANTITY
from service.grammar.parse_types import Span
from service.grammar.paths import SEPARATOR, SPEAKER
from service.grammar.tokens import Token

AMOUNT = "marker.amount"
"""Role of words that say what an amount after them is: "to 20", "by 20", "over 20"."""

MEASURE = "marker.measure"
"""Role of words that do so before a number with a unit, or of ticks: "for five seconds"."""

DEGREE = "marker.degree"
"""Role of words that turn the word after them round, and are glue at the end: "too dark", but "rain too"."""

THING = "marker.thing"
"""Role of words that belong to a noun for a thing after them: "that car" is not the vehicle itself."""

POINTER = "marker.pointer"
"""Role of those that point at a thing after them: in "copy that car" there is no "copy that"."""

PHRASE = "marker.phrase"
"""Role of phrases whose words say nothing more alone, wherever they stand: "next to"."""

WHOLE = "marker.whole"
"""Role of phrases none of whose words may be passed over: "why will you" asks about what is to come."""

CLAUSE = "marker.clause"
"""Words that begin a clause of condition or time; they are no part of a name without quotation marks."""

IDIOM = "marker.idiom"
"""Phrases of other subjects: none of their words means anything alone: "snow globe", "on the road again"."""

MARKERS = frozenset((AMOUNT, MEASURE, DEGREE, THING, POINTER, PHRASE, WHOLE, CLAUSE, IDIOM))

LONGEST_BEFORE = 4
"""Tokens of the longest phrase before a pointing word that is looked at."""

VERB = "v."
"""What the concepts of verbs begin with; before one a word of degree is the sign of an infinitive."""

SERVES = "prep."
"""What the concepts begin with whose frames use the word before an amount."""

PLACING = "prep.place"
"""Concept of those before a place; before so many things there is no place: "at 40 potholes"."""

_MEASURED = frozenset(("length", "speed", "seconds", "fraction", "times", "real_times"))
_PARTS = frozenset((NUMBER, "part_of", "factor", "factor_of"))
_THINGS = ("noun.thing.one", "noun.thing.many")


def withhold(lattice: Lattice, free: Set[str], idle: Set[str]) -> None:
    """Take the markers out of a lattice that was just scanned, and what they cannot be where they stand.

    `free` are the concepts that frames take without a use for them, `idle` those that no frame has one for.
    """
    if lattice.concepts.isdisjoint(MARKERS):
        return
    lattice.concepts -= MARKERS
    markers: list[Edge] = []
    for starting in lattice.edges:
        found = [edge for edge in starting if edge[2][0] in MARKERS]
        if found:
            markers += found
            starting[:] = [edge for edge in starting if edge[2][0] not in MARKERS]
    for marker in markers:
        end = _operand(lattice, marker)
        if end is None:
            continue
        loose = _loose(lattice, marker, idle if marker.concept in (AMOUNT, WHOLE) else free)
        if loose:
            lattice.withheld.append(Withheld(marker.start, end, tuple(loose)))
    for each in lattice.withheld:
        for edge in each.edges:
            if edge in lattice.edges[edge.start]:
                lattice.edges[edge.start].remove(edge)


@contextmanager
def restored(lattice: Lattice, withheld: Sequence[Withheld], end: int) -> Iterator[None]:
    """For a while, words may be all that was withheld, and passed over with what they govern, up to `end`."""
    before = {each.start: list(lattice.edges[each.start]) for each in withheld}
    for each in withheld:
        here = lattice.edges[each.start]
        here.append(Edge(each.start, min(each.end, end), Sense(GLUE)))
        here += [edge for edge in each.edges if edge.start == each.start]
    yield
    for start, edges in before.items():
        lattice.edges[start] = edges


def _operand(lattice: Lattice, marker: Edge) -> int | None:
    """Where that ends which a marker decides about, or None where it is in no role."""
    at = marker.end
    if marker.concept in (PHRASE, WHOLE, IDIOM):
        return at
    if at >= lattice.size:
        return None
    here = lattice.edges[at]
    match marker.concept:
        case role if role == DEGREE:
            if any(edge.concept in (SEPARATOR, TAG) for edge in here):
                return None
            if here and all(edge.concept.startswith(VERB) for edge in here):
                return None
            return max([edge.end for edge in here if edge.concept != GLUE], default=at + 1)
        case role if role in (THING, POINTER):
            return _thing_end(lattice, at)
        case role if role == MEASURE:
            return _amount_end(lattice, at, things=False)
        case role if role == AMOUNT:
            return _amount_end(lattice, at, things=True)
    return None


def _amount_end(lattice: Lattice, at: int, *, things: bool) -> int | None:
    """Where the amount ends that begins at a token; one of things on the road counts only with `things`."""
    ends: list[int] = []
    for edge in lattice.edges[at]:
        if edge.concept in _MEASURED:
            ends.append(edge.end)
        elif edge.concept in _PARTS:
            if not things and edge.end < lattice.size and _names_thing(lattice, edge.end):
                continue
            ends += [edge.end, *_noun_ends(lattice, edge.end)]
    return max(ends, default=None)


def _counts_things(lattice: Lattice, at: int) -> bool:
    """Whether a number of things begins at a token."""
    return any(
        edge.concept == NUMBER and edge.end < lattice.size and _names_thing(lattice, edge.end)
        for edge in lattice.edges[at]
    )


def _thing_end(lattice: Lattice, at: int) -> int | None:
    """Where the noun for a thing ends that begins at a token, if nothing longer does."""
    longest = max((edge.end for edge in lattice.edges[at]), default=at)
    return longest if any(e.end == longest and e.concept in _THINGS for e in lattice.edges[at]) else None


def _noun_ends(lattice: Lattice, at: int) -> list[int]:
    here = lattice.edges[at] if at < lattice.size else []
    return [edge.end for edge in here if edge.concept.startswith(NOUN)]


def _names_thing(lattice: Lattice, at: int) -> bool:
    return any(edge.concept in _THINGS for edge in lattice.edges[at])


def _loose(lattice: Lattice, marker: Edge, free: Set[str]) -> list[Edge]:
    """The edges within a marker that would leave it without a use."""
    inside = (
        edge
        for starting in lattice.edges[marker.start : marker.end]
        for edge in starting
        if edge.end <= marker.end
    )
    if marker.concept == IDIOM:
        return list(inside)
    if marker.concept in (AMOUNT, MEASURE):
        passed = free | ({GLUE, SECOND} if marker.end == marker.start + 1 else {GLUE})
        placing = {PLACING} if _counts_things(lattice, marker.end) else frozenset()
        before = [e for e in _reaching_into(lattice, marker) if e.concept == GLUE]  # "time to 3 ticks"
        return before + [
            e
            for e in inside
            if (e.concept in passed and not e.concept.startswith(SERVES)) or e.concept in placing
        ]
    loose = free | {GLUE, SECOND, SPEAKER}
    if marker.concept == PHRASE:  # its first word decides: "in the rain", but "bring in the rain"
        here = [edge for edge in lattice.edges[marker.start] if edge.end <= marker.end]
        return [edge for edge in here if edge.concept in loose or edge.concept.startswith(SERVES)]
    found = [edge for edge in inside if edge.concept in loose]
    if marker.concept == WHOLE:
        return [edge for edge in found if (edge.start, edge.end) != (marker.start, marker.end)]
    if marker.concept == POINTER:
        found += _ending_with(lattice, marker)
    return found


def _reaching_into(lattice: Lattice, marker: Edge) -> list[Edge]:
    """The edges that begin before a marker and end in it: the "at all" of "at all but two"."""
    before = lattice.edges[max(0, marker.start - LONGEST_BEFORE) : marker.start]
    return [edge for starting in before for edge in starting if marker.start < edge.end <= marker.end]


def _ending_with(lattice: Lattice, marker: Edge) -> list[Edge]:
    """The edges that begin before a marker and end with it, but for quantities: "copy that"."""
    return [
        edge
        for starting in lattice.edges[max(0, marker.start - LONGEST_BEFORE) : marker.start]
        for edge in starting
        if edge.end == marker.end and edge.concept != QUANTITY
    ]


def alignment(
    filled: Filled, actions: Sequence[Mapping[str, object]], tokens: Sequence[Token]
) -> list[tuple[Span, ...]]:
    """For each action of a clause the words that made it, as stretches of characters in order.

    Where a frame makes one action of each thing said, those of the other things are not among them.
    """
    turns = filled.of(*filled.frame.per) if filled.frame.per else []
    each = len(filled.frame.actions)
    spans: list[tuple[Span, ...]] = []
    for number in range(len(actions)):
        own = turns[number // each] if turns and number // each < len(turns) else None
        slots = [edge for edge in filled.slots if own is None or edge is own or edge not in turns]
        spans.append(_spans(slots, tokens))
    return spans


def _spans(slots: Sequence[Edge], tokens: Sequence[Token]) -> tuple[Span, ...]:
    """The stretches of characters of some edges, those that touch as one."""
    spans: list[Span] = []
    for first, last in sorted({(e.start, e.end) for e in slots if e.start < e.end <= len(tokens)}):
        start, end = tokens[first].start, tokens[last - 1].end
        if spans and start <= spans[-1][1] + 1:
            spans[-1] = spans[-1][0], max(end, spans[-1][1])
        else:
            spans.append((start, end))
    return tuple(spans)
