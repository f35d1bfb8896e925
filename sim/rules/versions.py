"""The version of the rules, so that what was kept under older ones is replayed as it was.

A session keeps its configuration, and in it the version that its defaults come from. Parts that were kept
without a version are of the first: `completed` gives them what was the default then, for every field whose
default has changed since. This knows no `Config`, which imports it.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final, TypeVar

from sim.codes import plain_text

Value = TypeVar("Value")

RULES: Final = 3
"""1: cells alone collide, nobody brakes, STUCK comes at the limit of ticks. 2: bodies collide by what they
sweep within a tick, movers brake for a standing vehicle, and a situation that repeats is STUCK. 3: a road
that is given more or fewer lanes or rows keeps what is on it."""

ROADS_KEEP_THEIR_THINGS: Final = 3
"""The version from which so many lanes or rows more or fewer leave what is on the road where it is."""

FIRST: Final = 1
"""The version of what names none."""

LEFT: Final[Mapping[int, Mapping[str, Any]]] = MappingProxyType(
    {
        1: MappingProxyType(
            {"attentive": 0.0, "collision": "cell", "planner": "priority", "repetition": False},
        ),
        2: MappingProxyType({}),
    }
)
"""By version, the defaults that held under it and were changed with the next one, by field of `Config`."""


class NewerRulesError(ValueError):
    """Something was made under rules that this program does not know."""

    def __init__(self, rules: int) -> None:
        super().__init__(plain_text("newer_rules", {"rules": rules, "known": RULES}))
        self.rules = rules
        self.known = RULES


def version_of(parts: Mapping[str, Any]) -> Any:
    """The version that kept parts name, as it stands there; the first where they name none."""
    return parts.get("rules", FIRST)


def check_known(rules: Any) -> None:
    """Raises `NewerRulesError` for a version after this program's; what is no version passes."""
    if isinstance(rules, int) and rules > RULES:
        raise NewerRulesError(rules)


def default_under(rules: int, name: str, today: Value) -> Value:
    """What the default of a field is under a version, where `today` is the present one."""
    return held_under(rules).get(name, today)  # type: ignore[no-any-return]


def held_under(rules: int) -> dict[str, Any]:
    """The defaults under a version that are not, or not surely, those of today, by field."""
    held: dict[str, Any] = {}
    for version in sorted(LEFT, reverse=True):
        if version >= rules:
            held |= LEFT[version]
    return held


def completed(parts: Mapping[str, Any]) -> dict[str, Any]:
    """Parts of a configuration with their version, and the defaults of that time which were changed since.

    What they name themselves stays. What is no version stays as well, for `Config` to refuse.
    """
    rules = version_of(parts)
    known = isinstance(rules, int) and not isinstance(rules, bool)
    return {**(held_under(rules) if known else {}), **parts, "rules": rules}
