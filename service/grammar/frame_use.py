"""Finds what frames take and then drop: a concept whose value is in none of their actions, choices or places.

Such a word would be lost without anyone noticing. Concepts that say nothing more are declared once, as `free`
in `sets.yaml`; a frame that takes something all the same, because the request is the same with it, says so
itself, in `drops`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence, Set

from service.grammar.frames import Frame
from service.grammar.noun_phrases import NOUN, QUANTITY

_SLOT = re.compile(r"[${]([a-z_]+)")
_AMOUNT = frozenset(("number", "length", "speed", "seconds", "fraction", "times", "cells"))
_PARTS = frozenset(
    ("weather", "time_of_day", "road", "layout", "traffic", "planner", "sensor", "thing", "random")
)
_PLACE = frozenset(("place", "side", "nearest", "length", "cells"))
_PART = frozenset(("part_of", "fraction"))
_MADE_OF = {
    "where": _PLACE,
    "amount": _AMOUNT,
    "down_amount": _AMOUNT,
    "down_speed": frozenset(("speed",)),
    "share": _PART,
    "more_part": _PART,
    "less_part": _PART,
    "more_percent": _PART,
    "less_percent": _PART,
    "parts": _PARTS,
    "eval_scenario": _PARTS,
    "eval_vary": _PARTS,
    "planners": frozenset(("planner",)),
    "moves": frozenset(("dir", "dir_bare", "stay_word", "made_times")),
    "settings": frozenset(("weather", "time_of_day", "traffic", "planner", "sensor", "dynamics")),
    "asked_move": frozenset(("dir", "stay_word")),
    "one": frozenset(("thing",)),
    "many": frozenset(("thing",)),
    "noun": frozenset(("thing",)),
    "first": frozenset(("meant",)),
    "second": frozenset(("meant",)),
    "past": frozenset(("thing",)),
    "which": _PLACE | {"thing"},
    "which_thing": _PLACE | {"thing"},
    "steps_or_one": frozenset(("steps",)),
    "less": frozenset(("columns", "rows")),
}
"""What the slots of templates that are no concepts are made of (see `build`)."""


def dropped(frames: Sequence[Frame], free: Set[str]) -> Iterator[str]:
    """A sentence for each concept that a frame takes and drops."""
    for frame in frames:
        used = _used(frame)
        for concept in sorted(frame.takes - free - frame.drops - frozenset().union(*frame.needs)):
            if concept not in used and concept.partition(".")[0] not in used:
                yield f"frame {frame.name} takes {concept} and drops it"


def idle(frames: Sequence[Frame], free: Set[str]) -> frozenset[str]:
    """The concepts that no frame has a use for, wherever they are taken: words beside which say nothing more.

    They are fillers of some requests ("compare A* *with* Dijkstra"), as glue is one of all.
    """
    used: set[str] = set()
    taken: set[str] = set()
    for frame in frames:
        taken |= frame.accepted
        used |= frame.accepted - frame.drops | frozenset().union(*frame.needs)
    fillers = (each for each in taken - used if not each.startswith(NOUN) and each != QUANTITY)
    return frozenset(fillers) | free


def _used(frame: Frame) -> Set[str]:
    """The concepts whose values are in what a frame does."""
    template = json.dumps(frame.actions, default=dict)
    named = set(_SLOT.findall(template + "".join(frame.ask.choices if frame.ask else ())))
    named |= {concept.partition(".")[0] for concept in frame.per} | {*frame.per, *frame.agree}
    for name in tuple(named):
        named |= _MADE_OF.get(name, frozenset())
    return named
