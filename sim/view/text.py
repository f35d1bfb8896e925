"""Letters: pygame's own font, so that a picture is the same on every machine."""

from __future__ import annotations

from functools import lru_cache

import pygame

from sim.view.theme import Colour


@lru_cache(maxsize=32)
def _font(px: int) -> pygame.font.Font:
    if not pygame.font.get_init():
        pygame.font.init()
    return pygame.font.Font(None, px)


@lru_cache(maxsize=256)
def written(text: str, px: int, colour: Colour) -> pygame.Surface:
    """A line of text, `px` pixels high."""
    return _font(max(8, px)).render(text, True, colour)
