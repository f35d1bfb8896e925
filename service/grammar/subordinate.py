"""Sentences with another sentence inside: "what if …", "when I say …, I mean …"."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, get_args

from service.actions.question_names import MomentName, PolicyName
from service.actions.table import WhatIf, verbs_where
from service.grammar.clause import Clause, Divided
from service.grammar.clauses import SCENARIO
from service.grammar.composition import asks
from service.grammar.fragments import BUT, OR, PAUSE, STOP, Fragment
from service.grammar.frames import Filled, Frame
from service.grammar.lattice import GLUE, NAME, Edge, Lattice
from service.grammar.lexicon import Sense
from service.grammar.paths import SEPARATOR
from service.grammar.sentence_openings import IF, TEACH, THEN_WHAT, WHAT_IF, WITHOUT, Beginnings
from sim.types import Move

HAD_MOVED = "had_moved"
STANDS = "stand_ticks"
"""Concept of whole questions that suppose some ticks of standing still."""
DRIVE = "drive"
HAD_BEEN = "had_been"
"""Concept of words that suppose something of a past moment: "had not been there"."""
SUPPOSED_DRIVE = "supposed_drive"
"""Concept of whole conditions that suppose a way of driving: "you never change lanes"."""
ROAD_SIZE = frozenset({"columns", "rows"})
TICK = "tick"
MEANS = "means"

THEN_PREFACE = "then_preface"
"""What was done at a tick, told before a question about another move: its comma ends no sentence."""
_OPENING = frozenset((WHAT_IF, IF, THEN_WHAT, TEACH))
"""Where none of these is said, there is no subordinate clause."""

TEACHING = verbs_where(lambda traits: traits.changes_aliases)
NO_CHANGE = verbs_where(lambda traits: traits.what_if is WhatIf.INVALID)
"""Actions that cannot stand in a condition."""

GOES_BACK = verbs_where(lambda traits: traits.what_if is WhatIf.REFUSED)
"""Actions that go back in time; after a condition and "but" they are about the session."""

WOULD_HAVE = "would_have"
"""Concept of words by which a question is about a past moment: "would you have"."""

CONDITIONAL = frozenset({"cond", "past", "at"})
"""Forms in place inside a condition."""

Divide = Callable[[int, int, frozenset[str]], Divided]
"""Reads tokens `[start, end)` as clauses, with these forms in place."""

_FRAME = Frame("subordinate", (), frozenset(), frozenset())


def read_all(lattice: Lattice, start: int, end: int, divide: Divide) -> Divided | Fragment:
    """The clauses of all sentences in `[start, end)`, or the part of one that nothing fits."""
    whole = Divided()
    for after, first, last in _sentences(lattice, start, end):
        if (supposed := _move_supposed(lattice, first, last, divide)) is not None:
            whole.clauses += supposed.clauses
            continue
        result = _read_subordinate(lattice, first, last, divide)
        if isinstance(result, Fragment):
            return result
        divided = Divided([result]) if result else divide(first, last, frozenset())
        if after == OR and whole.clauses and divided.clauses and not _both_ask(whole, divided):
            return Fragment(after, first, last)
        if whole.clauses and divided.clauses and _may_go_on(whole.clauses[-1], divided.clauses[0]):
            return Fragment(after, first, last)
        if result is not None and result.end < last:
            rest = read_all(lattice, result.end, last, divide)
            if isinstance(rest, Fragment):
                return rest
            divided = Divided([result, *rest.clauses], rest.failed)
        if divided.clauses:
            divided.clauses[0] = replace(divided.clauses[0], after=after)
        whole.clauses += divided.clauses
        if divided.failed is not None:
            whole.failed = divided.failed
            break
    return whole


def _both_ask(before: Divided, after: Divided) -> bool:
    """Whether "or" stands between questions, which are both answered; of two requests one is meant."""
    return asks(before.clauses[-1].actions) and asks(after.clauses[0].actions)


def _may_go_on(question: Clause, clause: Clause) -> bool:
    """Whether what has no verb may belong to the scenario that was supposed: "… a highway. 10 potholes"."""
    said = [each["do"] for action in question.actions for each in action.get("change", ())]
    return clause.filled.frame.verbless and not asks(clause.actions) and said[-1:] == [SCENARIO]


def _move_supposed(lattice: Lattice, start: int, end: int, divide: Divide) -> Divided | None:
    """The question about another move in the past, or about standing still for some ticks.

    Each is a frame of its own; None for another sentence.
    """
    if lattice.concepts.isdisjoint((HAD_MOVED, STANDS)):
        return None
    tried = divide(start, _before_then_what(lattice, start, end), frozenset())
    said = [value for clause in tried.clauses for value in clause.actions]
    if (
        tried.failed is not None
        or not said
        or {"move", "count"}.isdisjoint(said[0])
        or said[0].get("about") != WHAT_IF
    ):
        return None
    if said[1:] and not asks(said[1:2]):  # what is asked for next may be supposed as well
        return None
    if any(value.get("about") == WHAT_IF for value in said[1:]):
        return None
    return tried


def _before_then_what(lattice: Lattice, start: int, end: int) -> int:
    """Where a sentence ends that is followed by "what would have happened?", which says nothing more."""
    for at in range(start + 1, end):
        asked = _longest(lattice, at, THEN_WHAT)
        if (
            asked is not None
            and _past_marks(lattice, asked.end, end) >= end
            and _ends_part(lattice, at - 1, at)
        ):
            return at - 1
    return end


def _sentences(lattice: Lattice, start: int, end: int) -> list[tuple[str, int, int]]:
    """Where the sentences of a text begin and end, if one of them is a what-if question; else all as one.

    With each is the separator before it. A phrase is taught to the end of the text, full stops and all.
    """
    whole = [(PAUSE, start, end)]
    if lattice.concepts.isdisjoint((WHAT_IF, IF)):
        return whole
    begins = Beginnings(lattice, start, end)
    if begins.teaches(start):
        return whole
    found: list[tuple[str, int, int]] = []
    after, begin, conditional = PAUSE, start, begins.asks(start)
    edges = sorted(lattice.between(start, end), key=lambda each: (each.start, -each.end))
    inner = {at for edge in edges if edge.concept == THEN_PREFACE for at in range(edge.start, edge.end)}
    openers = [edge for edge in edges if edge.concept == WHAT_IF]
    inner.update(at for edge in openers for at in range(edge.start + 1, edge.end))  # "was wäre, wenn"
    for edge in edges:
        if edge.concept != SEPARATOR or edge.start < begin or edge.start in inner:
            continue
        if begins.teaches(edge.end):
            return whole
        opens = begins.asks(edge.end, begins_sentence=edge.sense.value == STOP)
        if opens or (conditional and edge.sense.value == STOP):
            if begin < edge.start:
                found.append((after, begin, edge.start))
            after, begin, conditional = str(edge.sense.value), edge.end, opens
    return [*found, (after, begin, end)] if begin < end else found


def _ends_part(lattice: Lattice, at: int, end: int) -> bool:
    """Whether nothing follows, or a separator."""
    return _past_marks(lattice, at, end) >= end or any(e.concept == SEPARATOR for e in lattice.edges[at])


def _read_subordinate(lattice: Lattice, start: int, end: int, divide: Divide) -> Clause | Fragment | None:
    """The clause of such a sentence, the part of it that nothing fits, or None for an ordinary sentence."""
    if lattice.concepts.isdisjoint(_OPENING):
        return None
    begin, start = start, _past_glue(lattice, start, end)
    if start == end:
        return None
    if (taught := _longest(lattice, start, TEACH)) is not None:
        return _taught(lattice, taught, end, divide)
    failed: Fragment | None = None
    cut: tuple[int, list[dict[str, Any]]] | None = None
    for first, last, stop in _conditions(lattice, start, end):
        if (driven := _drive_supposed(lattice, first, last)) is not None:
            supposes = _end_supposed(lattice, (first, last), (start, end))
            return Clause(begin, stop, Filled(replace(_FRAME, supposes=supposes), []), [driven])
        divided = divide(first, last, CONDITIONAL)
        beside = divided.failed or _beside_drive(lattice, divided, first, last)
        found = beside or _actions(divided, first, last, NO_CHANGE)
        if not isinstance(found, Fragment):
            of_road = any(
                value.get("parameter") in ROAD_SIZE for value in found
            )  # as it is from its beginning
            past = not of_road and _is_past(lattice, (first, last), (start, end))
            if (moved := _had_moved(lattice, (start, end), found)) is not None:
                return Clause(begin, stop, Filled(_FRAME, []), [moved])
            clause = _what_if(begin, stop, found, past=past)
            supposes = _end_supposed(lattice, (first, last), (start, end))
            return replace(clause, filled=Filled(replace(_FRAME, supposes=supposes), []))
        failed = failed or found
        if last == end and cut is None:
            cut = _before_question(divided)
            if cut is not None and (driven := _drive_supposed(lattice, first, cut[0])) is not None:
                return Clause(begin, cut[0], Filled(_FRAME, []), [driven])
    return failed if cut is None else _what_if(begin, *cut)


def _drive_supposed(lattice: Lattice, start: int, end: int) -> dict[str, Any] | None:
    """The question about a way of driving, where a condition supposes that and perhaps names a tick."""
    begins = range(start, min(_past_marks(lattice, start, end), end - 1) + 1)  # "it" may be glue as well
    found = next((edge for at in begins if (edge := _longest(lattice, at, SUPPOSED_DRIVE))), None)
    if found is None:
        return None
    said = found.sense.value
    asked = {"do": "ask", "about": WHAT_IF} | (said if isinstance(said, dict) else {"what": said})
    if found.sense.value in get_args(MomentName):  # instead of that move
        asked |= {"move": Move.FORWARD.value}
    rest = _past_marks(lattice, found.end, end)
    if rest >= end:
        return asked
    tick = _longest(lattice, rest, TICK) if found.sense.value in get_args(PolicyName) else None
    if tick is None or _past_marks(lattice, tick.end, end) < end:
        return None
    return asked | {"tick": tick.sense.value}


def _beside_drive(lattice: Lattice, divided: Divided, start: int, end: int) -> Fragment | None:
    """A way of driving that is supposed beside a change of the road: it could be read as one move of it."""
    begins = range(start, min(_past_marks(lattice, start, end), end - 1) + 1)
    found = next((edge for at in begins if (edge := _longest(lattice, at, SUPPOSED_DRIVE))), None)
    if found is None or found.sense.value not in get_args(PolicyName):
        return None
    changes = (value for clause in divided.clauses if clause.start >= found.end for value in clause.actions)
    if all(value["do"] == DRIVE for value in changes):
        return None
    return Fragment(PAUSE, found.start, found.end)


def _what_if(start: int, end: int, change: list[dict[str, Any]], *, past: bool = False) -> Clause:
    """`past`: whether it is asked of the latest decision rather than of the present."""
    asked = {"do": "ask", "about": "what_if", "change": change} | ({"ticks": 1} if past else {})
    return Clause(start, end, Filled(_FRAME, []), [asked])


def _had_moved(
    lattice: Lattice, whole: tuple[int, int], change: list[dict[str, Any]]
) -> dict[str, Any] | None:
    """The question about another move in the past, where one is supposed to have been made."""
    if len(change) != 1 or change[0].keys() != {"do", "move"} or change[0]["do"] != DRIVE:
        return None
    if all(edge.concept != HAD_MOVED for edge in lattice.between(*whole)):
        return None
    return {"do": "ask", "about": WHAT_IF, "move": change[0]["move"]}


def _end_supposed(lattice: Lattice, supposed: tuple[int, int], whole: tuple[int, int]) -> str | None:
    """How the question beside what is supposed takes it to end; None where it asks what happens."""
    asked = (_longest(lattice, at, THEN_WHAT) for at in range(*whole) if not supposed[0] <= at < supposed[1])
    return next((str(edge.sense.value) for edge in asked if edge is not None and edge.sense.value), None)


def _is_past(lattice: Lattice, supposed: tuple[int, int], whole: tuple[int, int]) -> bool:
    """Whether what is supposed is of a past moment; without a verb of its own, the question tells."""
    if any(edge.concept == HAD_BEEN for edge in lattice.between(*supposed)):
        return True
    verbless = any(edge.sense == Sense(IF, WITHOUT) for edge in lattice.edges[supposed[0]])
    return verbless and any(edge.concept == WOULD_HAVE for edge in lattice.between(*whole))


def _before_question(divided: Divided) -> tuple[int, list[dict[str, Any]]] | None:
    """Where a question after a condition begins, which is a sentence of its own, and the condition."""
    for at, clause in enumerate(divided.clauses):
        if at and asks(clause.actions):
            found = _actions(Divided(divided.clauses[:at]), clause.start, clause.end, NO_CHANGE)
            return None if isinstance(found, Fragment) else (clause.start, found)
    return None


def _past_glue(lattice: Lattice, at: int, end: int) -> int:
    """The first token from `at` that is neither glue nor a separator."""
    while at < end:
        if any(_longest(lattice, at, concept) for concept in (WHAT_IF, IF, TEACH)):
            return at
        asked = _longest(lattice, at, THEN_WHAT)
        if asked is not None and _opening_after(lattice, asked.end, end) is not None:
            return at
        passed = [edge.end for edge in lattice.edges[at] if edge.sense.concept in (GLUE, SEPARATOR)]
        if not passed:
            return at
        at = max(passed)
    return at


def _longest(lattice: Lattice, at: int, concept: str) -> Edge | None:
    """The longest edge with this concept that starts at a token."""
    found = [edge for edge in lattice.edges[at] if edge.sense.concept == concept]
    return max(found, key=lambda edge: edge.end, default=None)


def _conditions(lattice: Lattice, start: int, end: int) -> Iterator[tuple[int, int, int]]:
    """Where the condition of a what-if question may be, and where the question ends.

    The question itself may stand at either end.
    """
    opened = sorted(
        (e for e in lattice.edges[start] if e.sense.concept in (WHAT_IF, IF)), key=lambda e: -e.end
    )
    for edge in lattice.edges[start]:
        if edge.sense.concept == THEN_WHAT:
            opening = _opening_after(lattice, edge.end, end)
            if opening is not None and (opening.end < end or opening.sense.value == WITHOUT):
                yield _supposed_from(opening), end, end
    for edge in opened:
        if edge.sense.concept == WHAT_IF and edge.end < end:
            yield edge.end, end, end
        for at in range(edge.end + 1, end):
            asked = _longest(lattice, at, THEN_WHAT)
            if asked is None:
                continue
            if _past_marks(lattice, asked.end, end) >= end:
                yield _supposed_from(edge), at, end
            elif _ends_part(lattice, asked.end, end):
                yield _supposed_from(edge), at, asked.end


def _opening_after(lattice: Lattice, at: int, end: int) -> Edge | None:
    """The word for "if" after a question: one that says something itself comes first, "with" may be glue."""
    past = _past_marks(lattice, at, end)
    for begin in range(at, min(past, end - 1)):
        opening = _longest(lattice, begin, IF)
        if opening is not None and opening.sense.value == WITHOUT:
            return opening
    return _longest(lattice, past, IF) if past < end else None


def _supposed_from(opening: Edge) -> int:
    """Where what is supposed begins: after the word for "if", or with it where it says something itself."""
    return opening.start if opening.sense.value == WITHOUT else opening.end


def _past_marks(lattice: Lattice, at: int, end: int) -> int:
    """The first token from `at` that is neither glue nor a separator."""
    while at < end:
        passed = [edge.end for edge in lattice.edges[at] if edge.sense.concept in (GLUE, SEPARATOR)]
        if not passed:
            return at
        at = max(passed)
    return at


def _actions(
    divided: Divided, start: int, end: int, never: frozenset[str]
) -> list[dict[str, Any]] | Fragment:
    """The actions of clauses; what does not fit where one of them has none, or one of `never`.

    A clause without an action is one that forbids: "it never turned left" cannot be supposed beside a change.
    """
    values = [value for clause in divided.clauses for value in clause.actions]
    if values and (unsaid := next((clause for clause in divided.clauses if not clause.actions), None)):
        return Fragment(unsaid.after, unsaid.start, unsaid.end)
    asks = any(clause.filled.frame.ask or clause.instead for clause in divided.clauses)
    if asks or not values or any(value["do"] in never for value in values):
        return Fragment("pause", start, max(end, start + 1))
    turned = [value for clause in divided.clauses[1:] if clause.after == BUT for value in clause.actions]
    if never is NO_CHANGE and any(value["do"] in GOES_BACK for value in turned):
        return Fragment("pause", start, max(end, start + 1))
    return values


def _taught(lattice: Lattice, opened: Edge, end: int, divide: Divide) -> Clause | Fragment | None:
    """ "when I say <phrase>, I mean <actions>"."""
    if opened.end >= end:
        return None
    name = _longest(lattice, opened.end, NAME)
    if name is None:
        return None
    at = name.end
    while at < end and _longest(lattice, at, MEANS) is None:
        at += 1
    means = _longest(lattice, at, MEANS) if at < end else None
    if means is None or means.end >= end:
        return None
    meaning = read_all(lattice, means.end, end, divide)
    if isinstance(meaning, Fragment) or meaning.failed is not None:
        return meaning if isinstance(meaning, Fragment) else meaning.failed
    found = _actions(meaning, means.end, end, TEACHING)
    if isinstance(found, Fragment):
        return found
    taught = {"do": "teach", "phrase": str(name.sense.value), "meaning": found}
    return Clause(0, lattice.size, Filled(_FRAME, []), [taught])
