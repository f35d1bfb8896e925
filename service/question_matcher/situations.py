"""What a session is like while something is asked: the same words mean another question after a crash."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Final, Literal

Situation = Literal["running", "crash", "stuck", "arrived", "manual"]


@dataclass(frozen=True, slots=True)
class Now:
    """What a session is like while something is asked."""

    situations: frozenset[Situation] = frozenset()
    facts: frozenset[tuple[str, str]] = frozenset()
    """what is so without being said, by the mark of its slot: ("planner", "astar"), ("tick", "12")"""


UNKNOWN: Final = Now()
"""Of a question that is asked of no session."""

LEADS: Final[dict[Situation, str]] = {
    "manual": "by hand",
    "crash": "crashed",
    "stuck": "stuck",
    "arrived": "arrived",
    "running": "driving",
}
"""What the encoder reads before a question; of several situations the first counts."""


def led(text: str, situations: Collection[Situation]) -> str:
    """A question after its situation, as the encoder has learnt to read it; unchanged without one."""
    lead = next((lead for situation, lead in LEADS.items() if situation in situations), None)
    return text if lead is None else f"{lead}: {text}"
