"""The sayings of one language: templates by file and key, and the joining of lists."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import yaml

from service.resources import prompts_folder
from sim.kinds import Cell, Move
from sim.plan import Option


class Sayings:
    """What `prompts/sayings/<code>/*.yaml` holds."""

    def __init__(self, files: dict[str, dict[str, Any]]) -> None:
        """`files`: what each file holds, by its name without ending."""
        self._files = files
        self._words = files["words"]

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

    def where(self, cell: Cell) -> str:
        """A cell as people call it: lanes count from 1."""
        return self.say("words", "at_cell", lane=cell[0] + 1, row=cell[1])

    def reason(self, option: Option, tense: str) -> str:
        """What a move would meet, `now` or `then`."""
        place = self.move(option.move, "place")
        return self.say("words", "reasons", option.reason, tense, who=self.joined(option.causes), place=place)
