"""Numbers that a taught phrase takes: "wall N" means N barriers in row 10.

A phrase is taught with an example of its meaning; each parameter says which figures of the example it stands
for, by their paths in the actions as JSON values: `0.count`, `1.where.row`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from typing import Annotated, Any

from annotated_types import MaxLen, MinLen

from service.actions.steering import STRICT

MAX_PARAMETERS = 3
"""How many numbers one phrase may take."""
MAX_FIGURES = 20
"""How many figures one parameter may stand for."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PhraseParameter:
    """A word of a taught phrase in whose place a number is said."""

    name: Annotated[str, MinLen(1), MaxLen(20)]
    figures: Annotated[tuple[str, ...], MinLen(1), MaxLen(MAX_FIGURES)]
    """the paths of the figures it stands for"""

    __pydantic_config__ = STRICT


def figure(values: Any, path: str) -> int | float | None:
    """The figure at a path of JSON values; None where there is none."""
    for key in path.split("."):
        if isinstance(values, list):
            values = values[int(key)] if key.isdigit() and int(key) < len(values) else None
        else:
            values = values.get(key) if isinstance(values, Mapping) else None
    return values if isinstance(values, int | float) and not isinstance(values, bool) else None


def filled(
    meaning: Sequence[Mapping[str, Any]],
    parameters: Sequence[PhraseParameter],
    numbers: Mapping[str, int | float],
) -> list[dict[str, Any]]:
    """A meaning as JSON values, with numbers in the place of the parameters' figures."""
    made: list[Any] = [deepcopy(dict(each)) for each in meaning]
    for parameter in parameters:
        for path in parameter.figures:
            *way, last = path.split(".")
            place: Any = made
            for key in way:
                place = place[int(key)] if isinstance(place, list) else place[key]
            place[int(last) if isinstance(place, list) else last] = numbers[parameter.name]
    return made


def paths(values: Any, before: str = "") -> dict[str, Any]:
    """Every value in JSON values that holds no others, by its path."""
    pairs: Sequence[tuple[Any, Any]] = ()
    if isinstance(values, Mapping):
        pairs = list(values.items())
    elif isinstance(values, list):
        pairs = list(enumerate(values))
    else:
        return {before: values}
    found: dict[str, Any] = {}
    for key, each in pairs:
        found |= paths(each, f"{before}.{key}" if before else str(key))
    return found
