"""Which sensors there are, by name: a leaf, so that a configuration can be checked without loading one."""

from __future__ import annotations

from typing import Final, get_args

from sim.actions import SensorName

BUILT_IN: Final = ("perfect",)
"""Names of the sensors that come with the project (`sim.perceive`)."""
PROMISED: Final = tuple(name for name in get_args(SensorName) if name not in BUILT_IN)
"""Names that people may say and this version has not."""

_registered: list[str] = []


def claim(name: str) -> None:
    """Take a name for a sensor. Raises `ValueError` if it is taken or promised."""
    if name in _registered or name in PROMISED:
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
