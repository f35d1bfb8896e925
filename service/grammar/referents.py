"""Which of the things spoken of are meant: all of them, both, two of them, the next one, the others."""

from __future__ import annotations

from dataclasses import dataclass

from service.grammar.lattice import Edge
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import Amount
from service.grammar.topic import Topic
from sim.types import kind_of

BY_ID = "thing.id"
"""Concept of things that are known by their ids."""

MAX_CANDIDATES = 5
"""So many things are offered at most where it is not clear which one is meant."""


@dataclass(frozen=True, slots=True)
class Unclear:
    """A reference to one of several things, or (no candidates) to nothing that was spoken of."""

    start: int
    end: int
    candidates: tuple[str, ...] = ()
    lane: bool = False


def every_thing(start: int, end: int, topic: Topic) -> Edge | Unclear:
    """All of several things: those spoken of, or where that is one, all that were told or added with it."""
    there = tuple(name for name in topic.listed if name not in topic.gone)
    for things in (topic.things, there):
        if len(things) > 1:
            return thing_edge(start, end, things)
    return (
        several_things(start, end, topic, both=False)
        if not topic.listed
        else Unclear(start, end, topic.things)
    )


def several_things(start: int, end: int, topic: Topic, *, both: bool) -> Edge | Unclear:
    """The things a plural stands for where one was spoken of last: that one, and the one before it.

    "Both" are two things; of more, or of one alone, nothing is guessed.
    """
    last, before = topic.things, topic.before
    if len(last) == 2 or (not both and last and not before):
        return thing_edge(start, end, last)
    if len(last) == len(before) == 1:
        return thing_edge(start, end, (*before, *last))
    if not both and len(last) == 1 and kind_of(last[0]) == "pedestrian":
        return thing_edge(start, end, last)  # "them" of one person
    return Unclear(start, end, (*before, *last)[-MAX_CANDIDATES:])


def some_things(start: int, end: int, topic: Topic, number: int | str) -> Edge | None:
    """So many of the things spoken of ("two of them"), the latest of them.

    None where they are all of their kind: then the amount alone says it.
    """
    there = len(topic.things)
    count = max(1, there // 2) if isinstance(number, str) else number
    if not topic.others or not 0 < count <= there or there < 2:
        return None
    return thing_edge(start, end, topic.things[-count:])


def so_many_things(start: int, end: int, topic: Topic, number: int) -> Edge | Unclear:
    """All so many things that were spoken of ("all three"): by one request, or by all of them."""
    for things in (topic.things, (*topic.before, *topic.things), topic.added):
        if number > 1 and len(things) == number:
            return thing_edge(start, end, things)
    return Unclear(start, end)


def next_thing(start: int, end: int, topic: Topic) -> Edge | Unclear:
    """The thing after the one that was named last, in the order in which things were told."""
    places = [topic.listed.index(name) for name in topic.named if name in topic.listed]
    after = topic.listed[places[-1] + 1 :] if places else ()
    left = tuple(name for name in after if name not in topic.gone)
    return thing_edge(start, end, left[:1]) if left else Unclear(start, end)


def other_things(start: int, end: int, topic: Topic, *, one: bool) -> Edge | Unclear:
    """Those of what was told last that were not just spoken of."""
    there = tuple(name for name in topic.listed if name not in topic.gone)
    left = tuple(name for name in there if name not in topic.things)
    left = left or tuple(name for name in topic.before if name not in topic.things) or there
    if not left or (one and len(left) > 1):
        return Unclear(start, end, left[-MAX_CANDIDATES:])
    return thing_edge(start, end, left)


def thing_edge(start: int, end: int, ids: tuple[str, ...]) -> Edge:
    """The edge of words that stand for these things."""
    return Edge(start, end, Sense(BY_ID, Amount(kind_of(ids[-1]), len(ids), ids)))
