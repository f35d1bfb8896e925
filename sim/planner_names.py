"""Which planners there are, by name: a leaf, so that a configuration can be checked without loading one.

Planners from outside the project are found by entry points of the group `roadtalk.planners`; their names are
read from what is installed, and nothing of theirs is run for it. A package cannot take a name of this
project's own for its planner: such an entry is passed over, and `refused` says so.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP: Final = "roadtalk.planners"
BUILT_IN: Final = ("rules", "priority", "astar", "dijkstra", "exact")
"""Names of the planners that come with the project (`sim.plan`)."""
LOCAL: Final = ("rules", "priority")
"""Those of them that decide from what never moves and from the movers of the vehicle's row and the next."""
WEIGHING: Final = ("astar", "dijkstra")
"""Those of them that charge for what is near, and so heed preferences (`sim.search.costs`)."""
PROMISED: Final = ("dwa", "rl", "cooperative")
"""Names that people may say and this version has not."""
RESERVED: Final = (*BUILT_IN, *PROMISED, "manual")
"""Names that no other package may take; `manual` is a person."""

_FIT: Final = re.compile(r"[a-z][a-z0-9_-]{0,39}")
"""What a name may be made of, so that none looks like another one."""

_registered: list[str] = []


def claim(name: str) -> None:
    """Take a name for a planner. Raises `ValueError` if it is taken."""
    if name in _registered or name in PROMISED:
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
    """Whether there is a planner of that name."""
    return name in BUILT_IN or name in names()
