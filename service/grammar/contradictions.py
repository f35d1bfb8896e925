"""Finds parts of an utterance that cannot both hold: "make it sunny and rainy", "five cones, no cones".

What is said in order ("pause, then resume") is done in order, and so is all between which time passes. Two
values for one setting without that are asked about; where something is left out that another part
would do all the same, the whole is refused.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from service.actions.table import verbs_where
from service.grammar.clause import Clause
from service.grammar.lattice import Lattice
from service.grammar.noun_phrases import Amount

_IN_ORDER = "then"
"""Separator that says that one comes after the other."""

_PASSING = verbs_where(lambda traits: traits.separates_settings)
"""Actions after which a setting may well be another: time has passed, or something was told or kept."""

_AND = "and"

SIMULTANEOUS = "simultaneous"
"""Concept of words that say that two things are done together: "at the same time"."""

_MOVING = ("drive", "step", "pause", "resume", "rewind", "reset")
"""Actions of which there is one at a time."""

_COUNTED = ("counted", ".exact", ".more", ".post")
"""Ends of the concepts of amounts that are a number."""

_OF_THINGS = "thing."
"""What the concepts of amounts of things begin with; "lane 2" is an amount of lanes."""

_NONE = "thing.none"
_SETTING = "param"
_FEWER = ("thing.fewer", "thing.fewer_bare")
"""Amounts taken away from what is there; a road that is new has nothing yet."""
_EVERYTHING = "everything"

_LOSING = verbs_where(lambda traits: traits.loses)
"""Actions by which something on the road may be lost."""

_PLACES = frozenset(("place", "side", "length", "nearest"))


@dataclass(frozen=True, slots=True)
class Contradiction:
    """What cannot both hold: the clauses, and the utterance with each of the values alone, if that helps."""

    clauses: tuple[Clause, ...]
    alternatives: tuple[list[dict[str, Any]], ...] = ()


def contradiction(clauses: Sequence[Clause], lattice: Lattice) -> Contradiction | None:
    """The first contradiction of an utterance, if there is one."""
    if (both := _at_once(clauses, lattice)) is not None or len(clauses) < 2:
        return both
    return (
        _settings(clauses)
        or _switches(clauses)
        or _left_out(clauses, lattice)
        or _none_of(clauses)
        or _fewer(clauses)
    )


def _at_once(clauses: Sequence[Clause], lattice: Lattice) -> Contradiction | None:
    """Several moves that are said to be made at the same time; the vehicle makes one after the other."""
    if SIMULTANEOUS not in lattice.concepts or any(clause.after == _IN_ORDER for clause in clauses[1:]):
        return None
    moves = [action["do"] in _MOVING for clause in clauses for action in clause.actions]
    return Contradiction(tuple(clauses)) if sum(moves) > 1 else None


def _settings(clauses: Sequence[Clause]) -> Contradiction | None:
    """Two values of one setting, neither said to come after the other."""
    held: dict[object, dict[str, list[Clause]]] = {}
    for clause in clauses:
        if clause.after == _IN_ORDER or any(action["do"] in _PASSING for action in clause.actions):
            if (found := _several(clauses, held)) is not None:
                return found
            held.clear()
        for action in clause.actions:
            if (said := _setting(action)) is not None:
                held.setdefault(said[0], {}).setdefault(repr(said[1]), []).append(clause)
    return _several(clauses, held)


def _several(
    clauses: Sequence[Clause], held: Mapping[object, Mapping[str, Sequence[Clause]]]
) -> Contradiction | None:
    """The first setting that was given several values."""
    return next((_between(clauses, about, values) for about, values in held.items() if len(values) > 1), None)


def _switches(clauses: Sequence[Clause]) -> Contradiction | None:
    """The two sides of one switch with nothing but "and" between them; apart they are done in order."""
    for before, clause in pairwise(clauses):
        if clause.after != _AND or not (before.actions and clause.actions):
            continue
        one, other = _switch(before.actions[-1]), _switch(clause.actions[0])
        if one is not None and other is not None and one[0] == other[0] and one[1] != other[1]:
            return _between(clauses, one[0], {repr(one[1]): [before], repr(other[1]): [clause]})
    return None


def _between(
    clauses: Sequence[Clause], about: object, values: Mapping[str, Sequence[Clause]]
) -> Contradiction:
    """Which of several values of a setting: the utterance with each of them alone."""
    sayers = tuple(each for saying in values.values() for each in saying)
    return Contradiction(sayers, tuple(_with(clauses, about, value) for value in values))


def _with(clauses: Sequence[Clause], about: object, value: str) -> list[dict[str, Any]]:
    """All actions of an utterance, of those about one setting only those with one value."""
    kept = []
    for action in (action for clause in clauses for action in clause.actions):
        said = _setting(action) or _switch(action)
        if said is None or said[0] != about or repr(said[1]) == value:
            kept.append(action)
    return kept


def _setting(action: Mapping[str, Any]) -> tuple[object, object] | None:
    """What an action sets, and to which value; None where several may well be done."""
    match action["do"]:
        case "set":
            return ("set", action["parameter"]), action["value"]
        case "adjust" if "direction" in action:
            return ("adjust", action["parameter"]), action["direction"]
        case "set_count":
            return ("count", action["kind"]), action["count"]
        case "scenario":
            return "scenario", action
    return None


def _switch(action: Mapping[str, Any]) -> tuple[object, object] | None:
    """What an action switches, and to which side."""
    match action["do"]:
        case "pause" | "resume":
            return "clock", action["do"]
        case "show" | "hide":
            return ("view", action["view"]), action["do"]
        case "mode":
            return "mode", action["mode"]
        case "record":
            return "record", action["on"]
    return None


def _left_out(clauses: Sequence[Clause], lattice: Lattice) -> Contradiction | None:
    """A part that says what not to do, where another would do it all the same."""
    for at, clause in enumerate(clauses):
        if not clause.negated:
            continue
        for other in clauses:
            if _does_it_all_the_same(other, clause) or _sets_the_same(other, clause):
                return Contradiction((other, clause))
        if _says_how_many(clause, lattice):
            continue
        frame, slots = clause.filled.frame, clause.filled.slots
        if not at and all(edge.concept == _NONE for edge in slots):
            for other in clauses[1:]:  # "without cars, stop": a condition, or none shall be there
                if other.actions and not any(_is_of_things(action) for action in other.actions):
                    return Contradiction((other, clause))
        verbs = {str(template["do"]) for template in frame.actions if isinstance(template, dict)}
        verb = "add" if frame.leaves_out else min(verbs, default="")
        kinds = {edge.sense.value.of for edge in slots if isinstance(edge.sense.value, Amount)}
        untouched = frame.only_negated or (frame.leaves_out and all(e.concept != _NONE for e in slots))
        placed = any(edge.concept in _PLACES for edge in slots)
        for place, other in enumerate(clauses):
            if untouched and kinds:
                if any(_touches(action, kinds) for action in other.actions):
                    return Contradiction((other, clause))
                continue
            if any(
                action["do"] == verb
                and action.get("kind") in kinds
                and (verb == "add" or action.get("count") == "all")
                and ("where" not in action if placed else place < at)
                for action in other.actions
            ):
                return Contradiction((other, clause))
    return None


def _does_it_all_the_same(clause: Clause, forbidding: Clause) -> bool:
    """Whether a request does the very same that another part forbids."""
    return any(action in forbidding.forbids and "count" not in action for action in clause.actions)


def _sets_the_same(clause: Clause, forbidding: Clause) -> bool:
    """Whether a request is about a setting that is only named in another part: "…, the sensor noise not"."""
    if not forbidding.filled.frame.only_negated:
        return False
    named = {edge.sense.value for edge in forbidding.filled.slots if edge.concept == _SETTING}
    return any(action.get("parameter") in named for action in clause.actions)


def _touches(action: Mapping[str, Any], kinds: Set[object]) -> bool:
    """Whether an action does something to things of some kinds, or may do it to anything."""
    told = [action, *(each for each in action.values() if isinstance(each, Mapping))]
    said = {each["kind"] for each in told if "kind" in each}
    return bool(said & (kinds | {_EVERYTHING})) or (not said and action["do"] in _LOSING)


def _is_of_things(action: Mapping[str, Any]) -> bool:
    """Whether an action is about things on the road, of which some may be left out."""
    return "kind" in action or action["do"] in ("scenario", "evaluate")


def _none_of(clauses: Sequence[Clause]) -> Contradiction | None:
    """ "five potholes and no cars": without a verb of adding, it may be that no cars shall be there."""
    for before, clause in pairwise(clauses):
        if not clause.filled.frame.leaves_out or not before.actions:
            continue
        adding = before.filled.frame.inherits
        if any(edge.concept in adding and edge.concept.startswith("v.") for edge in before.filled.slots):
            continue
        said = [action for each in clauses for action in each.actions]
        kinds = dict.fromkeys(edge.sense.value.of for edge in clause.filled.slots if edge.concept == _NONE)
        if not kinds:  # "and keep the cones"
            continue
        none = [{"do": "set_count", "kind": kind, "count": 0} for kind in kinds]
        return Contradiction((before, clause), ([*said, *none], said))
    return None


def _fewer(clauses: Sequence[Clause]) -> Contradiction | None:
    """ "A new highway, two cars less": fewer than there are on a road that is not yet there."""
    for before, clause in pairwise(clauses):
        builds = any(action["do"] == "scenario" for action in before.actions)
        if builds and clause.after != _IN_ORDER and any(e.concept in _FEWER for e in clause.filled.slots):
            return Contradiction((before, clause))
    return None


def _says_how_many(clause: Clause, lattice: Lattice) -> bool:
    """Whether it names an amount: it may be only that which is not meant ("three, not five")."""
    said = [e for e in lattice.between(clause.start, clause.end) if e.concept.startswith(_OF_THINGS)]
    return not said or any(edge.concept.endswith(_COUNTED) for edge in said)
