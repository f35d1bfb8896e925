"""Reads two requests of which one is told from the other in time: "after adding two cars, pause".

It is not sure that both shall be done: "save it before you reset" may be said to someone who is about
to reset. So what is found is asked about, and what is no request ("before the next crash") is none here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from service.grammar.clause import Clause, Divided
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.paths import SEPARATOR

TIME = "time_clause"
"""Concept of the words that begin such a part; their value says which is done first, and what may follow."""

AFTER = ("after", "after_doing")
"""Those of words whose part comes first: "after adding two cars"."""

DOING = ("before_doing", "after_doing")
"""Those of words that name nobody who does it: only a verb in one of the forms may follow."""

FORMS = frozenset(("ing", "past"))
"""Forms of verbs in such a part."""

MAX_CUTS = 8
"""Places where an opening part may end that are tried."""

_QUESTION = "ask"

Divide = Callable[[int, int, frozenset[str]], Divided]


def read_in_time(lattice: Lattice, divide: Divide) -> list[list[Clause]]:
    """Both requests in their order, and the one alone; nothing where there are no two."""
    if TIME not in lattice.concepts:
        return []
    marks = sorted((e for e in lattice.all() if e.concept == TIME), key=lambda e: (e.start, -e.end))
    for mark in marks:
        for told, main in _parts(lattice, mark):
            other, own = _requests(divide(*told, FORMS)), _requests(divide(*main, frozenset()))
            if other and own and (mark.sense.value not in DOING or _is_doing(other[0])):
                both: list[Clause] = [*other, *own] if mark.sense.value in AFTER else [*own, *other]
                return [both, list(own)]
    return []


def _parts(lattice: Lattice, mark: Edge) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """Where the part may be that the mark begins, and where the other."""
    size = lattice.size
    if mark.end >= size:
        return
    if any(all(edge.concept != GLUE for edge in starting) for starting in lattice.edges[: mark.start]):
        yield (mark.end, size), (0, mark.start)
        return
    pauses = [e for e in lattice.between(mark.end + 1, size) if e.concept == SEPARATOR and e.end < size]
    cuts = [(edge.start, edge.end) for edge in pauses] or [(at, at) for at in range(mark.end + 1, size)]
    for end, begin in cuts[-MAX_CUTS:]:
        yield (mark.end, end), (begin, size)


def _is_doing(clause: Clause) -> bool:
    """Whether its verb is in one of the forms."""
    return any(edge.sense.form in FORMS for edge in clause.filled.slots)


def _requests(divided: Divided) -> Sequence[Clause]:
    """The clauses of a part that is nothing but requests, else none."""
    clauses = divided.clauses
    sure = divided.failed is None and all(
        clause.actions and not clause.instead and clause.filled.frame.ask is None for clause in clauses
    )
    asks = any(action["do"] == _QUESTION for clause in clauses for action in clause.actions)
    return clauses if sure and not asks else ()
