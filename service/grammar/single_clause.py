"""One fragment → a clause: by itself, leaning on the clause before it, negated, or without a verb."""

from __future__ import annotations

from dataclasses import replace

from service.grammar.clause import PLACED, Clause, places_of
from service.grammar.composition import Composition, Matcher
from service.grammar.fragments import BUT, EXCEPT, INTERJECTION, OR, PAUSE, Fragment
from service.grammar.lattice import GLUE, NUMBER, Lattice
from service.grammar.noun_phrases import QUANTITY, Amount
from service.grammar.paths import NEGATION
from service.grammar.places_apart import are_apart
from service.grammar.stretches import Context, Stretches

_WHOLE = (".all", ".the_many", ".bare_many", ".those")
"""Amounts that hold again in another place: "the cones in lane 3 and in lane 5"."""

_FURTHER = ("more", "another")

CONTRAST = "contrast"

LEAVING_OUT = frozenset(("v.spare", "thing.none"))
"""Concepts by which a part leaves something out without a negation: "keep the cones", "no cars"."""


class SingleClauses:
    """Reads fragments of one sentence, each by itself or with what the clause before hands on."""

    def __init__(
        self, matcher: Matcher, lattice: Lattice, stretches: Stretches, composition: Composition
    ) -> None:
        self._matcher = matcher
        self._lattice = lattice
        self._stretches = stretches
        self._composition = composition

    def read(self, part: Fragment, context: Context) -> Clause | None:
        """One fragment as a clause: by itself, leaning on the clause before, or without a verb."""
        if part.after == EXCEPT or (part.after == OR and not context.negated):
            return None
        start, end = part.start, part.end
        if context.negated and context.verb and self._contrasts(part):
            instead = replace(context, negated=False)
            found = self._matcher.match(self._stretches.make(start, end, instead), verbless=False)
            if found is not None:
                return Clause(start, end, *found)
        plain = self._stretches.make(start, end)
        found = self._matcher.match(plain, verbless=False)
        if found is not None:
            if found[0].frame.leaves_out and self._takes_out(part, context):
                return None
            clause = Clause(start, end, *found, negated=found[0].frame.leaves_out)
            belongs = self._composition.also_leans(part, found, context)
            return clause if belongs is None else replace(clause, instead=(Clause(start, end, *belongs),))
        if NEGATION in plain.concepts:
            return self._negate(part, context)
        if part.after == BUT or (context.verb and self._says_again(part)):
            return None
        if context.placed and self._only_number(start, end):
            return None
        if context.verb and not self._calls(part):
            leaning = self._stretches.make(start, end, context)
            found = self._matcher.match(leaning, verbless=False)
            if found is None and context.noun is not None and context.noun.concept.endswith(_WHOLE):
                again = Context((*context.verb, context.noun), None, negated=context.negated)
                found = self._matcher.match(self._stretches.make(start, end, again), verbless=False)
            if found is not None and context.negated:
                return Clause(start, end, found[0], [], negated=True)
            if found is not None:
                own = self._composition.differs(part, found)
                return Clause(start, end, *found, instead=(Clause(start, end, *own),) if own else ())
        if context.verbless and not (context.negated and (context.verb or part.after == OR)):
            found = self._matcher.match(plain, verbless=True)
            if found is not None:
                return Clause(start, end, *found)
            if context.noun is not None and self._may_lean(part, context):
                noun = Context(noun=context.noun)
                if context.distant:
                    found = self._matcher.match(self._stretches.make(start, end, noun), verbless=False)
                    if found is not None:
                        return Clause(start, end, *found)
                found = self._matcher.match(self._stretches.make(start, end, noun), verbless=True)
                if found is not None:
                    return Clause(start, end, *found, leans=context.distant)
        return None

    def _calls(self, part: Fragment) -> bool:
        """Whether a part only calls for attention: "and then, please tell me, …", but not "then right"."""
        whole = [edge for edge in self._lattice.edges[part.start] if edge.end == part.end]
        calls = any(edge.concept == INTERJECTION for edge in whole)
        return calls and all(edge.sense.value is None for edge in whole)

    def _says_again(self, part: Fragment) -> bool:
        """Whether a part only says how many were meant: "a cone, just one" is not two."""
        if part.after != PAUSE or not self._contrasts(part):
            return False
        return not any(
            isinstance(edge.sense.value, Amount) or edge.concept in PLACED
            for edge in self._lattice.between(part.start, part.end)
        )

    def _contrasts(self, part: Fragment) -> bool:
        """Whether a part says what shall be done instead of what shall not: "…, just the cars"."""
        return any(edge.sense.concept == CONTRAST for edge in self._lattice.edges[part.start])

    def _may_lean(self, part: Fragment, context: Context) -> bool:
        """Whether an amount without a noun may be of what was spoken of: not in "a pothole, just one"."""
        if context.distant or part.after == PAUSE:
            return self._says_more(part.start, part.end) or (
                not context.distant and self._says_where(part.start, part.end)
            )
        return True

    def _says_where(self, start: int, end: int) -> bool:
        return any(edge.sense.concept in PLACED for edge in self._lattice.between(start, end))

    def _only_number(self, start: int, end: int) -> bool:
        """Whether it says no more than a number: the "3" of "in lane 2 and 3"."""
        said = {edge.concept for edge in self._lattice.between(start, end)}
        return NUMBER in said and said.isdisjoint((*PLACED, QUANTITY)) and not self._names_thing(start, end)

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
        if self._excepts(part, context) or self._says_nothing_but_no(part) or self._says_no_twice(part):
            return None
        for given in (Context(negated=True), Context(context.verb, context.noun, negated=True)):
            found = self._matcher.match(
                self._stretches.make(start, end, given, negation=True), verbless=False
            )
            if found is not None and given.verb and self._takes_place_out(part, context):
                return None
            if found is not None:
                forbids = () if given.verb else tuple(found[1])
                return Clause(start, end, found[0], [], negated=True, forbids=forbids)
        return None

    def _says_no_twice(self, part: Fragment) -> bool:
        """Whether a part denies what leaves something out already: "but do not keep the cones"."""
        said = self._lattice.between(part.start, part.end)
        return any(edge.concept in LEAVING_OUT for edge in said)

    def _says_nothing_but_no(self, part: Fragment) -> bool:
        """Whether a part has a negation and nothing that it could be about: "turn left, not, …"."""
        covered = part.start
        for edge in self._lattice.between(part.start, part.end):
            if edge.sense.form or edge.concept not in (NEGATION, GLUE):
                continue
            if edge.start <= covered < edge.end:
                covered = edge.end
        return covered >= part.end

    def _takes_place_out(self, part: Fragment, context: Context) -> bool:
        """Whether it only says where something shall not be, which the place that was said leaves open."""
        said = list(self._lattice.between(part.start, part.end))
        where = places_of(said)
        return (
            bool(where)
            and not any(edge.concept.startswith("thing") for edge in said)
            and not (where.keys() <= context.places.keys() and are_apart(context.places, where))
        )

    def _excepts(self, part: Fragment, context: Context) -> bool:
        """Whether it takes something out of what was said: to leave it out would do more than was meant."""
        said = list(self._lattice.between(part.start, part.end))
        if any(edge.concept.startswith("v.") for edge in said):
            return False
        return self._takes_out(part, context)

    def _takes_out(self, part: Fragment, context: Context) -> bool:
        """Whether the things it names are among those that were said to be all: "…, but keep the cones"."""
        said = list(self._lattice.between(part.start, part.end))
        kinds = {edge.sense.value.of for edge in said if isinstance(edge.sense.value, Amount)}
        whole = context.noun is not None and context.noun.concept.endswith(_WHOLE)
        return context.everything or (
            whole and context.noun is not None and context.noun.sense.value.of in kinds
        )
