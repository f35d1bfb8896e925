"""The sayings of one language: templates by file and key, and the joining of lists."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any, Final, Protocol

import yaml

from service.resources import prompts_folder
from sim.plan import Option
from sim.planner_names import canonical
from sim.types import KINDS, PLACEABLE, Cell, Kind, Move, kind_of


class Names(Protocol):
    """Whatever knows what to call things."""

    def things(self, names: Sequence[str]) -> str:
        """Several things, each named."""

    def imagined(self, names: Sequence[str]) -> dict[str, str]:
        """Those of these things that were seen where they were not, and where that was."""


_BY_KIND: Final = (
    ("words", "a"),
    ("naming", "the"),
    ("scene", "a"),
    ("scene", "nouns"),
    ("advice", "hazards"),
    ("ends", "sakes"),
    ("next", "sakes"),
)
"""Tables with words for every kind. A kind that is not there is put as under `other`."""


def _with_every_kind(files: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    files = deepcopy(files)
    things = files.get("words", {}).setdefault("things", {})
    for kind in PLACEABLE:
        one, many = things.setdefault(kind.value, [kind.value, KINDS[kind].plural])
        parts = {"{one}": one, "{many}": many}
        for file, key in _BY_KIND:
            table = files.get(file, {}).get(key, {})
            if "other" in table:
                table.setdefault(kind.value, _filled(table["other"], parts))
            if (file, key) == ("words", "a"):
                parts["{a}"] = table.get(kind.value, one)
    return files


def _filled(other: Any, parts: Mapping[str, str]) -> Any:
    """What stands under `other` with the words of a kind; what else is to be filled in stays."""
    if isinstance(other, dict):
        return {key: _filled(each, parts) for key, each in other.items()}
    if isinstance(other, list):
        return [_filled(each, parts) for each in other]
    for name, word in parts.items():
        other = other.replace(name, word)
    return other


class Sayings:
    """What `prompts/sayings/<code>/*.yaml` holds."""

    def __init__(self, files: dict[str, dict[str, Any]]) -> None:
        """`files`: what each file holds, by its name without ending."""
        self._files = _with_every_kind(files)
        self._words = self._files["words"]

    @classmethod
    def load(cls, code: str = "en", folder: Path | None = None) -> Sayings:
        """The sayings of a language. Raises `FileNotFoundError` where there are none."""
        place = (folder or prompts_folder() / "sayings") / code
        paths = sorted(place.glob("*.yaml"))
        if not paths:
            raise FileNotFoundError(f"there are no sayings in {place}")
        return cls({path.stem: yaml.safe_load(path.read_text(encoding="utf-8")) for path in paths})

    def say(self, file: str, *keys: str, **parts: object) -> str:
        """A template, filled. Raises `KeyError` where the language lacks it."""
        found: Any = self._files[file]
        for key in keys:
            found = found[key]
        return str(found).format(**parts)

    def words(self, file: str, *keys: str) -> Any:
        """What stands under keys as it is: a list or a table of words."""
        found: Any = self._files[file]
        for key in keys:
            found = found[key]
        return found

    def examples(self) -> list[str]:
        """Sentences that a newcomer may try."""
        return list(self._files["answers"]["help_examples"])

    def joined(self, parts: Sequence[str]) -> str:
        """ "a", "a and b", "a, b and c"."""
        if len(parts) < 2:
            return "".join(parts)
        joints = self._words["joined"]
        return f"{joints['comma'].join(parts[:-1])}{joints['last']}{parts[-1]}"

    def listed(self, clauses: Sequence[str]) -> str:
        """ "a; b; c", for parts that have commas of their own."""
        return str(self._words["joined"]["semicolon"]).join(clauses)

    def things(self, kind: str, count: int) -> str:
        """The noun of a kind, singular for one."""
        one, many = self._words["things"][kind]
        return str(one if count == 1 else many)

    def move(self, move: Move, form: str) -> str:
        """A move as `did`, `do`, `name` or `place`."""
        return str(self._words["moves"][move][form])

    def planner(self, name: str, form: str = "name") -> str:
        """A planner as people know it, as `name` or after `with`; one of another package by its own name."""
        known = self._words["planners"].get(canonical(name))
        return name if known is None else str(known[form])

    def where(self, cell: Cell) -> str:
        """A cell as people call it: lanes count from 1."""
        return self.say("words", "at_cell", lane=cell[0] + 1, row=cell[1])

    def met(self, option: Option, tense: str, naming: Names) -> str:
        """What a move would meet, `now` or `then`."""
        return self.in_the_way(option.reason, option.move, option.causes, tense, naming)

    def all_met(self, options: Sequence[Option], tense: str, naming: Names) -> str:
        """What several moves would meet, like things told together."""
        told: list[str] = []
        alike: dict[tuple[str, str], list[Option]] = {}
        for option in options:
            kind = self._kind(option)
            alone = option.reason not in self.words("words", "several") or (
                tense == "then" and naming.imagined(option.causes)
            )
            key = ("", option.move) if alone else (option.reason.value, kind)
            alike.setdefault(key, []).append(option)
        for (reason, kind), group in alike.items():
            if len(group) == 1:
                told.append(self.met(group[0], tense, naming))
                continue
            places = self.joined([self.move(option.move, "place") for option in group])
            many = self.things(kind, 2)
            told.append(self.say("words", "several", reason, tense, places=places, many=many))
        return self.joined(told)

    @staticmethod
    def _kind(option: Option) -> str:
        """The kind of what a move would meet: the mover, where it is one held by a pothole."""
        kinds = sorted((kind_of(name) for name in option.causes), key=lambda kind: not kind.moves)
        return kinds[0].value if kinds else ""

    def imagined(self, name: str, where: str) -> str:
        """That a thing was seen at a place, and was not there."""
        return self.say("words", "imagined", a=self.say("words", "a", kind_of(name)), where=where)

    def in_the_way(self, reason: str, move: Move, ids: Sequence[str], tense: str, naming: Names) -> str:
        """What is in the way of a move; in hindsight also that it was not there."""
        if not reason.startswith("ego_"):  # where movers or hazards are in the way, they are told alone
            ids = [name for name in ids if kind_of(name) is not Kind.AV]
        imagined = naming.imagined(ids) if tense == "then" else {}
        if imagined:
            phrases = self.joined([self.imagined(name, where) for name, where in imagined.items()])
            real = [name for name in ids if name not in imagined]
            return (
                phrases if not real else self.say("words", "besides", told=phrases, who=naming.things(real))
            )
        place, who = self.move(move, "place"), naming.things(ids)
        movers = [kind_of(name) for name in ids if kind_of(name).moves]
        if reason == "mover_enters" and len(ids) > 1:
            other = "crosses" if move in (Move.FORWARD_LEFT, Move.FORWARD_RIGHT) else "swaps"
            first, rest = naming.things(ids[:1]), naming.things(ids[1:])
            form = other if len(ids) == 2 else "both_cross"
            return self.say("words", "enters_and", form, tense, who=first, other=rest, place=place)
        if reason == "mover_crosses" and len(ids) > 1:
            return self.say("words", "both_cross", tense, who=who, place=place)
        kinds = movers or [kind_of(name) for name in ids]
        a = self.say("words", "a", kinds[0]) if kinds else ""
        return self.say("words", "reasons", reason, tense, who=who, a=a, place=place)
