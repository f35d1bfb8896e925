"""Fragments → clauses: where one request ends and the next begins, and what is carried over.

A sentence is cut at its separators ("and", "then", commas). A fragment is a clause when a frame fits it; it
may also lean on the clause before it ("add two cones and a bus in lane 5"), or belong together
with the fragments after it when a frame says that its parts may be listed ("highway, night, 10
potholes"). Negated fragments are understood and then left out.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

from service.grammar.fragments import BUT, EXCEPT, OR, STOP, Fragment
from service.grammar.frames import Filled
from service.grammar.lattice import NUMBER, Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import QUANTITY, Amount, understood_nouns
from service.grammar.paths import ALLOWS, NEGATION, Stretch
from service.grammar.work_budget import WorkBudget

MAX_JOINED = 16
"""How many fragments one listing clause may have."""

_LENIENT = ("counted", "the_many", "bare_many")
_TOGETHER = frozenset({"pause", "stop", "and", "but"})
"""Separators inside a listing clause; any other ends it."""
_WHOLE = (".all", ".the_many", ".bare_many", ".those")
"""Amounts that hold again in another place: "the cones in lane 3 and in lane 5"."""

_FURTHER = ("more", "another")
_PLACED = ("place", "side", "length")
_PAUSE = "pause"

_NEGATED = frozenset({"ing", "negated"})
"""Forms in place in a negated part: "don't go adding anything"."""

CONTRAST = "contrast"
EVERYTHING = "everything"


@dataclass(frozen=True, slots=True)
class Clause:
    """A request found in tokens `[start, end)`; no actions when it is negated."""

    start: int
    end: int
    filled: Filled
    actions: list[dict[str, Any]]
    negated: bool = False
    after: str = "pause"
    """the separator before it"""
    leans: bool = False
    """whether it leans on what was said before this sentence"""

    @property
    def supposes(self) -> str | None:
        """What it takes for granted beyond its actions."""
        return self.filled.frame.supposes


@dataclass(frozen=True, slots=True)
class Context:
    """What a clause hands on to the next: its verb, and the thing it was about."""

    verb: tuple[Edge, ...] = ()
    noun: Edge | None = None
    verbless: bool = True
    negated: bool = False
    everything: bool = False
    distant: bool = False
    """Whether it comes from an earlier sentence: then only "two more" and the like may lean on it."""
    placed: bool = False
    """Whether it ended with a place: a number alone after it may be of more things, or of another place."""


@dataclass(slots=True)
class Divided:
    """The clauses found; `failed` is the first fragment that nothing fits, if any."""

    clauses: list[Clause] = field(default_factory=list)
    failed: Fragment | None = None


class Matcher(Protocol):
    """What finds the frame for a stretch of tokens."""

    def match(
        self, stretch: Stretch, *, verbless: bool | None = None
    ) -> tuple[Filled, list[dict[str, Any]]] | None:
        """The best frame, filled, and its actions; None when none fits or two fit equally well."""


class Divider:
    """Divides the fragments of one sentence into clauses."""

    def __init__(
        self, matcher: Matcher, lattice: Lattice, vague: int, moods: frozenset[str], work: WorkBudget
    ) -> None:
        self._matcher = matcher
        self._lattice = lattice
        self._vague = vague
        self._moods = moods
        self._work = work
        self._starting = [_start(starting) for starting in lattice.edges]

    def divide(self, parts: Sequence[Fragment], kind: str | None = None) -> Divided:
        """The clauses of the fragments, or those up to the first that nothing fits.

        `kind` is what an amount without a noun may be of in the first of them: "two more".
        """
        divided = Divided()
        context = Context()
        if kind is not None:
            spoken = Edge(0, 0, Sense("thing.counted", Amount(kind, None)))
            context = Context(noun=spoken, distant=True)
        at = 0
        while at < len(parts):
            clause, used = self._join(parts, at, context)
            if clause is None:
                clause, used = self._single(parts[at], context), 1
            if clause is None:
                divided.failed = parts[at]
                return divided
            divided.clauses.append(replace(clause, after=parts[at].after))
            context = _context(clause, context)
            at += used
        return divided

    def _join(self, parts: Sequence[Fragment], at: int, context: Context) -> tuple[Clause | None, int]:
        """The longest listing clause that starts here, of two fragments or more."""
        last = at + 1
        while last < min(len(parts), at + MAX_JOINED) and parts[last].after in _TOGETHER:
            last += 1
        if parts[at].after == OR:
            return None, 0
        for end in range(last, at + 1, -1):
            start, stop = parts[at].start, parts[end - 1].end
            stretch = self._stretch(start, stop, joined=True)
            found = self._matcher.match(stretch, verbless=None if context.verbless else False)
            if found is not None and not self._each_whole(parts[at:end]):
                return Clause(start, stop, *found), end - at
            if found is None and context.verb and not context.negated:
                leaning = self._matcher.match(
                    self._stretch(start, stop, context, joined=True), verbless=False
                )
                if leaning is not None:
                    return Clause(start, stop, *leaning), end - at
        return None, 0

    def _each_whole(self, parts: Sequence[Fragment]) -> bool:
        """Whether each sentence in it is a request by itself: then they are several."""
        begins = [0, *(at for at, part in enumerate(parts) if at and part.after == STOP)]
        if len(begins) == 1:
            return False
        whole = (parts[a:b] for a, b in zip(begins, [*begins[1:], len(parts)], strict=True))
        stretches = (self._stretch(s[0].start, s[-1].end, joined=len(s) > 1) for s in whole)
        return all(self._matcher.match(stretch, verbless=False) is not None for stretch in stretches)

    def _single(self, part: Fragment, context: Context) -> Clause | None:
        """One fragment as a clause: by itself, leaning on the clause before, or without a verb."""
        if part.after == EXCEPT or (part.after == OR and not context.negated):
            return None
        start, end = part.start, part.end
        if context.negated and context.verb and self._contrasts(part):
            instead = replace(context, negated=False)
            found = self._matcher.match(self._stretch(start, end, instead), verbless=False)
            if found is not None:
                return Clause(start, end, *found)
        plain = self._stretch(start, end)
        found = self._matcher.match(plain, verbless=False)
        if found is not None:
            return Clause(start, end, *found, negated=found[0].frame.leaves_out)
        if NEGATION in plain.concepts:
            return self._negate(part, context)
        if part.after == BUT or (context.verb and self._says_again(part)):
            return None
        if context.placed and self._only_number(start, end):
            return None
        if context.verb:
            leaning = self._stretch(start, end, context)
            found = self._matcher.match(leaning, verbless=False)
            if found is None and context.noun is not None and context.noun.concept.endswith(_WHOLE):
                again = Context((*context.verb, context.noun), None, negated=context.negated)
                found = self._matcher.match(self._stretch(start, end, again), verbless=False)
            if found is not None:
                return Clause(start, end, found[0], [] if context.negated else found[1], context.negated)
        if context.verbless and not (context.negated and (context.verb or part.after == OR)):
            found = self._matcher.match(plain, verbless=True)
            if found is not None:
                return Clause(start, end, *found)
            if context.noun is not None and self._may_lean(part, context):
                noun = Context(noun=context.noun)
                if context.distant:
                    found = self._matcher.match(self._stretch(start, end, noun), verbless=False)
                    if found is not None:
                        return Clause(start, end, *found)
                found = self._matcher.match(self._stretch(start, end, noun), verbless=True)
                if found is not None:
                    return Clause(start, end, *found, leans=context.distant)
        return None

    def _says_again(self, part: Fragment) -> bool:
        """Whether a part only says how many were meant: "a cone, just one" is not two."""
        if part.after != _PAUSE or not self._contrasts(part):
            return False
        return not any(
            isinstance(edge.sense.value, Amount) or edge.concept in _PLACED
            for edge in self._lattice.between(part.start, part.end)
        )

    def _contrasts(self, part: Fragment) -> bool:
        """Whether a part says what shall be done instead of what shall not: "…, just the cars"."""
        return any(edge.sense.concept == CONTRAST for edge in self._lattice.edges[part.start])

    def _may_lean(self, part: Fragment, context: Context) -> bool:
        """Whether an amount without a noun may be of what was spoken of: not in "a pothole, just one"."""
        if context.distant or part.after == _PAUSE:
            return self._says_more(part.start, part.end) or (
                not context.distant and self._says_where(part.start, part.end)
            )
        return True

    def _says_where(self, start: int, end: int) -> bool:
        return any(edge.sense.concept in _PLACED for edge in self._lattice.between(start, end))

    def _only_number(self, start: int, end: int) -> bool:
        """Whether it says no more than a number: the "3" of "in lane 2 and 3"."""
        said = {edge.concept for edge in self._lattice.between(start, end)}
        return NUMBER in said and said.isdisjoint((*_PLACED, QUANTITY)) and not self._names_thing(start, end)

    def _names_thing(self, start: int, end: int) -> bool:
        return any(isinstance(edge.sense.value, Amount) for edge in self._lattice.between(start, end))

    def _says_more(self, start: int, end: int) -> bool:
        """Whether an amount in the tokens is one more of something."""
        return any(
            edge.sense.concept == QUANTITY and edge.sense.value in _FURTHER
            for edge in self._lattice.between(start, end)
        )

    def _negate(self, part: Fragment, context: Context) -> Clause | None:
        """A fragment that says what not to do: understood, then left out."""
        start, end = part.start, part.end
        if self._excepts(part, context):
            return None
        for given in (Context(negated=True), Context(context.verb, context.noun, negated=True)):
            found = self._matcher.match(self._stretch(start, end, given, negation=True), verbless=False)
            if found is not None:
                return Clause(start, end, found[0], [], negated=True)
        return None

    def _excepts(self, part: Fragment, context: Context) -> bool:
        """Whether it takes something out of what was said: to leave it out would do more than was meant."""
        said = list(self._lattice.between(part.start, part.end))
        if any(edge.concept.startswith("v.") for edge in said):
            return False
        kinds = {edge.sense.value.of for edge in said if isinstance(edge.sense.value, Amount)}
        whole = context.noun is not None and context.noun.concept.endswith(_WHOLE)
        return context.everything or (
            whole and context.noun is not None and context.noun.sense.value.of in kinds
        )

    def _stretch(
        self,
        start: int,
        end: int,
        context: Context | None = None,
        *,
        joined: bool = False,
        negation: bool = False,
    ) -> Stretch:
        """The tokens to be read, with what the context adds to them."""
        context = context or Context()
        edges: dict[int, Sequence[Edge]] = {}
        forms = set(self._moods)
        concepts: set[str] = {edge.sense.concept for edge in context.verb}
        longest = 1
        self._work.spend(end - start)
        for at in range(start, end):
            reach, starting, of = self._starting[at]
            if reach > end:
                starting = [edge for edge in starting if edge[1] <= end]
                of = {edge[2][0] for edge in starting}
            if starting:
                edges[at] = starting
                concepts |= of
                longest = max(longest, reach - at)
        if ALLOWS in concepts:
            for inside in edges.values():
                forms.update([str(edge.sense.value) for edge in inside if edge.sense.concept == ALLOWS])
        if context.noun is not None:
            for edge in understood_nouns(self._lattice, start, end, context.noun, self._vague):
                edges[edge.start] = [*edges.get(edge.start, ()), edge]
                concepts.add(edge.sense.concept)
                longest = max(longest, edge.end - edge.start)
        moods = self._moods | (_NEGATED if context.negated else frozenset())
        forms |= moods
        if context.negated:
            for at, starting in edges.items():
                lenient = [other for edge in starting for other in _lenient(edge)]
                if lenient:
                    edges[at] = [*starting, *lenient]
                    concepts.update([edge.concept for edge in lenient])
        return Stretch(
            start,
            end,
            edges,
            frozenset(concepts),
            frozenset(forms),
            moods,
            context.verb,
            joined,
            negation,
            context.negated,
            self._work,
            longest,
        )


def _start(edges: Sequence[Edge]) -> tuple[int, Sequence[Edge], Set[str]]:
    """How far the edges that start at a token reach, the edges, and their concepts."""
    return max([edge[1] for edge in edges], default=0), edges, {edge[2][0] for edge in edges}


def _context(clause: Clause, before: Context) -> Context:
    frame = clause.filled.frame
    verb = tuple(
        Edge(edge.start, edge.end, edge.sense)
        for edge in clause.filled.slots
        if edge.sense.concept in frame.inherits
    )
    amounts = [edge for edge in clause.filled.slots if isinstance(edge.sense.value, Amount)]
    noun = amounts[-1] if amounts else before.noun
    everything = any(edge.sense.concept == EVERYTHING for edge in clause.filled.slots)
    last = max(clause.filled.slots, key=lambda edge: edge.end, default=None)
    placed = last is not None and last.concept in _PLACED
    return Context(
        verb, noun, frame.verbless or not frame.inherits, clause.negated, everything, placed=placed
    )


def _lenient(edge: Edge) -> list[Edge]:
    """Any amount may stand for any other in a negated part: "don't add any cars" is about adding."""
    if not isinstance(edge.sense.value, Amount):
        return []
    name = edge.sense.concept.partition(".")[0]
    amount = Amount(edge.sense.value.of, 1)
    return [Edge(edge.start, edge.end, Sense(f"{name}.{form}", amount)) for form in _LENIENT]
