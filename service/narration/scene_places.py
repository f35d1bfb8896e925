"""What is seen at a place: in a lane, in some rows, within a distance; and which lanes are free."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

from service.narration.answer_length import Part, within
from service.narration.scene_asked import SceneAsked, Wanted
from service.narration.scene_told import SceneTold, distance
from sim.explain.scene import Detection, Scene
from sim.state import SimState
from sim.types import Kind

Holds = Callable[[Detection], bool]
BESIDE: Final = {"left": -1, "own": 0, "right": 1}
"""Lanes by their names: how many to the right of the ego's."""
_SIDES: Final[Mapping[str, Holds]] = {
    "ahead": lambda thing: thing.rows > 0,
    "behind": lambda thing: thing.rows < 0,
    "left": lambda thing: thing.lanes < 0,
    "right": lambda thing: thing.lanes > 0,
    "beside": lambda thing: thing.lanes != 0 and thing.rows == 0,
}
_MOST_NEAREST: Final = 3
"""Of the nearest, where several are asked for."""
_STRETCH: Final = 3
"""Rows of a stretch in which things are counted for where they stand densest."""
_MOST_ROWS: Final = 5
"""Rows that are named where things of a kind stand."""


class ScenePlaces:
    """The answers about places in one scene."""

    def __init__(self, told: SceneTold, scene: Scene, run: SimState) -> None:
        """`told`: words for the scene; `run`: its moment."""
        self._told = told
        self._say = told.say
        self._scene = scene
        self._columns = run.world.road.columns
        self._cell_m = run.config.cell_m
        self._own = scene.cell[0] + 1

    def answer(self, about: SceneAsked, kind: Kind | None) -> tuple[Scene, str]:
        """What is there of the scene, and the answer."""
        if about.more_on is not None:
            return self._scene, self._sides_compared(kind, about.more_on)
        if about.lanes is not None:
            return self._scene, self._lanes(about.lanes, kind)
        if about.row is not None:
            return self._row(about.row, kind, about.wanted)
        if about.place.get("nearest"):
            return self._nearest(kind, many="number" in about.words)
        lane = self._lane(about)
        if lane is not None and not 1 <= lane <= self._columns:
            return replace(self._scene, seen=()), self._say("lane_none", lane=lane, columns=self._columns)
        things = [thing for thing in self._scene.of(kind) if self._holds(about, lane, thing)]
        things.sort(key=lambda thing: (thing.rows < 0, distance(thing)))
        there = replace(self._scene, seen=tuple(things))
        if lane is not None and kind is None and about.wanted in ("free", "taken"):
            return there, self._free(lane, things, agrees=about.wanted == "free")
        return there, self._listed(things, kind, about.wanted, self._named(about, lane))

    def _lane(self, about: SceneAsked) -> int | None:
        """The lane that is meant, from 1 at the left; it may be off the road."""
        if about.lane is not None:
            return self._own + BESIDE[about.lane]
        lane, side = about.place.get("lane"), _side_of_lane(about.place)
        if side is not None:
            return self._own + BESIDE[side] * int(about.place["cells"])
        named = {"left": 1, "middle": (self._columns + 1) // 2, "right": self._columns}
        return None if lane is None else named.get(lane, lane)

    def _holds(self, about: SceneAsked, lane: int | None, thing: Detection) -> bool:
        """Whether a thing is at the place."""
        place, (column, row) = about.place, (self._own + thing.lanes, self._scene.cell[1] - thing.rows)
        if lane is not None and (column != lane or (about.lane == "own" and thing.rows <= 0)):
            return False
        if "lanes" in place and not place["lanes"][0] <= column <= place["lanes"][-1]:
            return False
        if "row" in place and row != place["row"]:
            return False
        if "rows" in place and not place["rows"][0] <= row <= place["rows"][-1]:
            return False
        if "cell" in place and (column - 1, row) != tuple(place["cell"]):
            return False
        if "next_rows" in place and not 0 < thing.rows <= place["next_rows"]:
            return False
        cells = self._cells(place)
        if cells is not None and max(abs(thing.lanes), abs(thing.rows)) > cells:
            return False
        return all(_SIDES[side](thing) for side in _sides(place))

    def _cells(self, place: Mapping[str, Any]) -> float | None:
        """Within how many cells of the ego, where that is said."""
        if "distance_m" in place:
            return float(place["distance_m"]) / self._cell_m
        return None if "cells" not in place or _side_of_lane(place) is not None else int(place["cells"])

    def _named(self, about: SceneAsked, lane: int | None) -> str:
        """The place in words, as it stands in a sentence."""
        place, parts = about.place, []
        if lane is not None:
            parts.append(self._say("in_lane", self._beside(lane), lane=lane))
        if "lanes" in place:
            parts.append(self._say("in_lanes", first=place["lanes"][0], last=place["lanes"][-1]))
        if "row" in place:
            parts.append(self._say("in_row", row=place["row"]))
        if "rows" in place:
            parts.append(self._say("in_rows", first=place["rows"][0], last=place["rows"][-1]))
        if (count := place.get("next_rows")) is not None:
            parts.append(self._say("in_next_rows", "one" if count == 1 else "many", count=count))
        if (cells := self._cells(place)) is not None:
            parts.append(self._say("within", metres=self._told.number(cells * self._cell_m)))
        parts += [self._say("on_side", side) for side in _sides(place)]
        return " ".join(parts) or self._say("there")

    def _beside(self, lane: int) -> str:
        return {self._own - 1: "left", self._own: "own", self._own + 1: "right"}.get(lane, "other")

    def _listed(self, things: Sequence[Detection], kind: Kind | None, wanted: Wanted, place: str) -> str:
        """What is there: yes or no first, or the number, or the things, as it is wanted."""
        noun = self._say("any_thing") if kind is None else self._told.noun(kind, 2)
        form = "any" if wanted in ("free", "taken") else wanted
        if not things:
            return self._say("place_none", form, things=noun, place=place)
        listed = self._told.near_ones(things) if kind is None else self._told.listed(things)
        return self._say("place_some", form, total=len(things), listed=listed, place=place)

    def _free(self, lane: int, things: Sequence[Detection], *, agrees: bool) -> str:
        """Whether a lane is free: beside the ego, and ahead. `agrees`: whether yes says that it is."""
        words = ("agree", "disagree") if agrees else ("disagree", "agree")
        yes, no = (self._told.answer(word) for word in words)
        beside = [thing for thing in things if thing.rows == 0]
        ahead = [thing for thing in things if thing.rows > 0]
        which = self._beside(lane)
        name = self._say("lane_name", which, lane=lane)
        taken = ahead if which == "own" else beside
        form = "own" if which == "own" else "other"
        if taken:
            listed = self._told.near_ones(taken)
            told = [Part(0, self._say("lane_taken", form, no=no, name=name, things=listed))]
            if taken is beside and ahead:
                told.append(Part(1, self._say("lane_ahead", things=self._told.near_ones(ahead))))
            return within(told)
        if ahead:
            listed = self._told.near_ones(ahead)
            return self._say("lane_half", yes=yes[:1].lower() + yes[1:], name=name, things=listed)
        return self._say("lane_free", form, yes=yes, name=name)

    def _nearest(self, kind: Kind | None, *, many: bool) -> tuple[Scene, str]:
        """The nearest of a kind, or the nearest few."""
        things = sorted(self._scene.of(kind), key=distance)[: _MOST_NEAREST if many else 1]
        there = replace(self._scene, seen=tuple(things))
        if not things:
            noun = self._say("any_thing") if kind is None else self._told.noun(kind, 2)
            return there, self._say("none", things=noun)
        return there, self._say("closest", thing=self._told.near_ones(things))

    def _lanes(self, asked: str, kind: Kind | None) -> str:
        """Which lanes are free or taken, have most room ahead, or hold things of a kind."""
        if asked == "with":
            things = self._scene.of(kind)
            lanes = sorted({self._own + thing.lanes for thing in things})
            noun = self._told.noun(kind, len(things)) if kind is not None else self._say("any_thing")
            if not lanes:
                return self._say("lanes_without", things=noun)
            count = self._told.count(len(things))
            return self._say("lanes_with", lanes=self._numbers(lanes), count=count, things=noun)
        if asked in ("fullest", "densest"):
            return self._fullest(kind, rows_first=asked == "densest")
        room = {lane: self._room(lane) for lane in range(1, self._columns + 1)}
        if asked == "beside":
            return self._next_to(room)
        if asked == "emptiest":
            return self._emptiest(room)
        free = [lane for lane, (beside, first) in room.items() if not beside and first is None]
        if asked == "taken":
            return self._lanes_taken(room)
        if free:
            told = [Part(0, self._say("lanes_free", lanes=self._numbers(free)))]
        else:
            told = [Part(0, self._say("lanes_none_free"))] if asked == "free" else []
            told.append(Part(0, self._most_room(room)))
        return within([*told, Part(1, self._say("lanes_change", own=self._own))])

    def _fullest(self, kind: Kind | None, *, rows_first: bool) -> str:
        """The lanes with the most things of a kind, and the rows ahead in which they stand densest."""
        things = self._scene.of(kind)
        noun = self._say("any_thing") if kind is None else self._told.noun(kind, 2)
        if not things:
            return self._say("none", things=noun)
        counts = Counter(self._own + thing.lanes for thing in things)
        most = max(counts.values())
        fullest = sorted(lane for lane, count in counts.items() if count == most)
        by_lane = self._say(
            "lanes_fullest",
            "one" if len(fullest) == 1 else "many",
            lanes=self._numbers(fullest),
            count=most,
            total=len(things),
            things=noun,
        )
        ahead = Counter(thing.rows for thing in things if thing.rows > 0)
        if not ahead:
            by_row = self._say("rows_none", things=noun)
        else:
            sums = {
                row: sum(ahead[row + more] for more in range(_STRETCH)) for row in range(1, max(ahead) + 1)
            }
            first = max(sums, key=lambda row: (sums[row], -row))
            last = max(row for row in range(first, first + _STRETCH) if ahead[row])
            first = min(row for row in range(first, first + _STRETCH) if ahead[row])
            by_row = self._say(
                "rows_densest",
                "one" if first == last else "many",
                first=self._told.number(first * self._cell_m),
                last=self._told.number(last * self._cell_m),
                count=sum(ahead[row] for row in range(first, last + 1)),
                things=noun,
            )
        return f"{by_row} {by_lane}" if rows_first else f"{by_lane} {by_row}"

    def _emptiest(self, room: Mapping[int, tuple[bool, Detection | None]]) -> str:
        """The lanes with the fewest things level with the ego or ahead, then those with most room ahead."""
        counts = {
            lane: sum(self._own + thing.lanes == lane and thing.rows >= 0 for thing in self._scene.seen)
            for lane in room
        }
        least = min(counts.values())
        lanes = [lane for lane, count in counts.items() if count == least]
        key = "none" if not least else "one" if least == 1 else "many"
        told = [Part(0, self._say("lanes_emptiest", key, lanes=self._numbers(lanes), count=least))]
        if least:
            told.append(Part(1, self._most_room(room)))
        return within([*told, Part(1, self._say("lanes_change", own=self._own))])

    def _row(self, asked: str, kind: Kind | None, wanted: Wanted) -> tuple[Scene, str]:
        """What is in the row right ahead; gaps in the nearest row of a kind; or what is beyond that row."""
        noun = self._say("any_thing") if kind is None else self._told.noun(kind, 2)
        ahead = [thing for thing in self._scene.seen if thing.rows > 0]
        if asked == "next":
            things = sorted(
                (thing for thing in ahead if thing.rows == 1 and kind in (None, thing.kind)), key=distance
            )
            there = replace(self._scene, seen=tuple(things))
            return there, self._listed(things, kind, wanted, self._say("in_next_row"))
        if asked == "at":
            return self._rows_at(kind, noun)
        row = self._row_of(kind, ahead)
        if row is None:
            return replace(self._scene, seen=()), self._say("row_none", things=noun)
        metres = self._told.number(row * self._cell_m)
        if asked == "beyond":
            things = sorted((thing for thing in ahead if thing.rows > row), key=lambda thing: thing.rows)
            there = replace(self._scene, seen=tuple(things))
            key = "beyond" if things else "beyond_none"
            listed = self._told.near_ones(things) if things else ""
            yes, no = (self._told.answer(word) for word in ("agree", "disagree"))
            return there, self._say(key, yes=yes, no=no, things=noun, metres=metres, listed=listed)
        return self._gaps([thing for thing in ahead if thing.rows == row], kind, metres)

    def _rows_at(self, kind: Kind | None, noun: str) -> tuple[Scene, str]:
        """Lane and row of the nearest of a kind, and the other rows ahead that hold some."""
        things = sorted(self._scene.of(kind), key=distance)
        there = replace(self._scene, seen=tuple(things))
        if not things:
            return there, self._say("none", things=noun)
        first = things[0]
        own = self._scene.cell[1]
        lane, row = self._own + first.lanes, own - first.rows
        told = [Part(0, self._say("row_at", thing=self._told.near_ones([first]), lane=lane, row=row))]
        rows = sorted({own - each.rows for each in things if each.rows > 0} - {row}, reverse=True)
        if rows:
            some = [str(each) for each in rows[:_MOST_ROWS]]
            more = [self._say("more", count=len(rows) - _MOST_ROWS)] if len(rows) > _MOST_ROWS else []
            told.append(Part(1, self._say("rows_at", rows=self._told.joined([*some, *more]), things=noun)))
        return there, within(told)

    def _row_of(self, kind: Kind | None, ahead: Sequence[Detection]) -> int | None:
        """Rows to the nearest one ahead with two things of a kind or more, else with one; None without."""
        rows = Counter(thing.rows for thing in ahead if kind in (None, thing.kind))
        several = [row for row, count in rows.items() if count > 1]
        return min(several or rows, default=None)

    def _gaps(self, things: Sequence[Detection], kind: Kind | None, metres: str) -> tuple[Scene, str]:
        """Which lanes of a row hold nothing, of all that is seen in it."""
        noun = self._say("any_thing") if kind is None else self._told.noun(kind, 2)
        taken = {self._own + thing.lanes for thing in things}
        free = [lane for lane in range(1, self._columns + 1) if lane not in taken]
        yes, no = (self._told.answer(word) for word in ("agree", "disagree"))
        key = "gaps" if free else "gaps_none"
        lanes = self._numbers(free) if free else ""
        text = self._say(key, yes=yes, no=no, things=noun, metres=metres, lanes=lanes)
        return replace(self._scene, seen=tuple(things)), text

    def _next_to(self, room: Mapping[int, tuple[bool, Detection | None]]) -> str:
        """The lanes beside the ego that are free level with it, each with what comes first ahead in it."""
        beside = [lane for lane in (self._own - 1, self._own + 1) if lane in room]
        free = [lane for lane in beside if not room[lane][0]]
        if not free:
            return self._say("next_to_none", no=self._told.answer("disagree"))
        each = []
        for lane in free:
            first, name = room[lane][1], self._say("lane_name", self._beside(lane), lane=lane)
            metres = "" if first is None else self._told.number(first.rows * self._cell_m)
            key = "next_to_clear" if first is None else "next_to_until"
            each.append(self._say(key, name=name, metres=metres))
        listed = self._told.joined(each)
        return self._say("next_to", yes=self._told.answer("agree"), lanes=listed)

    def _sides_compared(self, kind: Kind | None, more_on: str) -> str:
        """How many things are seen in lanes on each side; yes or no first where one side is named."""
        things = self._scene.of(kind)
        left, right = (sum(map(_SIDES[side], things)) for side in ("left", "right"))
        noun = self._say("any_thing") if kind is None else self._told.noun(kind, 2)
        told = self._say("sides", left=left, right=right, own=len(things) - left - right, things=noun)
        if more_on == "both":
            return told
        so = left > right if more_on == "left" else right > left
        return f"{self._told.answer('agree' if so else 'disagree')}. {told}"

    def _lanes_taken(self, room: Mapping[int, tuple[bool, Detection | None]]) -> str:
        beside = [lane for lane, (taken, _) in room.items() if taken]
        ahead = [lane for lane, (_, first) in room.items() if first is not None]
        if not beside and not ahead:
            return self._say("lanes_none_taken")
        parts = []
        for key, lanes in (("lanes_taken_beside", beside), ("lanes_taken_ahead", ahead)):
            if lanes:
                parts.append(self._say(key, lanes=self._numbers(lanes)))
        return " ".join([*parts, self._say("lanes_change", own=self._own)])

    def _most_room(self, room: Mapping[int, tuple[bool, Detection | None]]) -> str:
        """The lanes whose first thing ahead is farthest, of those that are free beside the ego."""
        rows = {
            lane: first.rows for lane, (beside, first) in room.items() if not beside and first is not None
        }
        if not rows:
            return ""
        most = max(rows.values())
        lanes = [lane for lane, count in rows.items() if count == most]
        return self._say(
            "lanes_room", lanes=self._numbers(lanes), metres=self._told.number(most * self._cell_m)
        )

    def _room(self, lane: int) -> tuple[bool, Detection | None]:
        """Whether something is beside the ego in a lane, and the first thing ahead in it."""
        things = [thing for thing in self._scene.seen if self._own + thing.lanes == lane]
        ahead = [thing for thing in things if thing.rows > 0]
        first = min(ahead, key=lambda thing: thing.rows, default=None)
        return any(thing.rows == 0 for thing in things), first

    def _numbers(self, lanes: Sequence[int]) -> str:
        form = "one" if len(lanes) == 1 else "many"
        return self._say("lane_numbers", form, lanes=self._told.joined([str(lane) for lane in lanes]))


def _side_of_lane(place: Mapping[str, Any]) -> str | None:
    """The side to which so many lanes are counted: "two lanes to my left"."""
    side = place.get("side")
    if side is None and len(sides := place.get("sides", ())) == 1:
        side = sides[0]
    return side if side in ("left", "right") and "cells" in place else None


def _sides(place: Mapping[str, Any]) -> list[str]:
    """The sides that something has to be on."""
    if _side_of_lane(place) is not None:
        return []
    side = place.get("side")
    return [*place.get("sides", ()), *([] if side is None else [side])]
