"""Finds the smallest stretch of a refused sentence without which the rest of it is a whole sentence.

It is what a refusal names: of "put three cones on the moon" it is "on the moon", though "moon" alone is
unknown. The rest is only offered as something that can be said; it is never done.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from service.actions import Action
from service.grammar.fragments import Fragment, fragments
from service.grammar.lattice import Lattice
from service.grammar.lexicon import SECOND
from service.grammar.parse_types import Parse, Understood
from service.grammar.tokens import Token
from service.grammar.work_budget import BudgetExceededError, WorkBudget

MOST_READINGS = 18
"""How many shorter sentences are read in search of the stretch."""

MOST_STEPS = 2_000
"""What all of them may cost, whatever the sentence itself has cost."""

MOST_PARTS = 3
"""In how many parts of a sentence something may be wrong."""

_MARKS = ",.;:?!"
"""Marks before which no space stands."""

Span: TypeAlias = tuple[int, int]
"""Tokens `[start, end)`."""

Read: TypeAlias = Callable[[str, WorkBudget], Parse]
"""Reads a sentence, at the cost of some work."""


@dataclass(frozen=True, slots=True)
class Gap:
    """The stretches that were not understood, and the rest: a sentence, and what it does."""

    spans: tuple[Span, ...]
    rest: str
    actions: tuple[Action, ...]
    whole: bool = True
    """whether what is left of each part is more than a word: "go" is not what "go to sleep" is about"""


class GapFinder:
    """The search in one sentence."""

    def __init__(
        self,
        plain: str,
        tokens: Sequence[Token],
        lattice: Lattice,
        read: Read,
        is_link: Callable[[str], bool],
    ) -> None:
        """`plain`: the text of the tokens; `is_link`: whether a word leads to others."""
        self._plain = plain
        self._tokens = tokens
        self._lattice = lattice
        self._parts = fragments(lattice, 0, lattice.size)
        self._read = read
        self._is_link = is_link
        self._work = WorkBudget(MOST_STEPS)
        self._readings = MOST_READINGS

    def find(self, unknown: Sequence[int], failed: Fragment | None) -> Gap | None:
        """The gap: one stretch in each part that holds unknown tokens, or in the one that failed.

        None where nothing that is left makes a sentence, or too much would have to be tried.
        """
        inside = [(part, [at for at in unknown if part.start <= at < part.end]) for part in self._parts]
        troubled = [(part, held) for part, held in inside if held or part == failed]
        lost = len(unknown) - sum(len(held) for _, held in troubled)
        if not troubled or lost or len(troubled) > MOST_PARTS:
            return None
        found: list[Span] = []
        last: Gap | None = None
        try:
            for at, (part, held) in enumerate(troubled):
                others = [*found, *((later.start, later.end) for later, _ in troubled[at + 1 :])]
                last = self._smallest(part, held, others)
                if last is None:
                    return None
                found += last.spans
        except BudgetExceededError:
            return None
        whole = all(_stays_whole(part, span) for (part, _), span in zip(troubled, found, strict=True))
        return last and Gap(tuple(found), last.rest, last.actions, whole)

    def _smallest(self, part: Fragment, unknown: Sequence[int], others: Sequence[Span]) -> Gap | None:
        """The smallest stretch of a part, and what is left without it and the others."""
        for span in _by_size(part, unknown):
            if span[1] < part.end and self._is_link(self._tokens[span[1] - 1].text):
                continue  # what it leads to would stay: "in lanes 2 to" of "in lanes 2 to 4"
            gap = self._without_span(span, others)
            if gap is not None:
                return self._with_links(part, gap, others)
        return None

    def _without_span(self, span: Span, others: Sequence[Span]) -> Gap | None:
        rest = self._without([*others, span])
        if not rest or self._readings == 0:
            return None
        self._readings -= 1
        parsed = self._read(rest, self._work)
        return Gap((span,), rest, parsed.actions) if isinstance(parsed, Understood) else None

    def _with_links(self, part: Fragment, gap: Gap, others: Sequence[Span]) -> Gap:
        """The stretch at the end of a part with the words that led to it: "on the" of "on the moon"."""
        start, end = gap.spans[0]
        if all(self._is_link(token.text) for token in self._tokens[end : part.end]):
            gap = self._longer((start, part.end), gap, others) or gap
            start, end = gap.spans[0]
        if not self._closes(end, part.end):
            return gap
        while start > part.start + 1 and self._is_link(self._tokens[start - 1].text):
            start -= 1
            longer = self._longer((start, end), gap, others)
            if longer is None:
                break
            gap = longer
        return gap

    def _longer(self, span: Span, gap: Gap, others: Sequence[Span]) -> Gap | None:
        """The gap with this stretch instead of its own, where the rest means the same."""
        longer = self._without_span(span, others)
        return longer if longer is not None and longer.actions == gap.actions else None

    def _closes(self, at: int, end: int) -> bool:
        """Whether nothing comes any more but the second half of a phrase: "add … to it"."""
        while at < end:
            halves = [edge.end for edge in self._lattice.edges[at] if edge.concept == SECOND]
            if not halves:
                return False
            at = max(halves)
        return True

    def _without(self, spans: Sequence[Span]) -> str:
        """The text without some stretches; where one is a whole part, without what joins it on."""
        cut = [False] * len(self._tokens)
        for span in spans:
            start, end = self._with_joint(*span)
            cut[start:end] = [True] * (end - start)
        kept: list[str] = []
        at = 0
        while at < len(cut):
            first = at
            while at < len(cut) and not cut[at]:
                at += 1
            if at > first:
                kept.append(self._plain[self._tokens[first].start : self._tokens[at - 1].end])
            at += 1
        text = "".join(each if each[0] in _MARKS else f" {each}" for each in kept)
        return text.strip()

    def _with_joint(self, start: int, end: int) -> Span:
        for at, part in enumerate(self._parts):
            if (part.start, part.end) == (start, end):
                if at:
                    return self._parts[at - 1].end, end
                return start, self._parts[at + 1].start if len(self._parts) > 1 else end
        return start, end


def _stays_whole(part: Fragment, span: Span) -> bool:
    left = part.end - part.start - (span[1] - span[0])
    return left != 1


def _by_size(part: Fragment, unknown: Sequence[int]) -> Iterator[Span]:
    """The stretches of a part that hold its unknown tokens, smallest first; at last all of it.

    What stays of the part is at least half as long as what goes.
    """
    first, last = (min(unknown), max(unknown) + 1) if unknown else (part.end, part.start)
    length = part.end - part.start
    for size in range(max(1, last - first), 2 * length // 3 + 1):
        for start in range(max(part.start, last - size), min(first, part.end - size) + 1):
            yield start, start + size
    yield part.start, part.end
