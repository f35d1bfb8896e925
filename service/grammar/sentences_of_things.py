"""Says places, and what is done to things on the road: the part of `sentences` with the most words."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from typing import Any, Literal

from sim.actions import Landmark, MoveThings, OneThing, Remove, Where

_EXCLUSIVE = (
    ("cell", "lane"),
    ("cell", "row"),
    ("cells", "distance_m"),
    ("nearest", "cell"),
    ("nearest", "lane"),
    ("nearest", "lanes"),
    ("nearest", "rows"),
    ("nearest", "of"),
    ("lanes", "lane"),
    ("lanes", "cell"),
    ("rows", "row"),
    ("rows", "cell"),
    ("each", "lane"),
    ("each", "cell"),
    ("each", "id"),
    ("each", "nearest"),
    ("of", "id"),
)
"""Parts of a place that contradict each other when said together."""


class Unsayable(ValueError):  # noqa: N818 - says what the actions are, not what went wrong
    """Actions that no sentence of the language means."""


class SayableWords(dict[str, Any]):
    """Words by their key; one that is not there cannot be said."""

    def __missing__(self, key: str) -> Any:
        raise Unsayable(f"no words for {key}")


class ThingSentences:
    """Sentences about things on the road, in one language."""

    def __init__(self, words: Mapping[str, Any]) -> None:
        """`words`: the language's `sentences.yaml`."""
        self._words = words

    def _move(self, action: MoveThings) -> str:
        things = self._meant(action.kind, action.count, action.where)
        if action.by is None:
            return self._say("move_to", things=things, to=self._destination(action.to))
        key = "move_by_one" if action.by.cells == 1 else "move_by"
        side = self._word("shift", action.by.side)
        return self._say(key, things=things, cells=action.by.cells, side=side)

    def _meant(self, kind: str, count: int | Literal["all"], where: Where | None) -> str:
        """Things that are on the road already: "all cars in lane 2", "the 2 nearest cones", "pothole-3"."""
        many = self._entry("things", kind)[1]
        if where is not None and where.id is not None:
            if where != Where(id=where.id) or count != 1 or where.id.rpartition("-")[0] != kind:
                raise Unsayable("an id is a thing of its own")
            return where.id
        if count == "all":
            if where is not None and where.nearest:
                raise Unsayable("how many are nearest is a number")
            return self._say("meant_all", things=many, where=self._where(where))
        if where is not None and where.nearest:
            if where != Where(nearest=True):
                raise Unsayable("the nearest are nearest to the vehicle")
            return self._say(
                "meant_nearest" if count == 1 else "meant_nearest_many", **self._counted(kind, count)
            )
        return self._say("meant", **self._counted(kind, count), where=self._where(where))

    def _one(self, one: OneThing) -> str:
        """A thing that changes places: "the nearest car", "a cone in lane 2", "pothole-3"."""
        if one.where is None:
            return self._say("one_of", thing=self._entry("things", one.kind)[0], where="")
        if one.where.id is not None or one.where.nearest:
            return self._meant(one.kind, 1, one.where)
        return self._say("one_of", thing=self._entry("things", one.kind)[0], where=self._where(one.where))

    def _destination(self, to: Where | None) -> str:
        """Where things are to be: "lane 3"."""
        if to is None:
            return ""
        if to == Where() or to.id is not None or to.nearest or to.each:
            raise Unsayable("no place to put things")
        return self._where(to, "to_place")

    def _remove(self, action: Remove) -> str:
        kind, count, where = action.kind, action.count, action.where
        if action.except_ is not None:
            if count != "all" or where is not None:
                raise Unsayable("an exception is one of all")
            stay = self._staying(action.except_)
            if kind == "everything":
                return self._say("remove_except_everything", stay=stay)
            return self._say("remove_except", things=self._entry("things", kind)[1], stay=stay)
        if count == "half":
            if kind == "everything":
                raise Unsayable("half of everything is said of no kind")
            return self._say("remove_half", things=self._entry("things", kind)[1], where=self._where(where))
        if kind == "everything":
            if count != "all":
                raise Unsayable("everything is all there is")
            return self._say("remove_everything", where=self._where(where))
        if count == "all":
            return self._say("remove_all", things=self._entry("things", kind)[1], where=self._where(where))
        if count == 1 and where == Where(nearest=True):
            named = self._entry("things", kind)
            return self._say("remove_nearest", thing=named[0], nearest=named[-1])
        if count == 1 and where is not None and where.id is not None and where == Where(id=where.id):
            if where.id.rpartition("-")[0] != kind:
                raise Unsayable(f"{where.id} is no {kind}")
            return self._say("remove_id", id=where.id)
        return self._say("remove", **self._counted(kind, count), where=self._where(where))

    def _staying(self, where: Where) -> str:
        """What an exception leaves: "the nearest one", "those in lane 2"."""
        if where == Where(nearest=True):
            return self._say("stay_nearest")
        if where.id is not None:
            if where != Where(id=where.id):
                raise Unsayable("an id is a thing of its own")
            return where.id
        if where.nearest or where.each or where == Where():
            raise Unsayable("no place of things that stay")
        return self._say("stay_there", where=self._where(where))

    def _where(self, where: Where | None, section: str = "where") -> str:
        """The place, each part said once; nothing for no place. `section`: the words for its parts."""
        if where is None or where == Where():
            return ""
        if any(getattr(where, a) is not None and getattr(where, b) is not None for a, b in _EXCLUSIVE):
            raise Unsayable("parts of the place contradict each other")
        words = SayableWords({**self._words["where"], **self._words.get(section, {})})
        said = self._absolute(where, words)
        if where.distance_m is not None:
            key = "distance_side" if where.side else "distance"
            said += words[key].format(metres=number(where.distance_m))
        elif where.cells is not None:
            key = f"cell{'s' if where.cells != 1 else ''}_{'side' if where.side else 'away'}"
            said += words.get(key, words["cells"]).format(cells=where.cells)
        if where.of is not None:
            if where.side is None and (where.distance_m or where.cells):
                raise Unsayable("a distance from a thing has a side")
            key = where.side or "near"
            said += words["seen_from"][key].format(thing=self._landmark(where.of))
        elif where.side is not None:
            said += words[where.side]
        if where.nearest:
            said += words["nearest"]
        return said

    def _landmark(self, of: Landmark) -> str:
        """The thing a place is described from."""
        if of.id is not None:
            return of.id
        if of.kind == "av":
            raise Unsayable("the nearest autonomous vehicle is the vehicle itself")
        return self._say("meant_nearest", count=1, things=self._entry("things", of.kind)[0])

    def _absolute(self, where: Where, words: Mapping[str, Any]) -> str:
        said = ""
        if where.lane is not None:
            key = "lane_number" if isinstance(where.lane, int) else "lane"
            said += words[key].format(lane=self._words.get("lanes", {}).get(where.lane, where.lane))
        if where.lanes is not None:
            said += words["lanes"].format(first=where.lanes[0], last=where.lanes[1])
        if where.each is not None:
            said += words["each_lane"]
        if where.row is not None:
            said += words["row"].format(row=where.row)
        if where.rows is not None:
            said += words["rows"].format(first=where.rows[0], last=where.rows[1])
        if where.cell is not None:
            said += words["cell"].format(column=where.cell[0], row=where.cell[1])
        if where.id is not None:
            said += words["id"].format(id=where.id)
        return said

    def _counted(self, kind: str, count: int) -> dict[str, Any]:
        return {"count": count, "things": self._entry("things", kind)[0 if count == 1 else 1]}

    def _word(self, section: str, key: Any) -> str:
        return str(self._entry(section, key))

    def _entry(self, section: str, key: Any) -> Any:
        try:
            return self._words[section][key]
        except KeyError:
            raise Unsayable(f"no word for {key!r} of {section}") from None

    def _say(self, key: str, **parts: Any) -> str:
        if key not in self._words:
            raise Unsayable(f"no sentence for {key!r}")
        return str(self._words[key]).format(**parts)


def number(value: float) -> str:
    """A number in digits, without an exponent, that reads as exactly the same number."""
    told = format(Decimal(repr(value)), "f")
    return told.rstrip("0").rstrip(".") if "." in told and isinstance(value, float) else told
