"""Which planners there are, by name: a leaf, so that a configuration can be checked without loading one.

Planners from outside the project are found by entry points of the group `roadtalk.planners`; their names are
read from what is installed, and nothing of theirs is run for it.
"""

from __future__ import annotations

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

_registered: list[str] = []


def claim(name: str) -> None:
    """Take a name for a planner. Raises `ValueError` if it is taken."""
    if name in _registered or name in PROMISED:
        raise ValueError(f"there is already a planner called {name!r}")
    _registered.append(name)


@cache
def installed() -> dict[str, EntryPoint]:
    """Planners of other packages by name; of two that claim one name, the first by package counts."""
    from importlib.metadata import entry_points  # takes longer than all else that is imported here

    found: dict[str, EntryPoint] = {}
    for point in sorted(entry_points(group=GROUP), key=lambda point: point.value):
        found.setdefault(point.name, point)
    return found


def names() -> tuple[str, ...]:
    """The names of all planners there are: built in, registered, installed."""
    return tuple(
        dict.fromkeys((*BUILT_IN, *_registered, *(name for name in installed() if name not in PROMISED)))
    )


def known(name: str) -> bool:
    """Whether there is a planner of that name."""
    return name in BUILT_IN or name in names()
