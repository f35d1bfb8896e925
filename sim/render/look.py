"""How the road view is drawn: by day colours or dark ones, with or without boxes and figures."""

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
    """The strip of figures along the upper edge."""


PLAIN = Look()
