"""Builds the actions of a filled frame, as JSON values.

Templates come from the data: `$thing.count` is a value said, `$where` the place made of all its parts,
`$amount` the number in the unit of the parameter it is for. A key whose value was not said is left out.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from service.actions import Ask
from service.grammar.frames import Filled
from service.grammar.lattice import Edge
from service.grammar.lexicon import Sense
from service.grammar.noun_phrases import Amount
from service.grammar.repetition import MAX_REPEATED
from sim.types import Kind, ego_id, is_ego, kind_of

_ABSENT = object()
_MEASURES = ("number", "length", "speed", "seconds", "fraction", "times", "cells")
_SETTINGS = frozenset(("weather", "time_of_day", "traffic", "planner", "sensor", "dynamics"))
"""Of these one value holds; a second in the same breath would be said instead of the first."""
_CONDITIONS = ("weather", "time_of_day", "road", "layout", "traffic", "sensor", "thing")
"""What an evaluation is run under, beside the planners."""
_EXCLUSIVE = (
    {"cell", "lane"},
    {"cell", "row"},
    {"cells", "distance_m"},
    {"nearest", "cell"},
    {"nearest", "lane"},
    {"nearest", "lanes"},
    {"nearest", "rows"},
    {"nearest", "of"},
    {"lanes", "lane"},
    {"lanes", "cell"},
    {"rows", "row"},
    {"rows", "cell"},
    {"each", "lane"},
    {"each", "cell"},
    {"each", "nearest"},
)


class CannotBuild(Exception):  # noqa: N818 - not an error of the program: the frame does not fit
    """The items fill the frame, but contradict each other or do not fit its values."""


@dataclass(frozen=True, slots=True)
class Parameters:
    """What kinds of amount each numeric parameter takes, from `parameters.yaml`."""

    takes: Mapping[str, Sequence[str]]
    vague: int = 0
    """What "a few" counts as."""

    def fits(self, parameter: str, dimension: str) -> bool:
        """Whether an amount in this dimension can be a value of the parameter."""
        return dimension in self.takes.get(parameter, ())


def merge_places(parts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """One place of several parts. Raises `CannotBuild` where they contradict each other."""
    where: dict[str, Any] = {}
    for part in parts:
        for key, value in part.items():
            if where.get(key, value) != value:
                raise CannotBuild("two places")
            where[key] = value
    if any(pair <= where.keys() for pair in _EXCLUSIVE):
        raise CannotBuild("a place said twice over")
    return where | {key: sorted(where[key]) for key in ("lanes", "rows") if key in where}


def build(filled: Filled, parameters: Parameters) -> list[dict[str, Any]]:
    """The actions of a filled frame, in the order their things were said. Raises `CannotBuild`."""
    frame = filled.frame
    if any(not _fits(filled, path, values) for path, values in frame.only.items()):
        raise CannotBuild("a value the frame is not for")
    maker = _Maker(filled, parameters)
    supposed(filled)  # a place that is none is no place to ask about either
    if not frame.per:
        return [made for template in frame.actions for made in maker.actions(template)]
    turns = filled.of(*frame.per)
    if frame.last:
        turns = list({edge.concept: edge for edge in turns}.values())
    elif any(a.concept == b.concept and a.concept in _SETTINGS for a, b in combinations(turns, 2)):
        raise CannotBuild("two values for one setting")
    if len(turns) > 1 and maker.where() is not None:
        raise CannotBuild("one place for several things")
    return [maker.action(template, turn) for turn in turns for template in frame.actions]


def supposed(filled: Filled) -> str | None:
    """What a filled frame takes for granted, with what was said in the place of each "$concept".

    "$where" is the place as JSON. What was not said is left out. Raises `CannotBuild` for what is no place.
    """
    template = filled.frame.supposes
    if template is None or "$" not in template:
        return template
    words: list[str] = []
    for word in template.split():
        if word == "$where":
            where = _place_asked_about(filled)
            words += [json.dumps(where)] if where else []
        elif word.startswith("$"):
            words += [_said(edge.sense.value) for edge in filled.of(word[1:])[:1]]
        else:
            words.append(word)
    return " ".join(words) or None


def _said(value: Any) -> str:
    return json.dumps(value) if isinstance(value, dict) else str(value)


def _place_asked_about(filled: Filled) -> dict[str, Any]:
    """The place that was said; of sides all, since what is ahead may be on the left as well."""
    sides = [str(edge.sense.value) for edge in filled.of("side") if not isinstance(edge.sense.value, dict)]
    rest = [
        edge for edge in filled.slots if edge.sense.concept != "side" or isinstance(edge.sense.value, dict)
    ]
    where = _Maker(Filled(filled.frame, rest), Parameters({})).where() or {}
    if where.keys() & {"of", "id"}:
        raise CannotBuild("a place seen from another thing, of which nothing is told")
    return where | ({"sides": sorted(set(sides))} if sides else {})


def _fits(filled: Filled, path: str, values: Sequence[Any]) -> bool:
    """Whether what was said of a concept is among these values; what was not said is no matter."""
    concept, _, attribute = path.partition(".")
    said = (edge.sense.value for edge in filled.of(concept))
    return all((getattr(value, attribute) if attribute else value) in values for value in said)


def _ids(edge: Edge) -> tuple[str, ...]:
    return edge.sense.value.ids if isinstance(edge.sense.value, Amount) else ()


SOME = "thing.bare_many"
"""Concept of things without a number; on a new road these are a few: "a road with pedestrians"."""

WHOLE = "whole"
"""The value of words for the whole road ("all over the road"); beside them there is no place on it."""

RAISING, LOWERING = "v.up", "v.down"
"""Concepts of verbs that say which way an amount goes."""

THING = "thing"
"""Beginning of the concepts of things; an action is about one, unless a frame makes one for each."""

REMOVING = "v.remove"
"""Concept of verbs of taking away; one with a kind as its value takes away nothing else: "patch" potholes."""


class _Maker:
    """Fills the templates of one frame."""

    def __init__(self, filled: Filled, parameters: Parameters) -> None:
        self._filled = filled
        self._parameters = parameters

    def actions(self, template: Mapping[str, Any] | str) -> list[dict[str, Any]]:
        """One action; those of a slot that is actions itself; or one for each thing that is named by id."""
        if isinstance(template, str):
            whole: list[dict[str, Any]] = self._slot(template.removeprefix("$"), None)
            return whole
        pointed = [edge for edge in self._filled.of("meant", "all_others") if len(edge.sense.value) > 1]
        if "$first" in template.values():
            return [self.action(template, None)]  # one action about two things
        if pointed:
            things = [(edge, thing) for edge in pointed for thing in edge.sense.value]
            each = [edge._replace(sense=edge.sense._replace(value=(thing,))) for edge, thing in things]
            return [self.action(template, turn) for turn in each]
        named = [name for edge in self._filled.slots for name in _ids(edge)]
        if not named:
            return [self.action(template, None)]
        turns = [Edge(0, 0, Sense("thing.id", Amount(kind_of(name), 1, (name,)))) for name in named]
        return [self.action(template, turn) for turn in turns]

    def action(self, template: Mapping[str, Any], turn: Edge | None) -> dict[str, Any]:
        """One action; `turn` is the slot it is about when a frame makes one for each."""
        value = self._value(template, turn)
        if not isinstance(value, dict):
            raise CannotBuild("an action must be a mapping")
        if self._is_turned_round(value):
            raise CannotBuild("the verb and its amount or its thing do not go together")
        about = value.get("parameter")
        if about in self._parameters.takes and any(e.sense.value != about for e in self._filled.of("param")):
            raise CannotBuild("another setting was named")
        return value

    def _is_turned_round(self, action: Mapping[str, Any]) -> bool:
        """Whether a verb says another thing than the action does: "lower it to twice", "patch the cars"."""
        verbs = {edge.concept: edge.sense.value for edge in self._filled.slots}
        only = verbs.get(REMOVING)
        if isinstance(only, str) and action.get("kind", only) != only:
            return True
        if action["do"] != "adjust":
            return False
        grows = action.get("factor", 1) > 1 or action.get("by", 0) > 0
        shrinks = action.get("factor", 1) < 1 or action.get("by", 0) < 0
        return (grows and LOWERING in verbs) or (shrinks and RAISING in verbs)

    def _value(self, template: Any, turn: Edge | None) -> Any:
        if isinstance(template, str) and template.startswith("$"):
            return self._slot(template[1:], turn)
        if isinstance(template, Mapping):
            pairs = {key: self._value(part, turn) for key, part in template.items()}
            merged: dict[str, Any] = {}
            for key, part in pairs.items():
                if key == "parts":
                    merged.update(part)
                elif part is not _ABSENT:
                    merged[key] = part
            return merged
        if isinstance(template, list):
            return [part for part in (self._value(t, turn) for t in template) if part is not _ABSENT]
        return template

    def _slot(self, path: str, turn: Edge | None) -> Any:
        name, _, attribute = path.partition(".")
        match name:
            case "where":
                where = self.where()
                return _ABSENT if where is None else where
            case "amount":
                return self._amount()
            case "down_amount":
                return -self._amount()
            case "down_speed":
                return -self._slot("speed", None)
            case "share" | "more_part" | "less_part" | "more_percent" | "less_percent":
                return self._relative(name)
            case "parts":
                return self.parts()
            case "moves":
                return self._moves()
            case "settings":
                return self._settings()
            case "planners":
                return self._planners(attribute) or _ABSENT
            case "eval_scenario":
                return self.evaluated()[0] or _ABSENT
            case "eval_vary":
                return self.evaluated()[1] or _ABSENT
            case "asked_move":
                return self._asked_move()
            case "steps_or_one":
                steps = [edge.sense.value for edge in self._filled.of("steps")]
                return next((count for count in steps if count is not None), 1)
            case "first" | "second":
                return self._one_of_two(name)
            case "which":
                return self._which(turn)
            case "which_thing":
                return self._which(turn, of_any_kind=True)
            case "past":
                return self._counted()
            case "becomes":
                return self._becomes()
            case "ego_named":
                return self._ego()
            case "less":
                return -self._slot(f"{attribute}.count", None)
            case "concept" if turn:
                return turn.concept
            case "each" if turn:
                return turn.sense.value
        slots = [turn] if turn and turn.concept.partition(".")[0] == name else self._filled.of(name)
        if not slots:
            return _ABSENT
        if len(slots) > 1 and (
            name == THING or len({repr(edge.sense.value) for edge in slots}) > 1
        ):  # "the pothole nearest to the pothole" is about two
            raise CannotBuild(f"two values for {name}")
        value = slots[0].sense.value
        if name in ("meant", "all_others"):
            value = getattr(value[0], attribute)
            return _ABSENT if value is None else value
        if isinstance(value, Amount):
            if attribute == "several" and value.count in (0, 1):
                raise CannotBuild("one thing is no number of them")
            if isinstance(value.count, float) and not value.count.is_integer():
                raise CannotBuild("no part of a thing")
            told = {"of": value.of, "count": value.count, "id": "".join(value.ids[:1])}
            return told["count" if attribute in ("", "several") else attribute]
        return value[attribute] if attribute else value

    def _one_of_two(self, which: str) -> dict[str, Any]:
        """One of two things that change places, in the order said."""
        said = sorted(self._filled.of("meant"), key=lambda edge: edge.start)
        things = [thing for edge in said for thing in edge.sense.value]
        if len(things) != 2 or any(thing.count != 1 for thing in things):
            raise CannotBuild("not two things")
        thing = things[0 if which == "first" else 1]
        where = {} if thing.where is None else {"where": thing.where}
        return {"kind": thing.kind, **where}

    def _which(self, turn: Edge | None, *, of_any_kind: bool = False) -> dict[str, Any]:
        """The road user that is asked about; a car without a place or an id would be the vehicle itself.

        `of_any_kind`: or what stands on the road.
        """
        edges = [turn] if turn is not None else self._filled.of("thing")
        if len(edges) != 1 or not isinstance(edges[0].sense.value, Amount):
            raise CannotBuild("not one road user")
        amount, form = edges[0].sense.value, edges[0].concept.partition(".")[2]
        if amount.ids:
            return {"id": amount.ids[0]}
        kind, where = amount.of, self.where() or {}
        fixed = Kind(kind).fixed
        if (fixed and not of_any_kind) or amount.count not in (None, 1):
            raise CannotBuild("what does not move, or several")
        if form in ("that", "nearest") and not where:
            where = {"nearest": True}
        if not where and (form != "the_one" or not (fixed or Kind(kind) is Kind.PEDESTRIAN)):
            raise CannotBuild("no one in particular")
        return {"kind": kind, **where}

    def _counted(self) -> dict[str, Any]:
        """What is counted over a drive, with all conditions that were said."""
        told: dict[str, Any] = {}
        for edge in self._filled.of("past", THING):
            value = edge.sense.value
            said = {"kind": value.of} if isinstance(value, Amount) else value
            for key, each in said.items() if isinstance(said, dict) else ():
                if told.setdefault(key, each) != each:
                    raise CannotBuild(f"two values for {key}")
        things, given = self._filled.of(THING), {edge.concept for edge in self._filled.slots}
        if any(edge.sense.value.count not in (None, 1, "all") for edge in things):
            raise CannotBuild("things are a reason whatever their number")
        if bool(things) is not bool(given & {"past.for", "past.hit"}):
            raise CannotBuild("a reason without a thing")
        if told.get("what") == "ended" and "past.episode" in given:
            raise CannotBuild("ends are those of the session")
        try:
            Ask(about="history", **{"what": self._filled.frame.actions[0].get("what"), **told})
        except ValueError as error:
            raise CannotBuild(str(error)) from None
        return told

    def _ego(self) -> str:
        """The id of the ego that is named, by its id or its number in order."""
        (edge,) = self._filled.of("ego_named")
        named = edge.sense.value
        name = str(named["id"]) if "id" in named else ego_id(named["number"] - 1)
        if not is_ego(name):
            raise CannotBuild(f"{name} is no ego")
        return name

    def _becomes(self) -> str:
        """The kind that things become; "a cone" is what one becomes, "cones" what many become."""
        things = [thing for edge in self._filled.of("meant") for thing in edge.sense.value]
        (edge,) = self._filled.of("becomes")
        if (len(things) != 1 or things[0].count != 1) not in edge.sense.value.many:
            raise CannotBuild("one becomes one, many become many")
        return str(edge.sense.value.kind)

    def _moves(self) -> list[dict[str, Any]]:
        """A move as often as it was said to be made, each time as an action."""
        moves = self._filled.of("dir", "dir_bare", "stay_word")
        (times,) = self._filled.of("made_times")
        if len(moves) != 1 or not 1 <= times.sense.value <= MAX_REPEATED:
            raise CannotBuild("not one move, or too often")
        (edge,) = moves
        move = "stay" if edge.concept == "stay_word" else edge.sense.value
        return [{"do": "drive", "move": move}] * times.sense.value

    def _settings(self) -> list[dict[str, Any]]:
        """The settings that were said, in order, each as an action that sets it."""
        said = sorted(self._filled.of(*_SETTINGS), key=lambda edge: edge.start)
        if len({edge.concept for edge in said}) < len(said):
            raise CannotBuild("two values for one setting")
        return [{"do": "set", "parameter": edge.concept, "value": edge.sense.value} for edge in said]

    def _planners(self, attribute: str) -> list[Any]:
        """The planners in the order said; as `pair` or `reversed` there must be two of them."""
        planners = [edge.sense.value for edge in self._filled.of("planner")]
        if attribute and len(planners) != 2:
            raise CannotBuild("not two planners")
        return planners[::-1] if attribute == "reversed" else planners

    def where(self) -> dict[str, Any] | None:
        """The place, of all its parts; parts that contradict each other are no place."""
        where: dict[str, Any] = {}
        everywhere = any(edge.sense.value == WHOLE for edge in self._filled.of("random"))
        for edge in self._filled.of("place", "side", "nearest"):
            value = edge.sense.value
            where = merge_places([where, value if isinstance(value, dict) else {"side": value}])
        for edge in self._filled.of("length"):
            if "distance_m" in where:
                raise CannotBuild("two distances")
            where["distance_m"] = edge.sense.value
        for edge in self._filled.of("cells"):
            if "cells" in where:
                raise CannotBuild("two distances")
            where["cells"] = edge.sense.value.count
        if everywhere and where:
            raise CannotBuild("the whole road, and a place on it")
        return merge_places([where]) or None

    def _amount(self) -> int | float:
        """The one number said, in a unit its parameter takes."""
        parameter = self._slot("param", None)
        amounts = self._filled.of(*_MEASURES)
        if len(amounts) != 1:
            raise CannotBuild("not one amount")
        sense = amounts[0].sense
        if not self._parameters.fits(str(parameter), sense.concept.partition(".")[0]):
            raise CannotBuild(f"{parameter} is no {sense.concept}")
        if isinstance(sense.value, Amount):
            return sense.value.count or 0
        value: int | float = round(sense.value / 100, 9) if sense.concept == "fraction" else sense.value
        return value

    def _relative(self, name: str) -> float:
        """A part of something, as a value of its own or as a change of the value there is.

        A percentage of what is itself a share is no change in proportion: 10 % more is 0.1 more.
        """
        parameter = str(self._slot("param", None))
        is_share = self._parameters.fits(parameter, "fraction")
        part: float = self._slot("fraction", None) / 100 if "percent" in name else self._slot("part_of", None)
        if name == "share":
            if not (is_share or self._parameters.fits(parameter, "seconds")):
                raise CannotBuild(f"{parameter} is no share")
            return part
        if "percent" in name and is_share:
            raise CannotBuild(f"{parameter} is a share")
        return round(1 + part if name.startswith("more") else 1 - part, 9)

    def _asked_move(self) -> Any:
        """The move a question is about: a direction, or staying; absent when none was named."""
        moves = [edge.sense.value for edge in self._filled.of("dir")]
        moves += ["stay" for _ in self._filled.of("stay_word")]
        if len(set(moves)) > 1:
            raise CannotBuild("two moves")
        return moves[0] if moves else _ABSENT

    def evaluated(self) -> tuple[dict[str, Any], dict[str, list[Any]]]:
        """The conditions of an evaluation: those that hold for all runs, and those that are compared."""
        said: dict[str, list[Any]] = {}
        for edge in self._filled.of(*_CONDITIONS):
            key, value = edge.concept, edge.sense.value
            if isinstance(value, Amount):
                key, value = f"{value.of}s", value.count
            if value in said.setdefault(key, []):
                raise CannotBuild(f"{key} said twice")
            said[key].append(value)
        several = {key: values for key, values in said.items() if len(values) > 1}
        if several.keys() & {"road", "layout"}:
            raise CannotBuild("two kinds of road")
        return {key: values[0] for key, values in said.items() if len(values) == 1}, several

    def parts(self, without: tuple[str, ...] = ()) -> dict[str, Any]:
        """The keys of a scenario, from everything said that is one."""
        parts: dict[str, Any] = {}
        for edge in self._filled.of(
            "weather", "time_of_day", "road", "layout", "traffic", "planner", "sensor", "thing"
        ):
            key, value = edge.concept, edge.sense.value
            if key in without:
                continue
            if isinstance(value, Amount):
                some = self._parameters.vague if edge.concept == SOME else value.count
                key, value = f"{value.of}s", some
            if parts.get(key, value) != value:
                raise CannotBuild(f"two values for {key}")
            if key in parts:
                raise CannotBuild(f"{key} said twice")
            parts[key] = value
        return parts
