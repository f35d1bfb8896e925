"""What a question about the scene says beyond its keys: a place, a lane, and what is wanted of it.

It stands in `Asked.supposes`: words, and a place as JSON where one was said ("number {\"lane\": 3}").
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, Literal

Wanted = Literal["any", "what", "number", "free", "taken"]
WANTED: Final[tuple[Wanted, ...]] = ("any", "what", "number", "free", "taken")
LANE: Final = "lane"
"""Before `left`, `right` or `own`: the lane beside the ego, or its own."""
LANES: Final = "lanes"
"""Before what is asked of all lanes: `free`, `taken`, `best`, `emptiest`,
`with` things of a kind, `fullest` of them, where they stand `densest`, `beside` the ego, or
`sides`."""
SIDES: Final = "sides"
"""Before the side on which more is supposed, or `both`."""
ROW: Final = "row"
"""Before what is asked of one row ahead: what is in the `next`, a `gap` in it, what is `beyond` it, or where
things are `at`."""
WITHIN: Final = "within"
"""Before a number of rows."""


@dataclass(frozen=True, slots=True)
class SceneAsked:
    """The words, and the place."""

    words: tuple[str, ...]
    place: Mapping[str, Any]

    @classmethod
    def of(cls, supposes: str | None) -> SceneAsked:
        """From `Asked.supposes`."""
        text = supposes or ""
        at, end = text.find("{"), text.rfind("}") + 1
        place = json.loads(text[at:end]) if 0 <= at < end else {}
        words = (text[:at] + text[end:]).split() if place else text.split()
        if WITHIN in words and (rows := words[-1]).isdigit():
            place = place | {"next_rows": int(rows)}
        if place.get("sides") == ["ahead"] and len(place) == 1:
            place = {}  # what is ahead is told first in any case
        return cls(tuple(words), place)

    @property
    def is_of_places(self) -> bool:
        """Whether it is of a part of the road, or of its lanes."""
        return bool(self.place) or any(each is not None for each in (self.lane, self.lanes, self.row))

    @property
    def wanted(self) -> Wanted:
        """What is wanted to be known of the place."""
        return next((each for each in WANTED if each in self.words), "any")

    @property
    def lane(self) -> str | None:
        """`left`, `right` or `own`, where one of these lanes is meant."""
        return self.words[1] if self.words[:1] == (LANE,) else None

    @property
    def more_on(self) -> str | None:
        """`left`, `right` or `both`, where the sides of the road are compared."""
        return self.words[2] if self.words[:2] == (LANES, SIDES) else None

    @property
    def lanes(self) -> str | None:
        """What is asked of all lanes."""
        return self.words[1] if self.words[:1] == (LANES,) else None

    @property
    def row(self) -> str | None:
        """`next`: the row right ahead; `gap`, `beyond`: the nearest of a kind; `at`: its number; or None."""
        return self.words[1] if self.words[:1] == (ROW,) else None
