"""Self-repairs within one utterance: "add two cars, no, three", "turn left, I mean right".

What follows the repair words ("no", "I mean") replaces the span of the same pattern before them: a number
replaces a number, a lane a lane, a whole request the request before it. The sentence is read again with the
replacement, so nothing else in the engine knows of repairs. Several places where it fits are a question; no
place is a refusal, because what was taken back must never be done. Words that are also fillers ("sorry",
"actually") repair only where both parts are about the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from service.actions import Action
from service.grammar.accounting import VERB
from service.grammar.lattice import GLUE, NUMBER, Edge, Lattice
from service.grammar.noun_phrases import QUANTITY
from service.grammar.parse_types import Choice, Understood
from service.grammar.paths import SEPARATOR
from service.grammar.span_patterns import REPAIR, SKIPPED, SpanPattern, ends_of_pieces, steps_of
from service.grammar.tokens import Token
from service.grammar.work_budget import WorkBudget
from sim.actions import Add, Remove, SetCount

ALWAYS = "always"
"""Value of those that do wherever they stand: "I mean"."""

PERHAPS = "perhaps"
"""Value of those that are fillers elsewhere: "sorry"."""

DROPPED = "dropped"
"""That of words after which stands what shall not be: "instead of"."""

DENIED = "denied"
"""That of words after which an amount stands that is not meant: "to 0.4, not 0.5", "not two but four"."""

NUMBERS = "numbers"
"""That of words that take back only where a number follows: "no three"."""

CAPTURES = "captures"
"""Concept of verbs after which a name stands: "save this as"."""

FOIL = "foil"
"""Concept of a move that another one is compared with: "instead of right"."""
_COMPARING = frozenset(("q.why", "had_moved"))
"""Concepts of questions that compare; anywhere else such words say what shall not be."""

MAX_TRIED = 24
"""Places a correction is tried in; a sentence has fewer."""

_AMOUNTS = frozenset((NUMBER, "length", "speed", "seconds", "fraction", "times", "part_of"))

_DEFINITE = ("that", "those", "the", "of_the", "nearest", "all", "every", "both")
"""Quantities of things that are on the road already."""

_ALIKE = (
    ("add", "remove", "set_count", "scenario"),
    ("pause", "resume", "reset", "step", "rewind", "undo", "redo", "load"),
    ("show", "hide"),
    ("set", "adjust", "prefer"),
    ("drive", "mode"),
    ("evaluate", "find_worst"),
)
"""Actions that are about the same, so that one may be said instead of another."""

Read = Callable[[str], object]


class Repair:
    """A sentence in which something was taken back."""

    def __init__(
        self, plain: str, tokens: Sequence[Token], lattice: Lattice, edge: Edge, work: WorkBudget
    ) -> None:
        """`edge`: the words that take back."""
        self._work = work
        self._plain = plain
        self._tokens = tokens
        self._lattice = lattice
        self._edge = edge
        self._end = self._before_separators(edge.start)
        self._value = edge.sense.value
        self._again = self._past_more(self._past_separators(edge.end))
        cuts = (e.start for e in lattice.between(self._again + 1, lattice.size) if e.concept == SEPARATOR)
        self._tail = min(cuts, default=lattice.size)

    @classmethod
    def find(cls, plain: str, tokens: Sequence[Token], lattice: Lattice, work: WorkBudget) -> Repair | None:
        """The first thing taken back with something in its place, if any."""
        if REPAIR not in lattice.concepts:
            return None
        skipped = SKIPPED if lattice.concepts & _COMPARING else SKIPPED | {FOIL}
        edges = sorted((e for e in lattice.all() if e.concept == REPAIR), key=lambda e: (e.start, -e.end))
        for edge in edges:
            if edge.sense.value == ALWAYS and edge.end == lattice.size:  # "turn left, no wait"
                unfinished = cls(plain, tokens, lattice, edge, work)
                if unfinished._says_something(0, unfinished._end) and not unfinished._ends_a_phrase():
                    return unfinished
        for edge in edges:
            if any(
                other.end > edge.end and other.concept not in skipped for other in lattice.edges[edge.start]
            ):
                continue  # the first word of something else: "wait a second"
            one = cls(plain, tokens, lattice, edge, work)
            if edge.sense.value == NUMBERS and not one._begins_with_number():
                continue
            if edge.sense.value == DENIED and not one._denies_amount():
                continue
            if edge.sense.value in (DROPPED, DENIED) and one._says_something(one._again, one._tail):
                return one
            if one._says_something(0, one._end) and one._says_something(one._again, one._tail):
                return one
        return None

    @property
    def start(self) -> int:
        """The token at which the words that take back begin."""
        return self._edge.start

    @property
    def is_sure(self) -> bool:
        """Whether they do nothing else."""
        return bool(self._value == ALWAYS)

    @property
    def phrase(self) -> str:
        """What takes back, and what was said instead."""
        return self._written(self._edge.start, self._tail).strip(" ,;.")

    def readings(self, read: Read) -> list[Choice] | None:
        """The sentences that may be meant; None where nothing was taken back after all.

        None are meant where nothing is said in the place of what was taken back.
        """
        if self._edge.end == self._lattice.size:
            return []
        if self._value == DENIED:
            return self._without(read) or None
        if self._value == DROPPED:
            return self._without(read)
        if self._value == ALWAYS and self._alike(read) is False:
            return []
        if found := self._in_place(read):
            return self._or_so_many_more(found, read)
        if found := self._instead_of_all(read):
            return found
        return [] if self._value != PERHAPS or self._alike(read) is not False else None

    def _or_so_many_more(self, found: list[Choice], read: Read) -> list[Choice]:
        """With the same request of another number, where a total would stand for what is added or removed.

        "Add five cars, no, make it three" may be three more, or three in all.
        """
        before = read(self._written(0, self._end))
        some = isinstance(before, Understood) and any(
            isinstance(each, Add | Remove) for each in before.actions
        )
        if not some or not any(isinstance(each, SetCount) for one in found for each in one.actions):
            return found
        inside = self._lattice.between(self._again, self._tail)
        numbers = [edge.start for edge in inside if edge.concept == NUMBER and edge.end == self._tail]
        if not numbers:
            return found
        again, self._again = self._again, min(numbers)
        more = self._in_place(read)
        self._again = again
        known = [each.actions for each in found]
        return [*found, *(each for each in more if each.actions not in known)]

    def _without(self, read: Read) -> list[Choice]:
        """The reading without what is not wanted: "use Dijkstra instead of A*", in either order."""
        said = ends_of_pieces(steps_of(self._lattice), self._again, self._work)
        found: list[Choice] = []
        for end in sorted(end for end in said if end <= self._tail and self._is_apart(end)):
            before = self._written(0, self._edge.start if end < self._tail else self._end)
            text = f"{before} {self._written(self._past_separators(end), self._lattice.size)}".strip(" ,;")
            parsed = read(text)
            if not isinstance(parsed, Understood) or (self._points(end) and _adds(parsed.actions)):
                continue
            if self._belongs_to_the_rest(end, parsed, read):
                continue
            if all(c.actions != parsed.actions for c in found):
                found.append(Choice(text, parsed.actions))
        return found

    def _is_apart(self, end: int) -> bool:
        """Whether what is not wanted ends there: before other words of its kind, and not inside its request.

        At the beginning it ends at a mark ("instead of adding a cone, add a bus") or before the verb of what
        is wanted ("instead of A* use Dijkstra"): "instead of making it night" wants nothing.
        """
        if self._end == 0 and end < self._tail:
            dropped = list(self._lattice.between(self._again, end))
            if any(edge.concept.startswith((VERB, CAPTURES)) for edge in dropped):
                return False
            if all(edge.concept in SKIPPED or edge.sense.value is None for edge in dropped):
                return False
            if not any(edge.concept.startswith(VERB) for edge in self._lattice.edges[end]):
                return False
        return self._stands_elsewhere(end)

    def _belongs_to_the_rest(self, end: int, parsed: Understood, read: Read) -> bool:
        """Whether what would be dropped is part of the request after it: "instead of the car should stop"."""
        if self._end > 0 or self._past_separators(end) > end:
            return False
        whole = read(self._written(self._again, self._lattice.size))
        return isinstance(whole, Understood) and whole.actions == parsed.actions

    def _points(self, end: int) -> bool:
        """Whether things on the road are dropped: "instead of that cone" is more than not to add one."""
        return any(
            edge.concept == QUANTITY and edge.sense.value in _DEFINITE
            for edge in self._lattice.between(self._again, end)
        )

    def _stands_elsewhere(self, end: int) -> bool:
        """Whether something of the same pattern as what is dropped is kept; else too much is dropped."""
        steps = steps_of(self._lattice)
        pattern = SpanPattern(steps, self._again, end, self._work)
        kept = (
            *((at, self._end) for at in range(self._end)),
            *((at, len(steps)) for at in range(end, len(steps))),
        )
        return any(pattern.first_match(at, last) is not None for at, last in kept)

    def _in_place(self, read: Read) -> list[Choice]:
        """The readings with a span of the same pattern replaced; the last request is tried first."""
        steps = steps_of(self._lattice)
        if self._tail not in ends_of_pieces(steps, self._again, self._work):
            return []
        pattern = SpanPattern(steps, self._again, self._tail, self._work)
        start = self._last_part()
        as_said = read(self._written(0, self._end))
        for begin in dict.fromkeys((start, 0)):
            found: list[Choice] = []
            alike: list[Choice] = []
            for at, end in self._places(begin, pattern):
                text = self._with(at, end)
                parsed = read(text)
                same = isinstance(as_said, Understood) and isinstance(parsed, Understood)
                if same and parsed.actions == as_said.actions:  # type: ignore[attr-defined]
                    alike = [Choice(text, parsed.actions)]  # type: ignore[attr-defined]
                    continue
                if isinstance(parsed, Understood) and all(c.actions != parsed.actions for c in found):
                    found.append(Choice(text, parsed.actions))
            if found or alike:
                return _as_many(found, as_said) or alike
        return []

    def _instead_of_all(self, read: Read) -> list[Choice]:
        """The reading with the whole last request replaced, where both are about the same."""
        if self._alike(read) is not True:
            return []
        text = self._with(self._last_part(), self._end)
        parsed = read(text)
        return [Choice(text, parsed.actions)] if isinstance(parsed, Understood) else []

    def _alike(self, read: Read) -> bool | None:
        """Whether both are requests about the same; None where one of them is none."""
        before, after = (
            read(self._written(*part)) for part in ((self._last_part(), self._end), (self._again, self._tail))
        )
        if not (isinstance(before, Understood) and isinstance(after, Understood)):
            return None
        return bool(_groups(before.actions) & _groups(after.actions))

    def _places(self, begin: int, pattern: SpanPattern) -> Iterator[tuple[int, int]]:
        """The spans of the same pattern; a longer one from the same token has only fillers more."""
        tried = 0
        for at in range(begin, self._end):
            if (end := pattern.first_match(at, self._end)) is not None:
                tried += 1
                if tried > MAX_TRIED:
                    return
                yield at, end

    def _with(self, at: int, end: int) -> str:
        """The whole text with what was said instead in the place of a stretch."""
        tail = self._plain[self._tokens[self._tail].start :] if self._tail < len(self._tokens) else ""
        before = self._plain[: self._tokens[at].start]
        parts = (before, self._written(self._again, self._tail), self._written(end, self._end), tail)
        return " ".join(part.strip() for part in parts if part.strip())

    def _last_part(self) -> int:
        """Where the last request before the correction begins."""
        separators = (e for e in self._lattice.between(0, self._end) if e.concept == SEPARATOR)
        return max((edge.end for edge in separators), default=0)

    def _before_separators(self, end: int) -> int:
        while end and any(e.end == end and e.concept == SEPARATOR for e in self._lattice.edges[end - 1]):
            end -= 1
        return end

    def _past_separators(self, at: int) -> int:
        while at < self._lattice.size and any(e.concept == SEPARATOR for e in self._lattice.edges[at]):
            at = max(e.end for e in self._lattice.edges[at] if e.concept == SEPARATOR)
        return at

    def _past_more(self, at: int) -> int:
        """Past more words of the kind, and fillers before a mark: ", sorry, I mean", ", no, sorry,"."""
        while at < self._lattice.size:
            here = [e for e in self._lattice.edges[at] if e.end < self._lattice.size]
            more = [e for e in here if e.concept == REPAIR and e.sense.value not in (DROPPED, NUMBERS)]
            if any(edge.sense.value == ALWAYS for edge in more) and self._value == PERHAPS:
                self._value = ALWAYS
            fillers = [e for e in here if e.concept == GLUE and self._past_separators(e.end) > e.end]
            if not (more or fillers):
                break
            at = self._past_separators(max(edge.end for edge in (*more, *fillers)))
        return at

    def _ends_a_phrase(self) -> bool:
        """Whether these are the last words of a longer phrase: "that is not what I meant"."""
        start, end = self._edge.start, self._edge.end
        return any(
            each.start < start and each.end == end and each.concept not in SKIPPED
            for each in self._lattice.all()
        )

    def _begins_with_number(self) -> bool:
        after = self._lattice.edges[self._again] if self._again < self._lattice.size else []
        return any(edge.concept == NUMBER for edge in after)

    def _denies_amount(self) -> bool:
        """Whether an amount follows and nothing else, up to the end of the part."""
        here = self._lattice.edges[self._again] if self._again < self._lattice.size else []
        return any(edge.concept in _AMOUNTS and edge.end == self._tail for edge in here)

    def _says_something(self, start: int, end: int) -> bool:
        return any(edge.concept not in SKIPPED for edge in self._lattice.between(start, end))

    def _written(self, start: int, end: int) -> str:
        return self._plain[self._tokens[start].start : self._tokens[end - 1].end] if start < end else ""


def _adds(actions: Sequence[Action]) -> bool:
    """Whether something is put on the road."""
    return any(isinstance(action, Add) for action in actions)


def _as_many(found: list[Choice], as_said: object) -> list[Choice]:
    """Those that are as many requests as were said before, if there are such; else all."""
    many = len(as_said.actions) if isinstance(as_said, Understood) else 0
    return [choice for choice in found if len(choice.actions) == many] or found


def about_the_same(one: Sequence[Action], other: Sequence[Action]) -> bool:
    """Whether some actions may be said instead of others."""
    return _groups(one) == _groups(other)


def _groups(actions: Sequence[Action]) -> set[object]:
    """What the actions are about."""
    return {
        (
            next((group for group in _ALIKE if action.do in group), action.do),
            getattr(action, "parameter", None),
        )
        for action in actions
    }
