"""How the road view is drawn: its colours, and whether with boxes, figures, path and forecast."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Theme = Literal["dark", "light"]


@dataclass(frozen=True, slots=True)
class Look:
    """What a viewer chooses of the road view; the picture of the road itself is the same."""

    theme: Theme = "dark"
    boxes: bool = True
    """Bounding boxes around what moves."""
    figures: bool = True
    """The strip of figures along the upper edge, and the result across the middle."""
    path: bool = True
    """The way behind the ego, its move under way and, while nothing moves, its next one."""
    forecast: bool = False
    """Where movers are expected in the next ticks."""


PLAIN = Look()
