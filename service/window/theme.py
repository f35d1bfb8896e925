"""Colours, and the few shapes that everything in the window is made of."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import pygame

from sim.render import theme
from sim.render.text import render_text, text_width, truncate
from sim.render.theme import Colour

GROUND: Final[Colour] = (13, 15, 18)
HEAD: Final[Colour] = (33, 37, 44)
EDGE: Final[Colour] = (50, 56, 66)
FIELD: Final[Colour] = (18, 21, 26)
ACCENT: Final[Colour] = theme.AV
CARD: Final[Colour] = (27, 31, 37)
CAP: Final[Colour] = (44, 49, 58)

TITLE_PX: Final = 21
LEAST_TITLE_PX: Final = 17
HIDE_ROOM: Final = 26
"""beside a title, for the cross that hides it"""
TEXT_PX: Final = 21
SMALL_PX: Final = 18
LINE_PX: Final = 21


def title_bar(width: int, title: str, key: str, status: str, *, large: bool, height: int) -> pygame.Surface:
    """A panel's title, with its key and a cross to hide it."""
    bar = pygame.Surface((width, height))
    bar.fill(HEAD)
    bar.fill(ACCENT if large else EDGE, (0, height - 1, width, 1))
    px, start = TITLE_PX, 10 if width > 140 else 6
    while px > LEAST_TITLE_PX and text_width(title, px) > width - HIDE_ROOM - start:
        px -= 1
    left = _put(bar, truncate(title, px, max(8, width - HIDE_ROOM - start)), px, theme.TEXT, start, height)
    cross = pygame.Rect(0, 0, 8, 8)
    cross.center = (width - 13, height // 2)
    for corner, other in ((cross.topleft, cross.bottomright), (cross.bottomleft, cross.topright)):
        pygame.draw.line(bar, theme.TEXT_QUIET, corner, other, 2)
    cap = key_cap(key)
    x = width - HIDE_ROOM - cap.get_width()
    if x > left + 4:
        bar.blit(cap, (x, (height - cap.get_height()) // 2))
        room = x - left - 28
        if status and text_width(status, SMALL_PX) <= room:
            told = status
            _put(bar, told, SMALL_PX, theme.TEXT_QUIET, x - 12 - text_width(told, SMALL_PX), height)
    return bar


@lru_cache(maxsize=64)
def key_cap(key: str, px: int = 16) -> pygame.Surface:
    """A key as it looks on a keyboard."""
    sign = render_text(key, px, theme.TEXT)
    cap = pygame.Surface((sign.get_width() + 12, px + 2), pygame.SRCALPHA)
    pygame.draw.rect(cap, CAP, cap.get_rect(), border_radius=4)
    pygame.draw.rect(cap, EDGE, cap.get_rect(), 1, border_radius=4)
    cap.blit(sign, sign.get_rect(center=(cap.get_width() // 2, cap.get_height() // 2 + 1)))
    return cap


def chip(text: str, paper: Colour, ink: Colour, px: int = SMALL_PX) -> pygame.Surface:
    """A few words on a rounded ground."""
    sign = render_text(text, px, ink)
    shape = pygame.Surface((sign.get_width() + 16, px + 5), pygame.SRCALPHA)
    pygame.draw.rect(shape, paper, shape.get_rect(), border_radius=(px + 5) // 2)
    shape.blit(sign, sign.get_rect(center=(shape.get_width() // 2, shape.get_height() // 2 + 1)))
    return shape


def card(size: tuple[int, int], edge: Colour = EDGE) -> pygame.Surface:
    """An empty card, to lie over everything."""
    shape = pygame.Surface(size, pygame.SRCALPHA)
    pygame.draw.rect(shape, (*CARD, 255), shape.get_rect(), border_radius=12)
    pygame.draw.rect(shape, (*edge, 255), shape.get_rect(), 2, border_radius=12)
    return shape


def _put(picture: pygame.Surface, text: str, px: int, colour: Colour, x: int, height: int) -> int:
    """A word in the middle of a bar; where it ends."""
    sign = render_text(text, px, colour)
    picture.blit(sign, (x, (height - sign.get_height()) // 2 + 1))
    return x + sign.get_width()
