"""Validates the keyword arguments of the environments; each error names the argument and what is allowed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields
from difflib import get_close_matches
from math import isfinite
from numbers import Integral, Real
from typing import Any

from sim.config import Config, ConfigError, Problem


def refuse_unknown(maker: str, unknown: Iterable[str], known: Iterable[str]) -> None:
    """Raises `TypeError` if there are unknown arguments; it names the first, with a suggestion."""
    allowed = sorted(known)
    for name in sorted(unknown):
        near = get_close_matches(name, allowed, n=1)
        settings = [field.name for field in fields(Config)]
        setting = [name] if name in settings else get_close_matches(name, settings, n=1, cutoff=0.8)
        meant = f"; did you mean {near[0]}?" if near else ""
        if not near and setting:
            meant = f"; did you mean config={{{setting[0]!r}: …}}?"
        raise TypeError(f"{maker} takes no argument {name!r}{meant} It takes {', '.join(allowed)}.")


def road_config(parts: Mapping[str, Any] | None) -> Config:
    """Returns the configuration with these settings.

    Raises `ConfigError` for invalid settings and for a seed, `TypeError` for anything but a mapping.
    """
    if parts is not None and not isinstance(parts, Mapping):
        raise TypeError(f"config is a mapping of settings to values, not {parts!r}")
    if parts is not None and "seed" in parts:
        raise ConfigError((Problem("seed", "is_given_to_reset"),))
    return Config().with_parts(**(parts or {}))


def number(name: str, value: object, low: float = 0.0, high: float = float("inf")) -> float:
    """Returns a finite number from `low` to `high` as a float. Raises `ValueError` for other values."""
    if isinstance(value, bool) or not isinstance(value, Real) or not isfinite(value):
        raise ValueError(f"{name} must be a finite number, not {value!r}")
    found = float(value)
    if not low <= found <= high:
        most = f"at most {high:g} and " if isfinite(high) else ""
        raise ValueError(f"{name} must be {most}at least {low:g}, not {value!r}")
    return found


def whole_number(name: str, value: object, low: int, high: int | None = None) -> int:
    """Returns an integer from `low` to `high`. Raises `ValueError` for other values."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise ValueError(f"{name} must be a whole number, not {value!r}")
    found = int(value)
    if found < low or (high is not None and found > high):
        most = "" if high is None else f" and at most {high}"
        raise ValueError(f"{name} must be at least {low}{most}, not {value!r}")
    return found


def boolean(name: str, value: object) -> bool:
    """Returns True or False. Raises `ValueError` for other values."""
    if not isinstance(value, bool):
        raise ValueError(f"{name} must be True or False, not {value!r}")
    return value


def one_of(name: str, value: object, choices: Iterable[str]) -> str:
    """Returns one of the words in `choices`. Raises `ValueError` for others, with a suggestion."""
    allowed = list(choices)
    if isinstance(value, str) and value in allowed:
        return value
    near = get_close_matches(str(value), allowed, n=1)
    meant = f"; did you mean {near[0]!r}?" if near else ""
    raise ValueError(f"there is no {name} {value!r}{meant} There are {', '.join(map(repr, allowed))}.")


def reset_options(options: Mapping[str, Any] | None, known: Iterable[str] = ()) -> Mapping[str, Any]:
    """Returns the options of a reset. Raises `ValueError` for unknown ones."""
    given = options or {}
    allowed = sorted(known)
    for name in given:
        if name not in allowed:
            there_is = ", ".join(allowed) if allowed else "none"
            raise ValueError(f"reset takes no option {name!r}; there is {there_is}")
    return given
