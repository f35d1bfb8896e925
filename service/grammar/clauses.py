"""Fragments → clauses: where one request ends and the next begins, and what is carried over.

A sentence is cut at its separators ("and", "then", commas). A fragment is a clause when a frame fits it; it
may also lean on the clause before it ("add two cones and a bus in lane 5"), or belong together
with the fragments after it when a frame says that its parts may be listed ("highway, night, 10
potholes"). Negated fragments are understood and then left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from service.grammar.accounting import VERB
from service.grammar.clause import Clause, Divided, context_after
from service.grammar.composition import Composition, Matcher, asks, within
from service.grammar.fragments import AND, OR, PAUSE, STOP, THEN, Fragment
from service.grammar.frames import Filled
from service.grammar.lattice import Edge, Lattice
from service.grammar.lexicon import SECOND, Sense
from service.grammar.noun_phrases import Amount
from service.grammar.paths import NEGATION
from service.grammar.single_clause import SingleClauses
from service.grammar.stretches import Context, Stretches
from service.grammar.work_budget import WorkBudget

MAX_JOINED = 16
"""How many fragments one listing clause may have."""

_TOGETHER = frozenset({"pause", "stop", "and", "but"})
"""Separators inside a listing clause; any other ends it."""

STEERING = ("pause", "resume", "reset")
"""Concepts of verbs that are requests alone."""

_COUNTING = ("add", "set_count")
SCENARIO = "scenario"
PREFER = "prefer"


class Divider:
    """Divides the fragments of one sentence into clauses."""

    def __init__(
        self, matcher: Matcher, lattice: Lattice, vague: int, moods: frozenset[str], work: WorkBudget
    ) -> None:
        self._matcher = matcher
        self._lattice = lattice
        self._stretches = Stretches(lattice, vague, moods, work)
        self._composition = Composition(matcher, self._stretches)
        self._singles = SingleClauses(matcher, lattice, self._stretches, self._composition)

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
                    or self._hangs_on_question(before, clause, parts[at])
                    or self._may_be_negated(before, clause, parts[at])
                )
            ):
                divided.failed = parts[at]
                return divided
            divided.clauses.append(replace(clause, after=parts[at].after))
            context = context_after(clause, context)
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
            if self._is_halved(clause, said):
                return clause, used
            asked = self._composition.first_question((clause.filled, clause.actions), said)
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

    def _is_halved(self, clause: Clause, parts: Sequence[Fragment]) -> bool:
        """Whether what a frame keeps begins in the first part and ends in another: "let A* and B race"."""
        begun = {
            edge.part
            for edge in clause.filled.slots
            if edge.part and edge.concept in clause.filled.frame.keeps and edge.end <= parts[0].end
        }
        ends = self._lattice.between(parts[1].start, clause.end)
        return any(edge.part in begun and edge.concept == SECOND for edge in ends)

    def _first_of_two(
        self, parts: Sequence[Fragment], at: int, context: Context
    ) -> tuple[Clause | None, int]:
        """A part as a clause; one that only begins the sentence that it stands in goes with the next part."""
        part = parts[at]
        if not (at and context.verb):
            return self._singles.read(part, context), 1
        if self._describes_hazard(parts, at):
            return None, 1
        if not self._begins_request(parts, at):
            return self._singles.read(part, context), 1
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
                    clause, used = self._singles.read(parts[at], context), 1
                if clause is None:
                    return None
                found.append(replace(clause, after=parts[at].after))
                context = context_after(clause, context)
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
        while last < min(len(parts), at + MAX_JOINED) and parts[last].after in (*_TOGETHER, OR):
            if parts[last].after != PAUSE and self._begins_request(parts, last):
                break
            last += 1
        if parts[at].after == OR:
            return None, 0
        for end in range(last, at + 1, -1):
            start, stop = parts[at].start, parts[end - 1].end
            stretch = self._stretches.make(start, stop, joined=True)
            found = self._matcher.match(stretch, verbless=None if context.verbless else False)
            if any(part.after == OR for part in parts[at + 1 : end]):
                if found is not None and self._keeps_or(found[0], parts[at + 1 : end]):
                    return Clause(start, stop, *found), end - at
                continue
            if found is not None and not self._each_whole(parts[at:end]):
                return Clause(start, stop, *found), end - at
            if found is None and context.verb and not context.negated:
                leaning = self._matcher.match(
                    self._stretches.make(start, stop, context, joined=True), verbless=False
                )
                if leaning is not None:
                    return Clause(start, stop, *leaning), end - at
        return None, 0

    def _keeps_or(self, filled: Filled, parts: Sequence[Fragment]) -> bool:
        """Whether a frame keeps the "or" before each part that has one: it was asked which of two."""
        kept = [edge.end for edge in self._lattice.all() if edge.concept in filled.frame.keeps]
        return all(part.start in kept for part in parts if part.after == OR)

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

    def _hangs_on_question(self, before: Clause, clause: Clause, part: Fragment) -> bool:
        """Whether a part without a verb would be done that may belong to the question before it.

        "Would you have crashed with lidar and a pothole" supposes both, and asks for none of them; so does
        "what is the safest move, and the fastest?": one word for a style asks on.
        """
        if not asks(before.actions) or asks(clause.actions) or not clause.actions:
            return False
        if all(action["do"] == PREFER for action in clause.actions) and part.after in (AND, PAUSE):
            said = self._lattice.between(part.start, part.end)
            alone = all(edge.end - edge.start == 1 for edge in clause.filled.slots)
            return alone and not any(edge.concept.startswith(VERB) for edge in said)
        return part.after == AND and self._composition.verb_of_its_own(part) is None

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
