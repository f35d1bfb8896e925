"""How things glide between two ticks. Presentation only: no rule depends on it."""

from __future__ import annotations

from typing import Final

STEP_FRAMES: Final = 30
"""frames from one tick to the next at 60 frames a second and `step_seconds` 0.5"""


def eased(phase: float) -> float:
    """f(t) = t²(3 − 2t): the share of the way gone after the share `phase` of the time."""
    share = min(1.0, max(0.0, phase))
    return share * share * (3.0 - 2.0 * share)


def between(start: float, end: float, share: float) -> float:
    """The value that share of the way from `start` to `end`."""
    return start + (end - start) * share
