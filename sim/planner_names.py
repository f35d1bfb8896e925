"""Which planners there are, by name: a leaf, so that a configuration can be checked without loading one.

Planners from outside the project are found by entry points of the group `roadtalk.planners`; their names are
read from what is installed, and nothing of theirs is run for it. A package cannot take a name of this
project's own for its planner: such an entry is passed over, and `refused` says so.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Any, Final, Literal, get_args

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP: Final = "roadtalk.planners"
BuiltIn = Literal["rules", "priority", "astar", "dijkstra", "bfs"]
"""Names of the planners that come with the project (`sim.plan`)."""
Alias = Literal["exact"]
"""Older names of theirs, which stay good wherever a planner is named (`canonical`)."""
Promised = Literal["dwa", "rl", "cooperative"]
"""Names that people may say and this version has not."""
PlannerName = Literal[BuiltIn, Alias, Promised]
"""What may be said in an action; planners of other packages are set by their own names."""

BUILT_IN: Final[tuple[str, ...]] = get_args(BuiltIn)
ALIASES: Final[dict[str, BuiltIn]] = {"exact": "bfs"}
PROMISED: Final[tuple[str, ...]] = get_args(Promised)
RESERVED: Final = (*BUILT_IN, *ALIASES, *PROMISED, "manual")
"""Names that no other package may take; `manual` is a person."""

_FIT: Final = re.compile(r"[a-z][a-z0-9_-]{0,39}")
"""What a name may be made of, so that none looks like another one."""

_registered: list[str] = []


def claim(name: str) -> None:
    """Take a name for a planner. Raises `ValueError` if it is taken."""
    if name in _registered or name in PROMISED or name in ALIASES:
        raise ValueError(f"there is already a planner called {name!r}")
    _registered.append(name)


def installed() -> dict[str, EntryPoint]:
    """Planners of other packages by name; of two that claim one name, the first by package counts."""
    return _sorted_out()[0]


def refused() -> tuple[tuple[str, str, str], ...]:
    """Entries of other packages that are passed over: the name, where it leads, and why."""
    return _sorted_out()[1]


def forget_installed() -> None:
    """Look anew at what is installed, when next asked."""
    _sorted_out.cache_clear()


@cache
def _sorted_out() -> tuple[dict[str, EntryPoint], tuple[tuple[str, str, str], ...]]:
    from importlib.metadata import entry_points  # takes longer than all else that is imported here

    found: dict[str, EntryPoint] = {}
    passed_over = []
    for point in sorted(entry_points(group=GROUP), key=lambda point: point.value):
        why = None
        if point.name.strip().casefold() in RESERVED:
            why = "the name is one of Roadtalk's own"
        elif not _FIT.fullmatch(point.name):
            why = "a name is up to 40 of a-z, 0-9, - and _, and begins with a letter"
        elif point.name in found and found[point.name].value != point.value:
            why = f"{found[point.name].value} has that name already"
        if why is None:
            found.setdefault(point.name, point)
        else:
            passed_over.append((ascii(point.name)[1:-1], ascii(point.value)[1:-1], why))
    return found, tuple(passed_over)


def names() -> tuple[str, ...]:
    """The names of all planners there are: built in, registered, installed."""
    return tuple(dict.fromkeys((*BUILT_IN, *_registered, *installed())))


def known(name: str) -> bool:
    """Whether there is a planner of that name, or that had it."""
    return name in BUILT_IN or name in ALIASES or name in names()


def canonical(name: Any) -> Any:
    """The present name of a planner that had another one; anything else as it is.

    `Config` asks this, and so everything that is driven, told or kept has the present name. What was said
    stays in the log as it was said.
    """
    return ALIASES.get(name, name) if isinstance(name, str) else name
