"""Finds what a sentence points at: things that are on the road already, and places told from them.

Each becomes one edge. `meant.the` (the nearest car, all cones in lane 2, it) and `meant.some` (two cars) are
things; `place` gains "behind that car"; `goal` is where things are to be; `becomes` what they turn into;
`all_except` all but some. The words that make these are concepts of the language's data.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from service.grammar.build import CannotBuild, merge_places
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import Amount
from service.grammar.paths import SEPARATOR
from sim.types import PLACEABLE

RELATION = "relation"
"""Concept of words that tell a place from a thing ("behind"); its value is the side, or `near`."""
GOAL = "goal_mark"
"""Concept of words before the place where things are to be ("to")."""
BECOMES = "becomes_mark"
"""Concept of words before the kind that things become ("into"); its value says which verbs it goes with."""
EXCEPT = "except_mark"
"""Concept of words before what stays as it is ("except for")."""
ONES = "ones"
"""Concept of words that stand for the things of an exception: "those", "the one"."""
ALL_WORD = "all_word"
"""Concept of words for everything there is, or of the kind that follows: "all but two cars"."""
NEAR = "near"
EGO = "ego"
"""Concept of words for the vehicle itself."""
MEANT_THE, MEANT_SOME, GOAL_TOLD, GOAL_AT = "meant.the", "meant.some", "goal", "goal.at"
BECOME = ("becomes.into", "becomes.with", "becomes.for", "becomes.plain")
ALL_EXCEPT, ALL_BUT, ALL_OTHERS = "all_except", "all_but", "all_others"
POINTING = frozenset((RELATION, GOAL, BECOMES, EXCEPT, ONES, ALL_WORD)) | frozenset(
    (MEANT_THE, MEANT_SOME, GOAL_TOLD, GOAL_AT, ALL_EXCEPT, ALL_BUT, ALL_OTHERS, *BECOME)
)
"""Every concept of this file: those of words, and those of the edges made from them."""
_VERBS = frozenset(
    ("v.shift", "v.put", "v.exchange", "v.turn_into", "v.substitute", "v.copy", "v.were", "v.became")
)
_TRIGGERS = _VERBS | {RELATION, EXCEPT}
_NOUNS = frozenset(("noun.thing.one", "noun.thing.many"))
EVERYTHING = "everything"
MAX_PARTS = 3
"""How many parts of a place may stand one after another."""
MAX_PASSED = 4
"""How many words without meaning may stand among them."""
MAX_KINDS = 8
"""How many kinds an exception may list."""
_PLACES = ("side", "place")
_BARE_SIDES = ({"side": "left"}, {"side": "right"})
"""What is no place to go to, but a way: "to the left"."""
_ALL = frozenset(("all", "the_many", "those", "bare_many"))


@dataclass(frozen=True, slots=True)
class Meant:
    """Things that are on the road: how many of a kind, and where; several of them where they have ids."""

    kind: str
    count: int | str
    where: dict[str, Any] | None = None
    stay: dict[str, Any] | None = None
    """those of them that are left out"""


@dataclass(frozen=True, slots=True)
class Becomes:
    """The kind that things become, and whether its noun is that of many things, of one, or of both."""

    kind: str
    many: frozenset[bool]


def add_pointing(lattice: Lattice) -> None:
    """Adds an edge for everything that is pointed at. After noun phrases and references."""
    concepts = lattice.concepts
    if concepts.isdisjoint(_TRIGGERS) or not _names_things(lattice):
        return
    if RELATION in concepts:
        _add_landmarks(lattice)
    if EXCEPT in concepts:
        _add_exceptions(lattice)
    if concepts.isdisjoint(_VERBS):
        return
    _add_goals(lattice)
    _add_kinds(lattice)
    for at in range(lattice.size):
        lattice.edges[at] += [
            Edge(at, end, Sense(MEANT_THE if definite else MEANT_SOME, things))
            for end, things, definite in [*_things_at(lattice, at), *_placed_things(lattice, at)]
        ]


def _names_things(lattice: Lattice) -> bool:
    """Whether things on the road are named at all."""
    return not lattice.concepts.isdisjoint(_NOUNS) or any(
        edge.concept == "thing.id" for edge in lattice.all()
    )


def _things_at(
    lattice: Lattice, at: int, *, placed: bool = False
) -> Iterator[tuple[int, tuple[Meant, ...], bool]]:
    """Where they end, the things that the words from here name, and whether they are definite ones.

    `placed`: a place follows, so that "the car" may be another one than the vehicle itself.
    """
    if at >= lattice.size:
        return
    for edge in lattice.edges[at]:
        concept, amount = edge.sense.concept, edge.sense.value
        if concept == "nearest":
            for noun in lattice.edges[edge.end] if edge.end < lattice.size else ():
                if noun.concept == "thing.bare_one":
                    kind = noun.sense.value.of
                    yield noun.end, (Meant(kind, 1, {"nearest": True}),), True
        if not (concept.startswith("thing.") and isinstance(amount, Amount)):
            continue
        form = concept.partition(".")[2]
        if form == "id":
            kinds = [name.rpartition("-")[0] for name in amount.ids]
            ids = zip(kinds, amount.ids, strict=True)
            yield edge.end, tuple(Meant(kind, 1, {"id": name}) for kind, name in ids), True
        elif form == "the_one" and not placed and _names_ego(lattice, at, edge.end):
            continue  # "the car" is the vehicle itself
        elif (meant := _meant(form, amount)) is not None:
            yield edge.end, (meant,), form not in ("counted", "bare_many")


def _names_ego(lattice: Lattice, start: int, end: int) -> bool:
    """Whether these words, or the last of them, are the vehicle itself."""
    return any(edge.concept == EGO and edge.end == end for edge in lattice.between(start, end))


def _meant(form: str, amount: Amount) -> Meant | None:
    """The things that a noun phrase of this form names."""
    if form == "that":
        return Meant(amount.of, 1, {"nearest": True})
    if form == "the_one":
        return Meant(amount.of, 1)
    if form in _ALL:
        return Meant(amount.of, "all")
    if form in ("the_counted", "counted", "nearest") and isinstance(amount.count, int) and amount.count > 0:
        return Meant(amount.of, amount.count, {"nearest": True} if form == "nearest" else None)
    return None


def _placed_things(lattice: Lattice, at: int) -> Iterator[tuple[int, tuple[Meant, ...], bool]]:
    """The same with a place after them: "the cones in lane 2"."""
    for end, things, definite in list(_things_at(lattice, at, placed=True)):
        if len(things) == 1 and things[0].where is None:
            for stop, where in _places_from(lattice, end):
                yield stop, (Meant(things[0].kind, things[0].count, where),), definite


def _add_landmarks(lattice: Lattice) -> None:
    """ "Behind that car": a place seen from a thing."""
    for at in range(lattice.size):
        for relation in [edge for edge in lattice.edges[at] if edge.concept == RELATION]:
            side = {} if relation.sense.value == NEAR else {"side": relation.sense.value}
            for start in _past_article(lattice, relation.end):
                for end, things, _ in list(_things_at(lattice, start)):
                    of = _landmark(things)
                    if of is None or (_is_ego(lattice, at, end) and "id" not in of):
                        continue
                    other = [e for e in lattice.edges[at] if e.end != end or e.concept not in _PLACES]
                    lattice.edges[at] = [*other, Edge(at, end, Sense("place", {**side, "of": of}))]


def _past_article(lattice: Lattice, at: int) -> list[int]:
    """This place, and the one after a word without meaning: "the nearest car"."""
    if at >= lattice.size:
        return []
    return [at, *(edge.end for edge in lattice.edges[at] if edge.concept == GLUE and not edge.sense.form)]


def _landmark(things: tuple[Meant, ...]) -> dict[str, Any] | None:
    """One thing as that from which a place is told."""
    if len(things) != 1 or things[0].count != 1:
        return None
    (thing,) = things
    if thing.where is not None and "id" in thing.where:
        return dict(thing.where)
    return {"kind": thing.kind, "nearest": True}


def _is_ego(lattice: Lattice, start: int, end: int) -> bool:
    """Whether these words tell a place from the vehicle: "behind the car"."""
    return any(edge.end == end and edge.concept in _PLACES for edge in lattice.edges[start])


def _places_from(
    lattice: Lattice, at: int, parts: int = MAX_PARTS, passed: int = MAX_PASSED, *, staying: bool = False
) -> Iterator[tuple[int, dict[str, Any]]]:
    """Where it ends, each place that the words from here tell, of one part or several.

    `staying`: nothing moves, so that words before a goal say no more than "in".
    """
    if at >= lattice.size or not parts:
        return
    for edge in lattice.edges[at]:
        concept, value = edge.sense.concept, edge.sense.value
        if (concept == GLUE and not edge.sense.form) or concept == "prep":
            if not staying and any(e.concept == GOAL and e.end == edge.end for e in lattice.edges[at]):
                continue  # "to" does not lead to where a thing is, but to where it shall be
            if passed:
                yield from _places_from(lattice, edge.end, parts, passed - 1, staying=staying)
            continue
        part: dict[str, Any] | None = None
        if concept == "place" and isinstance(value, dict):
            part = value
        elif concept == "side":
            part = {"side": value}
        elif concept == "length":
            part = {"distance_m": value}
        elif concept == "cells.counted" and isinstance(value, Amount):
            part = {"cells": value.count}
        if part is None:
            continue
        if "distance_m" not in part and part.keys() != {"cells"}:
            yield edge.end, part
        for end, rest in _places_from(lattice, edge.end, parts - 1, staying=staying):
            try:
                yield end, merge_places([part, rest])
            except CannotBuild:
                continue


def _add_goals(lattice: Lattice) -> None:
    """ "To lane 3", "behind that car": where things are to be; `goal.at` ("in lane 3") is for putting."""
    for at in range(lattice.size):
        found = [
            Edge(at, end, Sense(GOAL_TOLD, where))
            for mark in lattice.edges[at]
            if mark.concept == GOAL
            for end, where in _places_from(lattice, mark.end)
            if not where.keys() & {"each", "id", "nearest"} and where not in _BARE_SIDES
        ]
        for end, where in list(_places_from(lattice, at)):
            if not where.keys() & {"each", "id", "nearest"}:
                told = "of" in where or where == {"side": "beside"}
                found.append(Edge(at, end, Sense(GOAL_TOLD if told else GOAL_AT, where)))
        lattice.edges[at] += found


def _add_kinds(lattice: Lattice) -> None:
    """ "Into potholes", "with a car": what things become."""
    for at in range(lattice.size):
        marks = [(edge.end, str(edge.sense.value)) for edge in lattice.edges[at] if edge.concept == BECOMES]
        found = [
            Edge(at, end, Sense(f"becomes.{value}", becomes))
            for mark, value in marks
            for end, becomes in _kinds_at(lattice, mark)
        ]
        found += [Edge(at, end, Sense("becomes.plain", kind)) for end, kind in _kinds_at(lattice, at)]
        lattice.edges[at] += found


def _kinds_at(lattice: Lattice, at: int) -> list[tuple[int, Becomes]]:
    """The kinds that the words from here name; a noun may be the same for one and for many."""
    found: dict[tuple[int, str], set[bool]] = {}
    for edge in lattice.edges[at] if at < lattice.size else ():
        amount = edge.sense.value
        if edge.concept == "thing.bare_many":
            found.setdefault((edge.end, amount.of), set()).add(True)
        elif edge.concept == "thing.bare_one":
            found.setdefault((edge.end, amount.of), set()).update((True, False))
        elif edge.concept == "thing.counted" and amount.count == 1:
            found.setdefault((edge.end, amount.of), set()).add(False)
    return [(end, Becomes(kind, frozenset(many))) for (end, kind), many in found.items()]


def _add_exceptions(lattice: Lattice) -> None:
    """ "All cars except the nearest": what goes, with what stays."""
    for at in range(lattice.size):
        found = []
        for kind, end in _wholes(lattice, at):
            for mark in _marks_after(lattice, end):
                for stop, value in _stays(lattice, mark, kind):
                    name = ALL_EXCEPT if "except" in value else ALL_BUT
                    found.append(Edge(at, stop, Sense(name, value)))
                if kind == EVERYTHING:
                    others = _other_kinds(lattice, mark, ())
                    found += [Edge(at, stop, Sense(ALL_OTHERS, kinds)) for stop, kinds in others]
        lattice.edges[at] += found


def _wholes(lattice: Lattice, at: int) -> list[tuple[str | None, int]]:
    """All of a kind, or all there is (None: of a kind that is still to be said)."""
    found: list[tuple[str | None, int]] = []
    for edge in lattice.edges[at]:
        concept, value = edge.sense.concept, edge.sense.value
        if concept == ALL_WORD:
            found.append((None if value == "all" else EVERYTHING, edge.end))
        elif isinstance(value, Amount) and concept in ("thing.all", "thing.the_many", "thing.bare_many"):
            found.append((value.of, edge.end))
    return found


def _marks_after(lattice: Lattice, at: int) -> list[int]:
    """The ends of the words for an exception that follow, with a comma before them or without."""
    starts = [at]
    if at < lattice.size:
        starts += [e.end for e in lattice.edges[at] if e.concept == SEPARATOR and e.sense.value == "pause"]
    return [
        edge.end
        for start in starts
        if start < lattice.size
        for edge in lattice.edges[start]
        if edge.concept == EXCEPT
    ]


def _other_kinds(
    lattice: Lattice, at: int, named: tuple[str, ...]
) -> Iterator[tuple[int, tuple[Meant, ...]]]:
    """All things of the kinds that an exception does not name: "the cones and the cars"."""
    if not named:
        for start in _past_article(lattice, at):
            for end, things, _ in list(_things_at(lattice, start)):
                if len(things) == 1 and things[0].count == 1 and things[0].where == {"nearest": True}:
                    one = things[0]
                    yield (
                        end,
                        tuple(
                            Meant(kind, "all", stay=one.where if kind == one.kind else None)
                            for kind in PLACEABLE
                        ),
                    )
    for edge in lattice.edges[at] if at < lattice.size else ():
        if edge.concept not in ("thing.all", "thing.the_many", "thing.bare_many"):
            continue
        kinds = (*named, edge.sense.value.of)
        others = tuple(Meant(kind, "all") for kind in PLACEABLE if kind not in kinds)
        after = (
            [e for e in lattice.edges[edge.end] if e.concept == SEPARATOR] if edge.end < lattice.size else []
        )
        if others:
            yield edge.end, others
        for separator in after:
            yield from _other_kinds(lattice, separator.end, kinds)


def _stays(lattice: Lattice, at: int, kind: str | None) -> Iterator[tuple[int, dict[str, Any]]]:
    """What an exception leaves: the nearest, those at a place, one by its id, or so many."""
    for start in _past_article(lattice, at):
        for edge in lattice.edges[start] if start < lattice.size else ():
            concept, value = edge.sense.concept, edge.sense.value
            if concept == "nearest" and kind is not None:
                yield edge.end, {"kind": kind, "except": {"nearest": True}}
            if concept == ONES and kind is not None:
                for end, where in _places_from(lattice, edge.end, staying=True):
                    if not where.keys() & {"each", "nearest"}:
                        yield end, {"kind": kind, "except": where}
            if concept == "thing.counted" and kind in (None, value.of) and isinstance(value.count, int):
                yield edge.end, {"kind": value.of, "count": value.count}
        for end, things, definite in list(_things_at(lattice, start)):
            thing = things[0]
            named = kind == EVERYTHING and thing.where is not None and "id" in thing.where
            fits = kind in (None, thing.kind) or named
            if len(things) == 1 and definite and fits and thing.count == 1 and thing.where is not None:
                yield end, {"kind": thing.kind if kind is None else kind, "except": thing.where}
