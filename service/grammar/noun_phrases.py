"""Nouns and their quantities as one: "all of the cars", "3 more cones", "exactly nine potholes".

A noun and the quantities just before it become one edge whose concept says which kind of amount
it is: `thing.counted` (five potholes), `.more` (two more), `.exact` (exactly nine), `.all` (every),
`.the_many`, `.the_one`, `.that`, `.those`, `.bare_many`, `.bare_one`, `.any`, `.any_one`, `.none`, `.post`
("potholes: 10"), `.too_many`, `.too_few`. Frames say which of these they take, and so what a definite
plural means.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from service.grammar.lattice import NUMBER, Edge, Lattice
from service.grammar.lexicon import Sense

NOUN = "noun."
QUANTITY = "quantity"
COLON = "colon"
OF_THE = "of_the"
"""Value of quantities that need another before them: "two of the"."""

WITHOUT = "v.without"
"""Concept of words that suppose things not to be there: "without the car, what would you do?"."""
ODD = "odd"
"""Value of quantities that no request has a use for ("every other"), and the form of such nouns."""

BEYOND = "beyond"
"""That of words that are odd before things only: "over ten cars", but "over ten episodes"."""

NEAREST = "nearest"
"""That of words which, between a number and a noun, say which are meant: "the two closest cones"."""

THINGS = "thing"
"""What nouns for things on the road are."""

DETERMINED = "the"
"""Form of senses that hold only after a bare definite article: "the car" is the vehicle itself."""

_CHANGES = ("more", "fewer")
"""Values of quantities that may stand after a counted noun: "two cones more"."""

_AMOUNTS = frozenset((NUMBER, QUANTITY))


_MEASURES = frozenset(("length", "cells.counted"))
_PLACING = "prep"
_LONGEST_MEASURE = 4
"""Tokens of the longest measure, or word before one, that is looked at."""


@dataclass(frozen=True, slots=True)
class Amount:
    """What a noun phrase says: how many of what."""

    of: str
    count: int | float | None
    ids: tuple[str, ...] = ()
    """the very things, where they are known"""


@dataclass(slots=True)
class _Gathered:
    """The quantities found before a noun."""

    start: int
    number: int | float | None = None
    said: set[str] = field(default_factory=set)


def add_noun_phrases(lattice: Lattice, vague: int) -> None:
    """Give each noun its quantity; a bare noun's edge is replaced. `vague` is what "a few" counts as."""
    named = {concept for concept in lattice.concepts if concept.startswith(NOUN)}
    if not named:
        return
    amounts: dict[int, list[Edge]] = {}
    for starting in lattice.edges:
        for edge in starting:
            if edge[2][0] in _AMOUNTS:
                amounts.setdefault(edge[1], []).append(edge)
    odd = [edge for ending in amounts.values() for edge in ending if edge.sense.value == ODD]
    without = {edge.end for edge in lattice.all() if edge.concept == WITHOUT}
    for at in range(lattice.size):
        nouns = [edge for edge in lattice.edges[at] if edge[2][0] in named]
        if not nouns:
            continue
        things = any(edge.concept.split(".")[1] == THINGS for edge in nouns)
        gathered = _gather(amounts, at, beyond=things)
        if any(edge.start < at < edge.end for edge in odd):  # of "every other car", "other car" is no noun
            gathered.said.add(ODD)
        if things and gathered.start == at and _measured(lattice, at):
            gathered.said.add(ODD)
        here = lattice.edges[at]
        lattice.edges[at] = [e for e in here if e[2][0] not in named and e[2][2] != DETERMINED]
        if gathered.said == {"the"} and gathered.number is None:
            lattice.edges[at] += [
                Edge(gathered.start, edge.end, Sense(edge.sense.concept, edge.sense.value))
                for edge in here
                if edge.sense.form == DETERMINED
            ]
        for noun in nouns:
            phrase = _joined(gathered, noun, vague)
            lattice.edges[gathered.start].append(phrase)
            if "no" in gathered.said and (supposed := _supposed_away(amounts, at, without)) is not None:
                lattice.edges[supposed.start].append(_joined(supposed, noun, vague))
            after = _number_after(lattice, phrase)
            if after is None:
                after = _change_after(lattice, phrase)
            if after is not None:
                lattice.edges[gathered.start].append(after)
            elif gathered.number is not None and not gathered.said and _follows_noun(lattice, gathered.start):
                # "potholes 10 vehicles 2": the number may be the noun's before.
                alone = _joined(_Gathered(at), noun, vague)
                after = _number_after(lattice, alone)
                if after is not None:
                    lattice.edges[at].append(after)


def understood_nouns(lattice: Lattice, start: int, end: int, noun: Edge, vague: int) -> list[Edge]:
    """Edges in which an amount stands for the noun spoken of before: "and two in the right lane"."""
    amounts: dict[int, list[Edge]] = {}
    for edge in lattice.between(start, end):
        if edge.sense.concept in _AMOUNTS:
            amounts.setdefault(edge.end, []).append(edge)
    found: list[Edge] = []
    for at in sorted(amounts):
        gathered = _gather(amounts, at)
        whole = gathered.number is not None or gathered.said & {"another", "vague"}
        if whole and gathered.start >= start and not any(edge.start < at < edge.end for edge in found):
            name = noun.concept.partition(".")[0]
            sense = Sense(f"noun.{name}.many", noun.sense.value.of)
            found.append(_joined(gathered, Edge(at, at, sense), vague))
    return found


def _gather(amounts: dict[int, list[Edge]], noun: int, *, beyond: bool = True) -> _Gathered:
    """The quantities that end where the noun starts, longest words first, at most one number.

    Unless `beyond`, "over" is none of them: what it says before ticks or runs is for their frames.
    """
    gathered = _Gathered(noun)
    while gathered.start in amounts:
        before = amounts[gathered.start]
        if gathered.number is not None:
            before = [edge for edge in before if edge.sense.concept != NUMBER]
        before = [edge for edge in before if edge.sense.value != OF_THE or edge.start in amounts]
        if not beyond:
            before = [edge for edge in before if edge.sense.value != BEYOND]
        if not before:
            break
        if gathered.number is None:
            before = [e for e in before if e.sense.value != NEAREST or _numbered(amounts, e.start)]
            if not before:
                break
        longest = min(before, key=lambda edge: (edge.start, edge.sense.concept != NUMBER))
        if longest.concept == NUMBER:
            gathered.number = longest.sense.value
        else:
            gathered.said.add(str(longest.sense.value))
        gathered.start = longest.start
    return gathered


def _supposed_away(amounts: dict[int, list[Edge]], noun: int, without: set[int]) -> _Gathered | None:
    """The quantities after a word that supposes things not to be there, which may be read as "no" as well."""
    others = {
        end: [edge for edge in edges if edge.sense.value != "no"]
        for end, edges in amounts.items()
        if any(edge.sense.value != "no" for edge in edges)
    }
    gathered = _gather(others, noun)
    return gathered if gathered.start in without else None


def _numbered(amounts: Mapping[int, Sequence[Edge]], at: int) -> bool:
    """Whether a number ends where a word begins."""
    return any(edge.concept == NUMBER for edge in amounts.get(at, ()))


def _joined(gathered: _Gathered, noun: Edge, vague: int) -> Edge:
    _, name, grammatical = noun.concept.split(".")
    if BEYOND in gathered.said:
        gathered = _Gathered(gathered.start, gathered.number, {ODD})
    form, count = _form(gathered, grammatical == "many", vague)
    return Edge(gathered.start, noun.end, Sense(f"{name}.{form}", Amount(str(noun.sense.value), count)))


def _form(gathered: _Gathered, many: bool, vague: int) -> tuple[str, int | float | None]:
    """The kind of amount and the count, from the words before the noun."""
    said, number = gathered.said - {"filler"}, gathered.number
    if "other" in said:  # "the other two cars" are no two more
        if said & {"the", "those", OF_THE, "all"}:
            return (ODD, None)
        said = said - {"other"} | {"more"}
    if ODD in said:
        return (ODD, None)
    if "half" in said or "both" in said:
        if number is not None or len(said) > 1:
            return (ODD, None)
        return ("half", None) if "half" in said else ("the_counted", 2)
    if said & {"too_many", "too_few"}:
        (excess,) = said & {"too_many", "too_few"} if len(said) == 1 and number is None else (ODD,)
        return (excess, None)
    if "how" in said:
        return ("asked", None)
    if "no" in said:
        return ("none", 0) if said == {"no"} and number is None else (ODD, None)
    if "any" in said:
        if number is not None or not said <= {"any", "more", "the"}:
            return (ODD, None)
        return ("any" if many else "any_one", None)
    if "last" in said:
        odd = said - {"last", "the"}
        return (ODD, None) if odd else ("last", None) if number is None else ("last_counted", number)
    if NEAREST in said:
        return (NEAREST, number) if said <= {NEAREST, "the", "those"} else (ODD, None)
    if number is not None:
        if "all" in said:
            return ("all", None) if isinstance(number, int) else (ODD, None)
        if said & {"every", "that", "vague"}:
            return (ODD, None)
        if "those" in said:
            return ("those_counted", number)
        if "exact" in said:
            return (ODD, None) if "more" in said else ("exact", number)
        if said & {"more", "another"}:
            return ("more", number)
        if "fewer" in said:
            return ("fewer", number)
        return ("the_counted", number) if said & {"the", OF_THE} else ("counted", number)
    if "fewer" in said:
        return _fewer(said, vague)
    if said & {"all", "every"}:
        return ("all", None)
    if "those" in said:
        return ("those", None)
    if "that" in said:
        return ("those", None) if many else ("that", None)
    if "another" in said:
        return ("more", 1)
    if "vague" in said:
        return ("more" if "more" in said else "counted", vague)
    if "a" in said:
        return ("exact" if "exact" in said else "more" if "more" in said else "counted", 1)
    if "more" in said:
        return ("more_bare" if many else "more_bare_one", None)
    if "exact" in said:
        return (ODD, None)
    if "the" in said:
        return ("the_many" if many else "the_one", None)
    return ("bare_many" if many else "bare_one", None)


def _fewer(said: set[str], vague: int) -> tuple[str, int | None]:
    """The kind of amount and the count of "fewer" without a number: "a few fewer", "one less", "fewer"."""
    if said - {"fewer", "the", "vague", "a"}:
        return (ODD, None)
    if said & {"vague", "a"}:
        return ("fewer", vague if "vague" in said else 1)
    return ("fewer_bare", None)


def _measured(lattice: Lattice, at: int) -> bool:
    """Whether a bare measure stands before a noun, neither a place nor a count: "2 cells potholes"."""
    before = lattice.between(max(0, at - _LONGEST_MEASURE), at)
    starts = [edge.start for edge in before if edge.end == at and edge.concept in _MEASURES]
    if not starts or any(
        edge.concept in (NUMBER, COLON) for e in lattice.edges[at] for edge in _at(lattice, e.end)
    ):
        return False
    start = min(starts)
    placing = lattice.between(max(0, start - _LONGEST_MEASURE), start)
    return not any(edge.end == start and edge.concept.startswith(_PLACING) for edge in placing)


def _follows_noun(lattice: Lattice, at: int) -> bool:
    """Whether a thing stands just before a token."""
    return at > 0 and any(
        edge.end == at and isinstance(edge.sense.value, Amount)
        for edge in lattice.between(max(0, at - 3), at)
    )


def _number_after(lattice: Lattice, phrase: Edge) -> Edge | None:
    """ "potholes: 10": a bare noun takes the number that follows it."""
    name, _, form = phrase.concept.partition(".")
    if form not in ("bare_many", "bare_one"):
        return None
    at = phrase.end
    if at < lattice.size and any(edge.sense.concept == COLON for edge in lattice.edges[at]):
        at += 1
    if at >= lattice.size:
        return None
    for edge in lattice.edges[at]:
        if edge.sense.concept == NUMBER:
            amount = Amount(phrase.sense.value.of, edge.sense.value)
            of_them = [e.end for e in _at(lattice, edge.end) if e.sense.value == OF_THE]
            edge = edge._replace(end=max(of_them, default=edge.end))
            more = next((e for e in _at(lattice, edge.end) if e.sense.value == "more"), None)
            if more is not None:
                return Edge(phrase.start, more.end, Sense(f"{name}.more", amount))
            return Edge(phrase.start, edge.end, Sense(f"{name}.post", amount))
    return None


def _change_after(lattice: Lattice, phrase: Edge) -> Edge | None:
    """ "fifteen potholes more", "one lane less": a counted noun takes the word for a change after it."""
    name, _, form = phrase.concept.partition(".")
    if form != "counted":
        return None
    for edge in _at(lattice, phrase.end):
        if edge.concept == QUANTITY and edge.sense.value in _CHANGES and edge.end == phrase.end + 1:
            return Edge(phrase.start, edge.end, Sense(f"{name}.{edge.sense.value}", phrase.sense.value))
    return None


def _at(lattice: Lattice, at: int) -> list[Edge]:
    return lattice.edges[at] if at < lattice.size else []
