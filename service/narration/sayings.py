"""The sayings of one language: templates by file and key, the forms of words, numbers and lists."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any, Final, Protocol

from service.narration.inflection import Inflected, capital, join_forms, of_forms
from service.refusals import fault_of
from service.resources import DEFAULT_LANGUAGE, prompts_folder
from service.yaml_files import read_cached_yaml, read_yaml
from sim.plan import Option
from sim.planner_names import canonical
from sim.types import KINDS, PLACEABLE, Cell, Kind, Move, kind_of


class Names(Protocol):
    """Whatever knows what to call things."""

    def things(self, names: Sequence[str]) -> str:
        """Several things, each named."""

    def imagined(self, names: Sequence[str]) -> dict[str, str]:
        """Those of these things that were seen where they were not, and where that was."""


_ALONE: Final = r"(?<![\w.,/:–-])(?<!\btick )(?<!\blane )(?<!\brow )(?<!\bTick )(?<!\bSpur )(?<!\bReihe )"
"""Before a one that counts: no other number, and no name of what is numbered."""
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
    other = things.pop("other", ["{one}", "{many}"])
    for kind in PLACEABLE:
        names = {"{one}": kind.value, "{many}": KINDS[kind].plural}
        one, many = (_base(noun) for noun in things.setdefault(kind.value, _filled(other, names)))
        parts = {"{one}": one, "{many}": many}
        for file, key in _BY_KIND:
            table = files.get(file, {}).get(key, {})
            if "other" in table:
                table.setdefault(kind.value, _filled(table["other"], parts))
            if (file, key) == ("words", "a"):
                parts["{a}"] = _base(table.get(kind.value, one))
    return files


def _base(words: Any) -> str:
    """The first form of what may have several."""
    return str(next(iter(words.values())) if isinstance(words, dict) else words)


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

    def __init__(self, files: dict[str, dict[str, Any]], language: str = DEFAULT_LANGUAGE) -> None:
        """`files`: what each file holds, by its name without ending; `language`: its code."""
        self.language = language
        self._files = _with_every_kind(files)
        self._words = self._files["words"]
        self._inflects = bool(self._words["inflects"])
        numbers = self._words["numbers"]
        marks = {",": numbers["thousands"], ".": numbers["decimal"]}
        self._marks = {} if all(mark == other for mark, other in marks.items()) else str.maketrans(marks)

        ones = sorted(self._words["ones"], key=len, reverse=True)
        self._ones = re.compile(rf"{_ALONE}1 ({'|'.join(map(re.escape, ones))})\b")

    @classmethod
    def load(cls, code: str = DEFAULT_LANGUAGE, folder: Path | None = None) -> Sayings:
        """The sayings of a language. Raises `FileNotFoundError` where there are none."""
        place = (folder or prompts_folder() / "sayings") / code
        paths = sorted(place.glob("*.yaml"))
        if not paths:
            raise FileNotFoundError(f"there are no sayings in {place}")
        read = read_cached_yaml(paths) if folder is None else [read_yaml(path) for path in paths]
        return cls({path.stem: held for path, held in zip(paths, read, strict=True)}, code)

    def say(self, file: str, *keys: str, **parts: object) -> str:
        """A template, filled, in all its forms. Raises `KeyError` where the language lacks it."""
        found: Any = self._files[file]
        for key in keys:
            found = found[key]
        if not self._inflects:
            return str(found).format(**parts)
        parts = {name: Inflected(part) if type(part) is str else part for name, part in parts.items()}
        if isinstance(found, dict):
            return of_forms({name: str(text).format(**parts) for name, text in found.items()})
        return str(found).format(**parts)

    def words(self, file: str, *keys: str) -> Any:
        """What stands under keys as it is: a list or a table of words."""
        found: Any = self._files[file]
        for key in keys:
            found = found[key]
        return found

    def value(self, file: str, *keys: str) -> str | None:
        """What stands under keys; None where the last of them is not there."""
        return self.say(file, *keys) if keys[-1] in self.words(file, *keys[:-1]) else None

    def number(self, value: float, spec: str = "g") -> str:
        """A number with the marks of the language, in a format of Python."""
        told = format(value, spec)
        return told.translate(self._marks) if self._marks else told

    def with_ones(self, text: str) -> str:
        """A text in which what is counted stands in its form for one after the number one."""
        return self._ones.sub(lambda found: f"1 {self._words['ones'][found[1]]}", text)

    def quoted(self, text: str) -> str:
        """What is said, in quotation marks."""
        return self.say("words", "quoted", text=text)

    def examples(self) -> list[str]:
        """Sentences that a newcomer may try."""
        return list(self._files["answers"]["help_examples"])

    def joined(self, parts: Sequence[str]) -> str:
        """ "a", "a and b", "a, b and c"."""
        joints = self._words["joined"]
        if self._inflects:
            return join_forms(parts, joints["comma"], joints["last"])
        if len(parts) < 2:
            return "".join(parts)
        return f"{joints['comma'].join(parts[:-1])}{joints['last']}{parts[-1]}"

    def listed(self, clauses: Sequence[str]) -> str:
        """ "a; b; c", for parts that have commas of their own."""
        semicolon = str(self._words["joined"]["semicolon"])
        return self.chained(clauses, semicolon)

    def chained(self, parts: Sequence[str], joint: str) -> str:
        """Parts with the same between each two of them."""
        return join_forms(parts, joint, joint) if self._inflects else joint.join(parts)

    def things(self, kind: str, count: int) -> str:
        """The noun of a kind, singular for one."""
        return self.noun("words", "things", kind, count)

    def noun(self, file: str, table: str, kind: str, count: int) -> str:
        """Of a table of nouns the one of a kind, singular for one."""
        one, many = self._files[file][table][kind]
        return self._formed(one if count == 1 else many)

    def move(self, move: Move, form: str) -> str:
        """A move as `did`, `do`, `name` or `place`."""
        return self._formed(self._words["moves"][move][form])

    def named_move(self, move: Move) -> str:
        """A move's name at the beginning of a sentence."""
        return capital(self.move(move, "name"))

    @staticmethod
    def _formed(found: Any) -> str:
        return of_forms(found) if isinstance(found, dict) else str(found)

    def planner(self, name: str, form: str = "name") -> str:
        """A planner as people know it: as `name`, after `with`, or as what is set (`id`).

        One of another package goes by its own name, and so does one whose `id` has no word of its own.
        """
        known = self._words["planners"].get(canonical(name))
        return name if known is None else str(known[form] if form != "id" else known.get(form, name))

    def fault(self, text: str) -> str:
        """What a planner did instead of answering, as the simulator words it, in this language."""
        code, parts = fault_of(text)
        return self.say("words", "faults", code, **parts)

    def where(self, cell: Cell) -> str:
        """A cell as people call it: lanes count from 1."""
        return self.say("words", "at_cell", lane=cell[0] + 1, row=cell[1])

    def met(self, option: Option, tense: str, naming: Names, *, again: frozenset[str] = frozenset()) -> str:
        """What a move would meet, `now` or `then`; `again`: things that other moves are told to meet."""
        return self.in_the_way(option.reason, option.move, option.causes, tense, naming, again=again)

    def all_met(self, options: Sequence[Option], tense: str, naming: Names) -> str:
        """What several moves would meet, like things told together."""
        told: list[str] = []
        alike: dict[tuple[str, str], list[Option]] = {}
        meets = Counter(name for option in options for name in set(option.causes))
        again = frozenset(name for name, times in meets.items() if times > 1)
        for option in options:
            kind = self._kind(option)
            alone = (
                option.reason not in self.words("words", "several")
                or not again.isdisjoint(option.causes)
                or (tense == "then" and naming.imagined(option.causes))
            )
            key = ("", option.move) if alone else (option.reason.value, kind)
            alike.setdefault(key, []).append(option)
        for (reason, kind), group in alike.items():
            if len(group) == 1:
                told.append(self.met(group[0], tense, naming, again=again))
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

    def in_the_way(
        self,
        reason: str,
        move: Move,
        ids: Sequence[str],
        tense: str,
        naming: Names,
        *,
        again: frozenset[str] = frozenset(),
    ) -> str:
        """What is in the way of a move; in hindsight also that it was not there.

        A thing that is told `again` goes by its name, and not as "a car", which would be another one.
        """
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
        if len(ids) == 1 and ids[0] in again:
            a = who
        return self.say("words", "reasons", reason, tense, who=who, a=a, place=place)
