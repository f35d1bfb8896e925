"""Cuts a sentence into fragments at "and", "then" and marks; leaves off calls ("hey, …") and tags ("…, ok?").

What the fragments mean is for `clauses`.
"""

from __future__ import annotations

from dataclasses import dataclass

from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import COLON
from service.grammar.paths import SEPARATOR

PAUSE = "pause"
STOP = "stop"
THEN = "then"
OR = "or"
AND = "and"
BEGINS_NEGATION = "negation.begins"
"""Concept of words that begin a negated part without a separator before them: "nor". Those whose value is not
`always` do so before a verb, or with a noun: "without adding", "without any cones"."""
_ALWAYS = "always"
_VERB = "v."
EXCEPT = "except"
"""After this comes where something shall not be: "anywhere but the left lane"."""
BUT = "but"
"""After this a part says for itself what to do: "remove all but two cars" leans on nothing."""

_MARKS = frozenset({"pause", STOP})
"""Separators that are punctuation."""

DIRECTION = "dir"
"""Concept of the ways to go."""
INTERJECTION = "interjection"
TAG = "tag"
REPEATED = "repeated"
"""What was done before, said again: "again"."""
DROP = "drop"
"""What drops a question: its words may say nothing one by one."""
_WHOLE_REQUESTS = (REPEATED, DROP)
"""Phrases that are requests though their words may be glue."""


@dataclass(frozen=True, slots=True)
class Fragment:
    """Tokens `[start, end)` between two separators, and the separator before them."""

    after: str
    start: int
    end: int


def fragments(lattice: Lattice, start: int, end: int) -> list[Fragment]:
    """Tokens `[start, end)` cut at separators; parts with nothing but glue are dropped."""
    found: list[Fragment] = []
    start, end = _past_interjection(lattice, start, end), _before_tag(lattice, start, end)
    after, begin, at, inside = "pause", start, start, start
    cut_at = {SEPARATOR, BEGINS_NEGATION, COLON} & lattice.concepts
    while at < end and cut_at:
        separator: Edge | None = None
        reach = inside
        for edge in lattice.edges[at]:
            stop, concept = edge[1], edge[2][0]
            if stop > end or concept == INTERJECTION:
                continue
            if concept != SEPARATOR:
                if stop - at > 1 and at > begin and _passes_on(lattice, stop, end):
                    continue
                reach = max(reach, stop)
            elif separator is None or stop > separator.end:
                separator = edge
        if separator is None and (mark := _before_last_verb(lattice, at, end)) is not None:
            separator = mark
        if separator is not None and inside <= at:
            if _says_something(lattice, begin, at):
                found.append(Fragment(after, begin, at))
                after = str(separator.sense.value)
            elif str(separator.sense.value) not in _MARKS and after != OR:
                after = str(separator.sense.value)
            begin = separator.end
            if separator.sense.value == STOP:
                begin = _past_interjection(lattice, begin, end)
            at = inside = begin
            continue
        if (
            at > begin
            and inside <= at
            and _begins_negation(lattice, at)
            and _says_something(lattice, begin, at)
        ):
            found.append(Fragment(after, begin, at))
            after, begin = AND, at
        inside = reach
        at += 1
    if _says_something(lattice, begin, end) or (after == OR and begin < end and found):
        found.append(Fragment(after, begin, end))  # "five or so": how many was meant is not known
    return found


def _before_last_verb(lattice: Lattice, at: int, end: int) -> Edge | None:
    """A colon before a verb that ends the sentence, as a comma: "rainy city, 3 buses: simulate that"."""
    for mark in lattice.edges[at]:
        if mark.concept == COLON and mark.end < end and at:
            for verb in lattice.edges[mark.end]:
                if verb.concept.startswith(_VERB) and not _says_something(lattice, verb.end, end):
                    return mark._replace(sense=Sense(SEPARATOR, PAUSE))
    return None


def _begins_negation(lattice: Lattice, at: int) -> bool:
    """Whether a negated part begins at a token: "turn neither left | nor right"."""
    for word in lattice.edges[at]:
        if word.concept != BEGINS_NEGATION:
            continue
        after = lattice.edges[word.end] if word.end < lattice.size else []
        if word.sense.value == _ALWAYS or any(edge.sense.form == "ing" for edge in after):
            return True
        return any(edge.concept == "thing.none" for edge in lattice.edges[at])
    return False


def _passes_on(lattice: Lattice, stop: int, end: int) -> bool:
    """Whether a phrase is cut at its last word: "take that back then turn left", not "now then, …"."""
    then = any(
        e.end == stop and e.concept == SEPARATOR and e.sense.value == THEN for e in lattice.edges[stop - 1]
    )
    return then and _says_something(lattice, stop, end, marks=True)


def _past_interjection(lattice: Lattice, start: int, end: int) -> int:
    """Past a first part that only calls for attention: "right, …", "no, …", "car, …"."""
    if INTERJECTION not in lattice.concepts:
        return start
    longest = max((edge.end for edge in lattice.edges[start]), default=start) if start < end else start
    for edge in lattice.edges[start] if start < end else ():
        if edge.end == longest and edge.sense.concept == INTERJECTION and edge.end < end:
            marks = [
                e
                for e in lattice.edges[edge.end]
                if (e.sense.concept == SEPARATOR and (e.sense.value in _MARKS or e.sense.value == BUT))
                or (e.sense.concept == COLON and e.end == e.start + 1)
            ]
            if (
                marks
                and not _lists_ways(lattice, edge, marks[0].end)
                and _says_something(lattice, marks[0].end, end)
            ):
                return max(mark.end for mark in marks)
    return start


def _lists_ways(lattice: Lattice, call: Edge, at: int) -> bool:
    """Whether a call is the first of several ways to go: "right, left, right", but "right, go on"."""
    ways = [edge.end for edge in lattice.edges[call.start] if edge.concept == DIRECTION]
    if call.end not in ways or at >= lattice.size:
        return False
    then = [e.end for e in lattice.edges[call.end] if e.concept == SEPARATOR and e.sense.value == THEN]
    at = max(then, default=at)
    here = lattice.edges[at] if at < lattice.size else []
    after = {edge.end for edge in here if edge.concept == DIRECTION}
    return any(
        bool(then) if end == lattice.size else any(e.concept == SEPARATOR for e in lattice.edges[end])
        for end in after
    )


def _before_tag(lattice: Lattice, start: int, end: int) -> int:
    """Before a last part that only asks for consent: "…, won't you?"."""
    if TAG not in lattice.concepts:
        return end
    for edge in lattice.between(start, end):
        if (
            edge.sense.concept == TAG
            and edge.start > start
            and not _says_something(lattice, edge.end, end, marks=True)
        ):
            return edge.start
    return end


def _says_something(lattice: Lattice, start: int, end: int, *, marks: bool = False) -> bool:
    """Whether the tokens are not all glue; with `marks`, or punctuation."""
    at = start
    while at < end:
        passed = 0
        for _, stop, (concept, _, form), _ in lattice.edges[at]:
            if stop > end:
                continue
            if concept in _WHOLE_REQUESTS:
                return True
            if stop > passed and ((concept == GLUE and not form) or (marks and concept == SEPARATOR)):
                passed = stop
        if not passed:
            return True
        at = passed
    return False
