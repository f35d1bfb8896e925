"""Draws pictures of a world with pygame. Only this package imports pygame, and no window is needed.

`render` draws a picture, `encode` turns it into a file's bytes. Drawing knows nothing of where pictures go.
Importing this package does not import pygame; drawing does.
"""

from __future__ import annotations

from collections.abc import Sequence
from os import environ
from typing import TYPE_CHECKING

from sim.render.look import PLAIN, Look, Theme
from sim.render.motion import STEP_FRAMES, smoothstep
from sim.render.theme import MAX_SIDE_PX

if TYPE_CHECKING:
    import numpy as np
    import pygame
    from numpy.typing import NDArray

    from sim.plan import Decision
    from sim.state import SimState
    from sim.types import Cell
    from sim.world import World

VIEWS = ("road", "schematic")
FORMATS = ("png", "jpeg", "webp")
MIN_SIDE_PX = 64
"""Shortest side of a picture, in pixels."""

__all__ = [
    "FORMATS",
    "MAX_SIDE_PX",
    "MIN_SIDE_PX",
    "STEP_FRAMES",
    "VIEWS",
    "Look",
    "Theme",
    "encode",
    "pixels",
    "render",
    "smoothstep",
]


def render(
    view: str,
    state: SimState,
    *,
    before: World | None = None,
    decision: Decision | None = None,
    phase: float = 1.0,
    size: tuple[int, int] | None = None,
    ego: str | None = None,
    look: Look = PLAIN,
    trail: Sequence[Cell] = (),
    coming: Decision | None = None,
) -> pygame.Surface:
    """Draws a state in one of the `VIEWS`.

    `before` is the world one tick earlier: things glide from it to the present as `phase` goes from 0 to 1.
    `decision` is the decision taken in `before`. `ego`: the one that the road view follows, the first by
    default. `look`: its colours and marks. `trail`: cells that the ego came through, the oldest first.
    `coming`: the decision that the state leads to, for a picture in which nothing moves. `size` is the
    largest (width, height) in pixels; the picture keeps its aspect ratio. Raises `ValueError` for an unknown
    view and for a size out of range.
    """
    environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    from sim.render.road_view import draw_road
    from sim.render.schematic import draw_schematic

    if size is not None and not all(MIN_SIDE_PX <= side <= MAX_SIDE_PX for side in size):
        raise ValueError(f"the sides of a picture are {MIN_SIDE_PX} to {MAX_SIDE_PX} pixels, not {size}")
    if view == "road":
        return draw_road(state, before, decision, phase, size, ego, look, trail, coming)
    if view == "schematic":
        return draw_schematic(state, size)
    raise ValueError(f"there is no view called {view!r}; there are {', '.join(VIEWS)}")


def encode(picture: pygame.Surface, form: str = "png") -> bytes:
    """Encodes a picture as PNG, JPEG or WebP. Raises `ValueError` for any other format."""
    from sim.render.files import encode_image

    if form not in FORMATS:
        raise ValueError(
            f"pictures can be had as {', '.join(FORMATS[:-1])} and {FORMATS[-1]}, not as {form!r}"
        )
    return encode_image(picture, form)


def pixels(picture: pygame.Surface) -> NDArray[np.uint8]:
    """Returns a picture as an array of RGB values (shape: height, width, 3)."""
    import numpy as np
    import pygame

    return np.ascontiguousarray(pygame.surfarray.array3d(picture).transpose(1, 0, 2))
