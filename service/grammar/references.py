"""Resolves references to what was said before: "it", "those", "again", "the other lane".

A reference gets the edges of its referent, so frames treat "it" like "pothole-3". Nothing is guessed where
there are several candidates: they are returned, and asked about. "That pothole" is the nearest pothole where
none was spoken of; its frame says so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, replace

from service.actions import Undo, dump
from service.grammar.fragments import REPEATED
from service.grammar.last_request import steps_of_two, turned
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import Amount
from service.grammar.parse_types import Parse, Refused, Understood
from service.grammar.referents import (
    MAX_CANDIDATES,
    Unclear,
    every_thing,
    next_thing,
    other_things,
    several_things,
    so_many_things,
    some_things,
    thing_edge,
)
from service.grammar.said_before import done_anew, take_back, take_back_change
from service.grammar.tokens import Token
from service.grammar.topic import Phrases, Topic
from sim.actions import Adjust, MoveThings, Remove, Replace, Set, Swap, Where
from sim.types import kind_of

REFERS = "refers"
"""Concept of words that refer; their value says how."""

GOAL = "goal_mark"
"""Concept of words before a destination: "to"."""

TAUGHT = "taught"
TAUGHT_WITH_NUMBERS = "taught_with_numbers"

_REFERRING = frozenset(
    (REFERS, "thing.that", "thing.those", "thing.the_one", "thing.last", "thing.last_counted")
)
_MOVED = (Remove, MoveThings, Replace, Swap, Set, Adjust)
"""Actions after which "put it back" is to undo them."""

_WHOLE = frozenset(("other", "others", "next", "both"))
"""References of several words that are small words of other requests by themselves."""

_OPPOSITE = {"left": "right", "right": "left"}


def parse_in_topic(parse: Callable[[str, Topic], Parse], text: str, topic: Topic) -> Parse:
    """What a text means; a taught phrase counts only where the language has no meaning of its own for it.

    So "carry on" stays what it is when "carry" was taught. A phrase with a number comes before a bare count
    of things, which is all that it may mean otherwise: "wall 5".
    """
    if not topic.phrases.by_first:
        return parse(text, topic)
    if counted := topic.phrases.with_numbers_in(text):
        known = parse(text, topic)
        if not isinstance(known, Refused) or any(each.actions is None for each in counted):
            return known
    alone = parse(text, replace(topic, phrases=Phrases()))
    if isinstance(alone, Refused) and alone.reason == "not_understood":
        return parse(text, topic)
    if isinstance(alone, Understood) and alone.corrections:
        # A word that looked mistyped may be a taught one.
        known = parse(text, topic)
        return alone if isinstance(known, Refused) else known
    return alone


def add_known(lattice: Lattice, tokens: Sequence[Token], topic: Topic) -> None:
    """Edges for ids, and for phrases that were taught."""
    phrases = topic.phrases if topic.phrases.by_first else None
    for at, token in enumerate(tokens):
        if token.id:
            lattice.edges[at].append(thing_edge(at, at + 1, (token.text,)))
        taught = None if phrases is None else phrases.at(tokens, at)
        if taught is not None and taught.has_numbers:
            for inside in range(at, taught.end):  # its words say nothing else: "wall 5"
                lattice.edges[inside] = [edge for edge in lattice.edges[inside] if edge.end > taught.end]
        if taught is not None and taught.actions is not None:
            for concept in (TAUGHT, TAUGHT_WITH_NUMBERS) if taught.has_numbers else (TAUGHT,):
                lattice.edges[at].append(Edge(at, taught.end, Sense(concept, taught.actions)))


def add_referents(lattice: Lattice, topic: Topic) -> list[Unclear]:
    """Edges for all that words refer to; what stays unclear. After noun phrases were found."""
    unclear: list[Unclear] = []
    for edge in [edge for starting in lattice.edges for edge in starting if edge[2][0] in _REFERRING]:
        found = _pronoun(edge, lattice, topic) if edge.sense.concept == REFERS else _pointed(edge, topic)
        of_several = edge.sense.concept == REFERS and (
            isinstance(edge.sense.value, dict) or edge.sense.value in _WHOLE
        )
        if of_several and _ends_here(lattice, edge):
            _keep_whole(lattice, edge)
        if isinstance(found, Unclear):
            unclear.append(found)
            if edge.sense.concept != REFERS and found.candidates:
                lattice.edges[edge.start].remove(edge)
        elif found is not None:
            if edge.sense.concept != REFERS:
                lattice.edges[edge.start].remove(edge)
            lattice.edges[edge.start].append(found)
    # Of "in the other lane" and "the other lane" the shorter first: what is put in its place keeps the "in".
    return sorted(unclear, key=lambda each: (each.end, -each.start) if each.lane else (0, 0))


def _pronoun(edge: Edge, lattice: Lattice, topic: Topic) -> Edge | Unclear | None:
    """What a word that stands for something stands for."""
    start, end = edge.start, edge.end
    match edge.sense.value:
        case "one" if len(topic.things) == 1:
            return thing_edge(start, end, topic.things)
        case "one":
            return Unclear(start, end, topic.things[-MAX_CANDIDATES:])
        case "all" if len(topic.things) > 1:
            return thing_edge(start, end, topic.things)
        case "all" | "both" as which:
            return several_things(start, end, topic, both=which == "both")
        case "every":
            return every_thing(start, end, topic)
        case "person" if len(topic.things) == 1 and kind_of(topic.things[0]) == "pedestrian":
            return thing_edge(start, end, topic.things)
        case "person":
            people = tuple(name for name in topic.things if kind_of(name) == "pedestrian")
            return Unclear(start, end, people[-MAX_CANDIDATES:])
        case "last" if topic.added:
            return thing_edge(start, end, topic.added[-1:])
        case "again" if topic.undone:
            return Edge(start, end, Sense(REPEATED, [{"do": "redo"}]))
        case "again" if topic.actions:
            return Edge(start, end, Sense(REPEATED, dump(topic.actions)))
        case "there" if topic.where is not None:
            said = {key: part for key, part in asdict(topic.where).items() if part is not None}
            return Edge(start, end, Sense("place", said))
        case {"nth": int() as number} if 0 < number <= len(topic.listed):
            if topic.listed[number - 1] in topic.gone:
                there = tuple(name for name in topic.listed if name not in topic.gone)
                return Unclear(start, end, there[-MAX_CANDIDATES:])
            return thing_edge(start, end, topic.listed[number - 1 : number])
        case "opposite" if (other := turned(topic)) is not None:
            return Edge(start, end, Sense(REPEATED, dump(done_anew(topic, other))))
        case "since" if topic.tick is not None:
            asked = [{"do": "ask", "about": "history", "what": "since", "tick": topic.tick}]
            return Edge(start, end, Sense(REPEATED, asked))
        case {"its": str() as side}:
            return _beside_it(edge, lattice, topic, side)
        case {"some": int() | "half" as number}:
            return some_things(start, end, topic, number)
        case {"all": int() as number}:
            return so_many_things(start, end, topic, number)
        case {"others": int() as number}:
            left = other_things(start, end, topic, one=False)
            fits = isinstance(left, Edge) and len(left.sense.value.ids) == number
            return left if fits else Unclear(start, end)
        case "next":
            return next_thing(start, end, topic)
        case "other" | "others" as which:
            return other_things(start, end, topic, one=which == "other")
        case "back" if _took_away(topic) and not _goes_to(lattice, end):
            return Edge(start, end, Sense(REPEATED, dump((take_back_change(topic),))))
        case "back_both" | "undo_both" as which if steps := steps_of_two(
            topic, put_back=which == "back_both"
        ):
            return Edge(start, end, Sense(REPEATED, dump((Undo(steps=steps if steps > 1 else None),))))
        case "not_that" if _pointed_at(topic):
            return Edge(start, end, Sense(REPEATED, dump((take_back(topic),))))
        case "closest" if topic.listed:
            kinds = {kind_of(name) for name in topic.batch or topic.listed}
            kind = {"kind": kinds.pop(), "count": 1} if len(kinds) == 1 else {}
            return Edge(start, end, Sense(REPEATED, [{"do": "ask", "about": "scene", **kind}]))
        case "same_lane" | "other_lane" as which:
            lane = _lane_before(lattice, start, topic.where)
            if which == "other_lane":
                lane = _OPPOSITE.get(str(lane))
            if lane is not None:
                return Edge(start, end, Sense("place", {"lane": lane}))
            return Unclear(start, end, lane=True)
        case _:
            return Unclear(start, end)


def _ends_here(lattice: Lattice, outer: Edge) -> bool:
    """Whether no phrase begins in an edge and goes on behind it, as the "third lane" of "the third" does."""
    inside = range(outer.start + 1, outer.end)
    return all(edge.end <= outer.end for at in inside for edge in lattice.edges[at])


def _keep_whole(lattice: Lattice, outer: Edge) -> None:
    """Let no word of a reference mean anything by itself: the "one" of "the first one" is no amount.

    Unless it is the beginning of something longer: "the third" of "the third lane", where no "one" is said.
    """
    inside = (edge for at in range(outer.start + 1, outer.end) for edge in lattice.edges[at])
    if any(edge.end > outer.end and edge.sense.concept != GLUE for edge in inside):
        return
    for at in range(outer.start, outer.end):
        lattice.edges[at] = [
            edge
            for edge in lattice.edges[at]
            if edge.end > outer.end or (edge.start, edge.end) == (outer.start, outer.end)
        ]


def _beside_it(edge: Edge, lattice: Lattice, topic: Topic, side: str) -> Edge | Unclear | None:
    """A place seen from the thing spoken of last ("to its left"); without one it is the vehicle's."""
    start, end = edge.start, edge.end
    moved = any(each.end == end and each.sense.concept.startswith("shift.") for each in lattice.edges[start])
    if not topic.things or (moved and "v.shift" in lattice.concepts):
        return None
    lattice.edges[start] = [
        each
        for each in lattice.edges[start]
        if each.end != end or each.sense.concept not in ("place", "side")
    ]
    if len(topic.things) > 1:
        return Unclear(start, end)
    return Edge(start, end, Sense("place", {"side": side, "of": {"id": topic.things[0]}}))


def _goes_to(lattice: Lattice, at: int) -> bool:
    """Whether a destination follows: "put it back to that" is no undo."""
    return at < lattice.size and any(edge.concept == GOAL for edge in lattice.edges[at])


def _took_away(topic: Topic) -> bool:
    """Whether the last request took things off the road."""
    away = any(isinstance(action, _MOVED) for action in topic.changed)
    return away and bool(topic.changed_steps) and not topic.undone


def _pointed_at(topic: Topic) -> bool:
    """Whether the last request was about one thing that it did not name."""
    wheres = [getattr(action, "where", None) for action in topic.actions]
    pointed = any(where is not None and (where.nearest or where.id) for where in wheres)
    return pointed and bool(topic.steps) and not topic.undone


def _lane_before(lattice: Lattice, start: int, where: Where | None) -> str | int | None:
    """The lane spoken of last: in this sentence, or before it."""
    lane = where.lane if where is not None else None
    for edge in lattice.between(0, start):
        if (
            edge.sense.concept == "place"
            and isinstance(edge.sense.value, dict)
            and "lane" in edge.sense.value
        ):
            lane = edge.sense.value["lane"]
    return lane


def _pointed(edge: Edge, topic: Topic) -> Edge | Unclear | None:
    """What "that pothole", "those cars", "the last two cones" point at; None where at nothing said."""
    amount: Amount = edge.sense.value
    form = edge.sense.concept.partition(".")[2]
    spoken_of = topic.added if form.startswith("last") else topic.things
    ids = tuple(name for name in spoken_of if kind_of(name) == amount.of)
    if form.startswith("last"):
        count = int(amount.count or 1)
        if len(ids) < count or count < 1:
            return Unclear(edge.start, edge.end)
        return thing_edge(edge.start, edge.end, ids[-count:])
    if not ids:
        return None
    if form == "those" or len(ids) == 1:
        return thing_edge(edge.start, edge.end, ids)
    return Unclear(edge.start, edge.end, ids[-MAX_CANDIDATES:])
