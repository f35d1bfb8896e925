"""Fragments → clauses: where one request ends and the next begins, and what is carried over.

A sentence is cut at its separators ("and", "then", commas). A fragment is a clause when a frame fits it; it
may also lean on the clause before it ("add two cones and a bus in lane 5"), or belong together
with the fragments after it when a frame says that its parts may be listed ("highway, night, 10
potholes"). Negated fragments are understood and then left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from service.grammar.accounting import VERB
from service.grammar.composition import Composition, Matcher, asks, within
from service.grammar.fragments import AND, BUT, EXCEPT, INTERJECTION, OR, PAUSE, STOP, THEN, Fragment
from service.grammar.frames import Filled
from service.grammar.lattice import GLUE, NUMBER, Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import QUANTITY, Amount
from service.grammar.paths import NEGATION
from service.grammar.places_apart import are_apart
from service.grammar.stretches import Context, Stretches
from service.grammar.work_budget import WorkBudget

MAX_JOINED = 16
"""How many fragments one listing clause may have."""

_TOGETHER = frozenset({"pause", "stop", "and", "but"})
"""Separators inside a listing clause; any other ends it."""
_WHOLE = (".all", ".the_many", ".bare_many", ".those")
"""Amounts that hold again in another place: "the cones in lane 3 and in lane 5"."""

_FURTHER = ("more", "another")
_PLACED = ("place", "side", "length")

STEERING = ("pause", "resume", "reset")
"""Concepts of verbs that are requests alone."""

CONTRAST = "contrast"
_COUNTING = ("add", "set_count")
SCENARIO = "scenario"
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
    instead: tuple[Clause, ...] = ()
    """what its parts mean alone, where that is another thing: which of them was meant is asked"""
    forbids: tuple[Mapping[str, Any], ...] = ()
    """what a negated part would do otherwise; its amounts may be any"""

    @property
    def supposes(self) -> str | None:
        """What it takes for granted beyond its actions."""
        return self.filled.frame.supposes


@dataclass(slots=True)
class Divided:
    """The clauses found; `failed` is the first fragment that nothing fits, if any."""

    clauses: list[Clause] = field(default_factory=list)
    failed: Fragment | None = None


class Divider:
    """Divides the fragments of one sentence into clauses."""

    def __init__(
        self, matcher: Matcher, lattice: Lattice, vague: int, moods: frozenset[str], work: WorkBudget
    ) -> None:
        self._matcher = matcher
        self._lattice = lattice
        self._stretches = Stretches(lattice, vague, moods, work)
        self._composition = Composition(matcher, self._stretches)

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
            clause, used = self._next(parts, at, context)
            if clause is not None and at + used < len(parts) and self._either_way(parts, at, used):
                clause, at = None, at + used
            before = divided.clauses[-1] if divided.clauses else None
            if clause is None or (
                before is not None
                and (
                    self._says_twice(before, clause, parts[at])
                    or self._may_be_negated(before, clause, parts[at])
                )
            ):
                divided.failed = parts[at]
                return divided
            divided.clauses.append(replace(clause, after=parts[at].after))
            context = _context(clause, context)
            at += used
        return divided

    def _next(self, parts: Sequence[Fragment], at: int, context: Context) -> tuple[Clause | None, int]:
        """The clause that starts with a part, and how many parts it has."""
        end = len(parts)
        while True:
            clause, used = self._join(parts[:end], at, context)
            if clause is None:
                return self._first_of_two(parts[:end], at, context)
            if not clause.actions:  # it says only what not to do, or asks for itself
                return clause, used
            said = parts[at : at + used]
            asked = self._composition.first_question(clause.actions, said)
            if asked is not None:
                end = at + max(asked, 1)
                continue
            heads = self._composition.heads(clause.filled, said)
            if not heads:
                swallowed = self._composition.swallows((clause.filled, clause.actions), said)
                either = self._or_apart(clause, said, context) if swallowed else clause
                if swallowed and not either.instead and self._composition.loses_first(clause.actions, said):
                    end = at + 1
                    continue
                return either, used
            apart = self._requests(said, heads, context)
            if apart is None or _same(apart, clause):
                if self._composition.loses_first(clause.actions, said):
                    end = at + 1
                    continue
                return clause, used
            own = self._composition.verb_of_its_own(said[0]) is not None
            optional = _optional(clause, apart)
            leans = (
                bool(context.verb) and parts[at].after != STOP and self._composition.alone(said[0]) is None
            )
            if not (own or optional or context.verb) and said[heads[-1]].after in (PAUSE, AND):
                return clause, used
            if own or said[heads[-1]].after not in (PAUSE, AND) or (optional and leans):
                end = at + heads[-1]
                continue
            return replace(clause, instead=tuple(apart)), used

    def _first_of_two(
        self, parts: Sequence[Fragment], at: int, context: Context
    ) -> tuple[Clause | None, int]:
        """A part as a clause; one that only begins the sentence that it stands in goes with the next part."""
        part = parts[at]
        if not (at and context.verb):
            return self._single(part, context), 1
        if self._describes_hazard(parts, at):
            return None, 1
        if not self._begins_request(parts, at):
            return self._single(part, context), 1
        both = self._stretches.make(part.start, parts[at + 1].end, joined=True)
        found = self._matcher.match(both, verbless=False)
        if found is None or part.after not in (STOP, THEN):
            return None, 1
        return Clause(part.start, parts[at + 1].end, *found), 2

    def _describes_hazard(self, parts: Sequence[Fragment], at: int) -> bool:
        """Whether a part that may lean is a question with the next: "pothole 2 m ahead, speed 40 km/h"."""
        if (
            at + 1 == len(parts)
            or parts[at + 1].after != PAUSE
            or self._composition.verb_of_its_own(parts[at])
        ):
            return False
        both = self._stretches.make(parts[at].start, parts[at + 1].end, joined=True)
        found = self._matcher.match(both)
        return found is not None and asks(found[1])

    def _requests(
        self, parts: Sequence[Fragment], heads: Sequence[int], context: Context
    ) -> list[Clause] | None:
        """The parts as several requests, which begin at those of `heads`; None where one is none."""
        found: list[Clause] = []
        for first, last in zip([0, *heads], [*heads, len(parts)], strict=True):
            at = first
            while at < last:
                clause, used = self._join(parts[:last], at, context)
                if clause is None:
                    clause, used = self._single(parts[at], context), 1
                if clause is None:
                    return None
                found.append(replace(clause, after=parts[at].after))
                context = _context(clause, context)
                at += used
        return found

    def _or_apart(self, clause: Clause, parts: Sequence[Fragment], context: Context) -> Clause:
        """A listing, with what its parts are as clauses of their own; without, where they are none."""
        own = [self._composition.alone(part) for part in parts]
        apart = [
            Clause(part.start, part.end, *found, after=part.after)
            for part, found in zip(parts, own, strict=True)
            if found is not None
        ]
        if len(apart) < len(parts):
            found = self._requests(parts, range(1, len(parts)), context)
            apart = [one for each in found or () for one in each.instead or (each,)]
        stops = any(part.after == STOP for part in parts[1:])
        if not apart or _same(apart, clause) or not (stops or _optional(clause, apart)):
            return clause
        return replace(clause, instead=tuple(apart))

    def _join(self, parts: Sequence[Fragment], at: int, context: Context) -> tuple[Clause | None, int]:
        """The longest listing clause that starts here, of two fragments or more."""
        last = at + 1
        while last < min(len(parts), at + MAX_JOINED) and parts[last].after in _TOGETHER:
            if parts[last].after != PAUSE and self._begins_request(parts, last):
                break
            last += 1
        if parts[at].after == OR:
            return None, 0
        for end in range(last, at + 1, -1):
            start, stop = parts[at].start, parts[end - 1].end
            stretch = self._stretches.make(start, stop, joined=True)
            found = self._matcher.match(stretch, verbless=None if context.verbless else False)
            if found is not None and not self._each_whole(parts[at:end]):
                return Clause(start, stop, *found), end - at
            if found is None and context.verb and not context.negated:
                leaning = self._matcher.match(
                    self._stretches.make(start, stop, context, joined=True), verbless=False
                )
                if leaning is not None:
                    return Clause(start, stop, *leaning), end - at
        return None, 0

    def _either_way(self, parts: Sequence[Fragment], first: int, used: int) -> bool:
        """Whether a part may belong to the request before it as well as to the one after it."""
        at = first + used
        if used > 1 and parts[at - 1].after == PAUSE and self._begins_request(parts, at - 1):
            return True
        if used > 1 and self._describes_hazard(parts, at - 1):
            return True
        if (
            parts[at].after == PAUSE
            or parts[at].after not in _TOGETHER
            or not self._begins_request(parts, at)
        ):
            return False
        before = self._stretches.make(parts[first].start, parts[at].end, joined=True)
        return self._matcher.match(before, verbless=False) is not None

    def _may_be_negated(self, before: Clause, clause: Clause, part: Fragment) -> bool:
        """Whether a negation may go on over an "and": "don't add cars and make it rain" may want no rain.

        One after its verb ends with it, where another verb follows.
        """
        if not before.negated or before.filled.frame.leaves_out or part.after != AND:
            return False
        if not clause.actions or asks(clause.actions):
            return False
        if self._composition.verb_of_its_own(part) is None:
            return True
        said = list(self._lattice.between(before.start, before.end))
        verbs = [edge.start for edge in said if edge.concept.startswith(VERB) or edge.concept in STEERING]
        return any(edge.concept == NEGATION and edge.start <= min(verbs, default=edge.start) for edge in said)

    def _says_twice(self, before: Clause, clause: Clause, part: Fragment) -> bool:
        """Whether a part without a verb would be in the scenario before it, which has that already."""
        if part.after not in (PAUSE, STOP, AND) or self._composition.verb_of_its_own(part) is not None:
            return False
        said = {key for action in before.actions if action["do"] == SCENARIO for key in action}
        return any(
            action["do"] in _COUNTING and "where" not in action and f"{action['kind']}s" in said
            for action in clause.actions
        )

    def _begins_request(self, parts: Sequence[Fragment], at: int) -> bool:
        """Whether a part only begins the sentence that it stands in: "10 metres ahead, add a cone"."""
        if at + 1 == len(parts) or parts[at + 1].after != PAUSE:
            return False
        if self._composition.alone(parts[at]) or not self._composition.verb_of_its_own(parts[at + 1]):
            return False
        both = self._stretches.make(parts[at].start, parts[at + 1].end, joined=True)
        return self._matcher.match(both, verbless=False) is not None

    def _each_whole(self, parts: Sequence[Fragment]) -> bool:
        """Whether each sentence in it is a request by itself: then they are several."""
        begins = [0, *(at for at, part in enumerate(parts) if at and part.after == STOP)]
        if len(begins) == 1:
            return False
        whole = (parts[a:b] for a, b in zip(begins, [*begins[1:], len(parts)], strict=True))
        stretches = (self._stretches.make(s[0].start, s[-1].end, joined=len(s) > 1) for s in whole)
        return all(self._matcher.match(stretch, verbless=False) is not None for stretch in stretches)

    def _single(self, part: Fragment, context: Context) -> Clause | None:
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
            isinstance(edge.sense.value, Amount) or edge.concept in _PLACED
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
        if self._excepts(part, context) or self._says_nothing_but_no(part):
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
        where = _places(said)
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
    everything = everything or any(action.get("kind") == EVERYTHING for action in clause.actions)
    last = max(clause.filled.slots, key=lambda edge: edge.end, default=None)
    placed = last is not None and last.concept in _PLACED
    return Context(
        verb,
        noun,
        frame.verbless or not frame.inherits,
        clause.negated,
        everything,
        placed=placed,
        asks=asks(clause.actions),
        places=_places(clause.filled.slots),
    )


def _places(edges: Iterable[Edge]) -> dict[str, Any]:
    """By what the places among some edges are given ("lane", the concept of any other), and what they are."""
    places: dict[str, Any] = {}
    for edge in edges:
        if edge.concept in _PLACED:
            value = edge.sense.value
            places |= value if isinstance(value, dict) else {edge.concept: value}
    return places


def _same(apart: Sequence[Clause], joint: Clause) -> bool:
    """Whether several requests do no more than one does."""
    actions = [action for clause in apart for action in clause.actions]
    return actions == joint.actions or within(actions, joint.actions)


def _optional(joint: Clause, apart: Sequence[Clause]) -> bool:
    """Whether a listing needs none but some of its parts: then the others are not there for it.

    "Pothole 2 m ahead, speed 40 km/h" is one question, which neither part is alone.
    """
    verbs = {action["do"] for clause in apart for action in clause.actions}
    return all(action["do"] in verbs for action in joint.actions)
