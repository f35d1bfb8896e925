"""Resolves references to what was said before: "it", "those", "again", "the other lane".

A reference gets the edges of its referent, so frames treat "it" like "pothole-3". Nothing is guessed where
there are several candidates: they are returned, and asked about. "That pothole" is the nearest pothole where
none was spoken of; its frame says so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace

from service.actions import Undo, dump
from service.grammar.fragments import REPEATED
from service.grammar.last_request import steps_of_two, turned
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import Amount
from service.grammar.parse_types import Parse, Refused, Understood
from service.grammar.said_before import done_anew, take_back, take_back_change
from service.grammar.tokens import Token
from service.grammar.topic import Phrases, Topic
from sim.actions import Adjust, MoveThings, Remove, Replace, Set, Swap, Where
from sim.types import kind_of

REFERS = "refers"
"""Concept of words that refer; their value says how."""

BY_ID = "thing.id"
TAUGHT = "taught"
MAX_CANDIDATES = 5

_REFERRING = frozenset(
    (REFERS, "thing.that", "thing.those", "thing.the_one", "thing.last", "thing.last_counted")
)
_MOVED = (Remove, MoveThings, Replace, Swap, Set, Adjust)
"""Actions after which "put it back" is to undo them."""

_WHOLE = frozenset(("other", "others", "next", "both"))
"""References of several words that are small words of other requests by themselves."""

_OPPOSITE = {"left": "right", "right": "left"}


@dataclass(frozen=True, slots=True)
class Unclear:
    """A reference to one of several things, or (no candidates) to nothing that was spoken of."""

    start: int
    end: int
    candidates: tuple[str, ...] = ()
    lane: bool = False


def parse_in_topic(parse: Callable[[str, Topic], Parse], text: str, topic: Topic) -> Parse:
    """What a text means; a taught phrase counts only where the language has no meaning of its own for it.

    So "carry on" stays what it is when "carry" was taught.
    """
    if not topic.phrases.by_first:
        return parse(text, topic)
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
    words = [token.text for token in tokens]
    phrases = topic.phrases if topic.phrases.by_first else None
    for at, token in enumerate(tokens):
        if token.id:
            lattice.edges[at].append(_things(at, at + 1, (token.text,)))
        taught = None if phrases is None else phrases.at(words, at)
        if taught is not None:
            lattice.edges[at].append(Edge(at, taught[0], Sense(TAUGHT, taught[1])))


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
            return _things(start, end, topic.things)
        case "one":
            return Unclear(start, end, topic.things[-MAX_CANDIDATES:])
        case "all" if len(topic.things) > 1:
            return _things(start, end, topic.things)
        case "all" | "both" as which:
            return _several(start, end, topic, both=which == "both")
        case "person" if len(topic.things) == 1 and kind_of(topic.things[0]) == "pedestrian":
            return _things(start, end, topic.things)
        case "person":
            people = tuple(name for name in topic.things if kind_of(name) == "pedestrian")
            return Unclear(start, end, people[-MAX_CANDIDATES:])
        case "last" if topic.added:
            return _things(start, end, topic.added[-1:])
        case "again" if topic.undone:
            return Edge(start, end, Sense(REPEATED, [{"do": "redo"}]))
        case "again" if topic.actions:
            return Edge(start, end, Sense(REPEATED, dump(topic.actions)))
        case "there" if topic.where is not None:
            said = {key: part for key, part in asdict(topic.where).items() if part is not None}
            return Edge(start, end, Sense("place", said))
        case {"nth": int() as number} if 0 < number <= len(topic.listed):
            return _things(start, end, topic.listed[number - 1 : number])
        case "opposite" if (other := turned(topic)) is not None:
            return Edge(start, end, Sense(REPEATED, dump(done_anew(topic, other))))
        case "since" if topic.tick is not None:
            asked = [{"do": "ask", "about": "history", "what": "since", "tick": topic.tick}]
            return Edge(start, end, Sense(REPEATED, asked))
        case {"its": str() as side}:
            return _beside_it(edge, lattice, topic, side)
        case {"some": int() | "half" as number}:
            return _part(start, end, topic, number)
        case {"all": int() as number}:
            return _so_many(start, end, topic, number)
        case {"others": int() as number}:
            left = _others(start, end, topic, one=False)
            fits = isinstance(left, Edge) and len(left.sense.value.ids) == number
            return left if fits else Unclear(start, end)
        case "next":
            return _next(start, end, topic)
        case "other" | "others" as which:
            return _others(start, end, topic, one=which == "other")
        case "back" if _took_away(topic):
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


def _several(start: int, end: int, topic: Topic, *, both: bool) -> Edge | Unclear:
    """The things a plural stands for where one was spoken of last: that one, and the one before it.

    "Both" are two things; of more, or of one alone, nothing is guessed.
    """
    last, before = topic.things, topic.before
    if len(last) == 2 or (not both and last and not before):
        return _things(start, end, last)
    if len(last) == len(before) == 1:
        return _things(start, end, (*before, *last))
    if not both and len(last) == 1 and kind_of(last[0]) == "pedestrian":
        return _things(start, end, last)  # "them" of one person
    return Unclear(start, end, (*before, *last)[-MAX_CANDIDATES:])


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


def _next(start: int, end: int, topic: Topic) -> Edge | Unclear:
    """The thing after the one that was named last, in the order in which things were told."""
    places = [topic.listed.index(name) for name in topic.named if name in topic.listed]
    after = topic.listed[places[-1] + 1 :] if places else ()
    left = tuple(name for name in after if name not in topic.gone)
    return _things(start, end, left[:1]) if left else Unclear(start, end)


def _others(start: int, end: int, topic: Topic, *, one: bool) -> Edge | Unclear:
    """Those of what was told last that were not just spoken of."""
    there = tuple(name for name in topic.listed if name not in topic.gone)
    left = tuple(name for name in there if name not in topic.things)
    left = left or tuple(name for name in topic.before if name not in topic.things) or there
    if not left or (one and len(left) > 1):
        return Unclear(start, end, left[-MAX_CANDIDATES:])
    return _things(start, end, left)


def _part(start: int, end: int, topic: Topic, number: int | str) -> Edge | None:
    """So many of the things spoken of ("two of them"), the latest of them.

    None where they are all of their kind: then the amount alone says it.
    """
    there = len(topic.things)
    count = max(1, there // 2) if isinstance(number, str) else number
    if not topic.others or not 0 < count <= there or there < 2:
        return None
    return _things(start, end, topic.things[-count:])


def _so_many(start: int, end: int, topic: Topic, number: int) -> Edge | Unclear:
    """All so many things that were spoken of ("all three"): by one request, or by all of them."""
    for things in (topic.things, (*topic.before, *topic.things), topic.added):
        if number > 1 and len(things) == number:
            return _things(start, end, things)
    return Unclear(start, end)


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
        return _things(edge.start, edge.end, ids[-count:])
    if not ids:
        return None
    if form == "those" or len(ids) == 1:
        return _things(edge.start, edge.end, ids)
    return Unclear(edge.start, edge.end, ids[-MAX_CANDIDATES:])


def _things(start: int, end: int, ids: tuple[str, ...]) -> Edge:
    return Edge(start, end, Sense(BY_ID, Amount(kind_of(ids[-1]), len(ids), ids)))
