"""How each planner drives, as counted on many roads by `tools.planner_character`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

from sim.planner_names import canonical

FILE: Final = Path(__file__).with_suffix(".json")


@dataclass(frozen=True, slots=True)
class Character:
    """The figures of one planner; all planners drove the same roads, one episode each."""

    planner: str
    roads: int
    arrived: int
    crashed: int
    stuck: int
    moves: Mapping[str, float]
    """shares of the moves on its arrivals: `forward`, `diagonal`, `sideways`, `stay`"""
    arrival_s: float
    """mean seconds of its arrivals"""
    lost_s: float
    """mean seconds that an arrival took more than the quickest way"""


def characters() -> dict[str, Character]:
    """The figures of all planners that were counted, by name."""
    return {planner: Character(planner, **figures) for planner, figures in _read()["planners"].items()}


def command() -> str:
    """The command that made the figures."""
    return str(_read()["command"])


def character_of(planner: str) -> Character | None:
    """The figures of a planner; None where it was not counted."""
    return characters().get(canonical(planner))


@cache
def _read() -> Any:
    return json.loads(FILE.read_text(encoding="utf-8"))
