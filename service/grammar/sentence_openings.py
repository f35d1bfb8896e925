"""Where what-if questions and taught phrases begin in a text, for all its tokens at once.

One pass from the end finds what each token is followed by, so the cost grows with the number of edges alone.
"""

from __future__ import annotations

from service.grammar.lattice import GLUE, Lattice
from service.grammar.paths import SEPARATOR

WHAT_IF = "what_if"
IF = "if"
THEN_WHAT = "then_what"
TEACH = "teach"
SENTENCE = "sentence"
"""Value of words for "if" that are so only where a sentence begins: "with 5 potholes, what would you do?"."""

WITHOUT = "without"
"""Value of words for "if" that belong to what is supposed: "without the car, what would you do?"."""

_OPENERS = frozenset((WHAT_IF, IF, TEACH))
_PASSED = (GLUE, SEPARATOR)


class Beginnings:
    """What begins at the tokens of `[start, end)`."""

    def __init__(self, lattice: Lattice, start: int, end: int) -> None:
        self._at: list[frozenset[str]] = [frozenset()] * (end + 1)
        """The openers and questions that begin at each token."""
        self._only_sentences: set[int] = set()
        """The tokens of those that open something only where a sentence begins."""
        self._past = [end] * (end + 1)
        """The first token from each that is neither glue nor a separator, or that opens something."""
        past_all = [end] * (end + 1)
        asked: list[tuple[int, int]] = []
        for at in range(end - 1, start - 1, -1):
            here = lattice.edges[at]
            of = {edge[2][0] for edge in here}
            self._at[at] = frozenset(of & {WHAT_IF, IF, THEN_WHAT, TEACH})
            if IF in of and all(edge.sense.value == SENTENCE for edge in here if edge[2][0] == IF):
                self._only_sentences.add(at)
            passed = max((edge[1] for edge in here if edge[2][0] in _PASSED), default=at)
            past_all[at] = past_all[min(passed, end)] if passed > at else at
            opens = not of.isdisjoint(_OPENERS)
            if THEN_WHAT in of:
                stop = max(edge[1] for edge in here if edge[2][0] == THEN_WHAT)
                asked.append((at, stop))
                opens = opens or (stop < end and IF in self._at[past_all[stop]])
            self._past[at] = self._past[min(passed, end)] if passed > at and not opens else at
        self._end = end
        parts = [
            at for at, stop in asked if stop >= end or past_all[stop] >= end or _separates(lattice, stop)
        ]
        self._last_asked = max(parts, default=-1)
        self._asks_if = {at for at, stop in asked if stop < end and IF in self._at[past_all[stop]]}

    def teaches(self, at: int) -> bool:
        """Whether words that teach a phrase begin at a token."""
        return TEACH in self._at[self._past[min(at, self._end)]]

    def asks(self, at: int, *, begins_sentence: bool = True) -> bool:
        """Whether a what-if question begins at a token, where a sentence begins or within one."""
        at = self._past[min(at, self._end)]
        if at in self._only_sentences and not begins_sentence:
            return False
        if WHAT_IF in self._at[at] or at in self._asks_if:
            return True
        return IF in self._at[at] and self._last_asked > at


def _separates(lattice: Lattice, at: int) -> bool:
    return any(edge.concept == SEPARATOR for edge in lattice.edges[at])
