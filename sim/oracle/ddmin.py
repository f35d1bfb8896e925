"""Leaving out of a set what can be spared (delta debugging; Zeller & Hildebrandt, 2002)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

Item = TypeVar("Item")


def ddmin(names: Sequence[Item], holds: Callable[[Sequence[Item]], bool]) -> list[Item]:
    """What is left of `names` when all that can be spared (the last first) is, one by one in the end.

    `holds` is true of `names`, and of the answer.
    """
    kept = list(names)
    size = len(kept)
    while size:
        dropped = False
        for end in range(len(kept), 0, -size):
            fewer = kept[: max(0, end - size)] + kept[end:]
            if holds(fewer):
                kept, dropped = fewer, True
        if not (dropped and size == 1):
            size //= 2
    return kept
