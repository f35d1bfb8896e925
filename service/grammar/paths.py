"""Fills a frame: a path of edges over a stretch of tokens, each edge with a place in the frame.

The path must cover every token; edges may be glue, concepts the frame takes, or its needs, all of which
must be met. Long edges are tried first, so the reading with the fewest pieces is found first. The search
is bounded: a frame that does not fit within the bound does not fit.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from service.grammar.frames import Filled, Frame
from service.grammar.lattice import GLUE, Edge
from service.grammar.lexicon import SECOND
from service.grammar.work_budget import WorkBudget

ALLOWS = "allows"
"""Concept of phrases that put a form in place: "would you mind" allows `ing`."""
LATER = "_later"
"""Ending of a form that such a phrase allows farther on, and not right after itself."""

SPEAKER = "speaker"
"""Concept of phrases that make the speaker the doer; glue, where a frame does not say otherwise."""

SEPARATOR = "separator"
NEGATION = "negation"
MAX_STEPS = 600

_LOOSE = frozenset((GLUE, ALLOWS, SECOND, SPEAKER, SEPARATOR, NEGATION))
"""What a frame may have no use for."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """Tokens `[start, end)` to be read: their edges by start, forms in place, what is already said."""

    start: int
    end: int
    edges: Mapping[int, Sequence[Edge]]
    concepts: frozenset[str]
    forms: frozenset[str] = frozenset()
    moods: frozenset[str] = frozenset()
    given: tuple[Edge, ...] = ()
    joined: bool = False
    negated: bool = False
    lenient: bool = False
    """Whether any frame that fits will do: nothing will be done anyway."""
    work: WorkBudget = field(default_factory=WorkBudget)
    """What the searches are paid from."""
    longest: int = sys.maxsize
    """No edge has more tokens."""


@dataclass(slots=True)
class _Search:
    """One search for a path; `steps` counts what it has cost."""

    frame: Frame
    stretch: Stretch
    usable: dict[int, list[tuple[Edge, bool]]]
    steps: int = 0
    slots: list[Edge] = field(default_factory=list)
    parts: list[Edge] = field(default_factory=list)
    glue: list[Edge] = field(default_factory=list)


def fill(frame: Frame, stretch: Stretch) -> tuple[Filled, int] | None:
    """The frame filled by the whole stretch, and the number of pieces; None when it does not fit."""
    usable = _usable(frame, stretch)
    if usable is None:
        return None
    search = _Search(frame, stretch, usable)
    search.slots.extend(stretch.given)
    open_needs = list(frame.needs)
    used: set[str] = set()
    for edge in stretch.given:
        need = next((group for group in open_needs if edge.sense.concept in group), None)
        if need is not None:
            open_needs.remove(need)
        elif edge.sense.concept not in frame.accepted or (
            edge.sense.concept in used and edge.sense.concept not in frame.many
        ):
            return None
        used.add(edge.sense.concept)
    pieces = _walk(search, stretch.start, open_needs, used, 0)
    stretch.work.spend(search.steps)
    return None if pieces is None else (Filled(frame, search.slots), pieces)


def _usable(frame: Frame, stretch: Stretch) -> dict[int, list[tuple[Edge, bool]]] | None:
    """By start, the edges on some path to the end, longest first, and whether each fills a slot."""
    forms = stretch.forms | frame.forms
    accepted = frame.accepted
    reachable = {stretch.end}
    usable: dict[int, list[tuple[Edge, bool]]] = {}
    nearest, longest = stretch.end, stretch.longest
    for at in range(stretch.end - 1, stretch.start - 1, -1):
        if nearest - at > longest:
            break  # nothing before it reaches over the gap
        here: list[tuple[Edge, bool]] = []
        for edge in stretch.edges.get(at, ()):
            _, end, (concept, _, form), _ = edge
            if end not in reachable:
                continue
            if concept in accepted and (not form or form in forms):
                here.append((edge, True))
            elif concept in _LOOSE and (
                (concept == GLUE and (not form or form in forms))
                or concept in (ALLOWS, SECOND)
                or (concept == SPEAKER and frame.speaker)
                or (stretch.joined and concept == SEPARATOR)
                or (stretch.negated and concept == NEGATION)
            ):
                here.append((edge, False))
        if here:
            if len(here) > 1:
                here.sort(key=lambda pair: (-pair[0].end, not pair[1]))
            usable[at] = here
            reachable.add(at)
            nearest = at
    stretch.work.spend(stretch.end - nearest + 1)
    return usable if stretch.start in reachable else None


def _walk(search: _Search, at: int, needs: list[frozenset[str]], used: set[str], pieces: int) -> int | None:
    """The number of pieces of the first path from `at` to the end that meets all needs, else None."""
    frame = search.frame
    if at == search.stretch.end:
        search.stretch.work.spend(1)
        complete = (
            not needs
            and _parts_match(search.slots, search.parts)
            and (frame.only_negated or _agrees(frame, used))
            and _forms_in_place(search)
        )
        return pieces if complete else None
    search.steps += 1
    if search.steps > MAX_STEPS:
        return None
    for edge, fills in search.usable.get(at, ()):
        if not fills:
            if edge.part:
                if all(slot.part != edge.part for slot in search.slots):
                    continue  # the first half of it is no part of this path
                search.parts.append(edge)
            search.glue.append(edge)
            done = _walk(search, edge.end, needs, used, pieces + 1)
            if done is not None:
                return done
            search.glue.pop()
            if edge.part:
                search.parts.pop()
            continue
        concept = edge.sense.concept
        meets = next((group for group in needs if concept in group), None)
        if meets is None and concept in used and concept not in frame.many:
            continue
        rest = needs if meets is None else [group for group in needs if group is not meets]
        search.slots.append(edge)
        done = _walk(search, edge.end, rest, used | {concept}, pieces + 1)
        if done is not None:
            return done
        search.slots.pop()
    return None


def _forms_in_place(search: _Search) -> bool:
    """Whether each form used is put in place by a phrase on the path, and each such phrase is needed."""
    free = search.frame.forms | search.stretch.moods
    used = {edge.sense.form for edge in search.slots if edge.sense.form} - free
    only_for = {
        str(edge.sense.value).removesuffix(LATER) for edge in search.glue if edge.sense.concept == ALLOWS
    }
    said = {edge.sense.form for edge in search.slots}
    if not only_for <= said:
        return False
    if not used:
        return True
    spans = {(edge.start, edge.end) for edge in (*search.glue, *search.slots)}
    begins = {
        start for start, starting in search.stretch.edges.items() if any(e.sense.form for e in starting)
    }
    allowed = {
        value.removesuffix(LATER)
        for starting in search.stretch.edges.values()
        for edge in starting
        if edge.sense.concept == ALLOWS and (edge.start, edge.end) in spans
        for value in (str(edge.sense.value),)
        if not (value.endswith(LATER) and edge.end in begins)
    }
    return used <= allowed


def _agrees(frame: Frame, used: set[str]) -> bool:
    """Whether each concept that must not stand alone has its partner: "weather" needs a weather."""
    return all(frame.agree.get(concept, concept) in used for concept in used)


def _parts_match(slots: Sequence[Edge], seconds: Sequence[Edge]) -> bool:
    """Whether each first half of a split phrase has its second half after it, and the reverse."""
    firsts = [edge for edge in slots if edge.part]
    return sorted(edge.part for edge in firsts) == sorted(edge.part for edge in seconds) and all(
        any(second.part == first.part and second.start >= first.end for second in seconds) for first in firsts
    )
