"""Which sensors there are, by name: a leaf, so that a configuration can be checked without loading one."""

from __future__ import annotations

from typing import Final, Literal, get_args

SensorName = Literal["perfect", "camera", "lidar", "radar", "fusion"]
"""Names of the sensors that come with the project (`sim.perceive`), which may be said in an action."""

DEFAULT_SENSOR: Final = "perfect"
BUILT_IN: Final[tuple[str, ...]] = get_args(SensorName)

_registered: list[str] = []


def claim(name: str) -> None:
    """Take a name for a sensor. Raises `ValueError` if it is taken."""
    if name in _registered:
        raise ValueError(f"there is already a sensor called {name!r}")
    _registered.append(name)


def release(name: str) -> None:
    """Give back a name that a program registered. Raises `ValueError` for a built-in one and for none."""
    if name in BUILT_IN or name not in _registered:
        raise ValueError(f"no sensor {name!r} was registered")
    _registered.remove(name)


def names() -> tuple[str, ...]:
    """The names of all sensors there are: built in, then registered."""
    return tuple(dict.fromkeys((*BUILT_IN, *_registered)))
