"""Renders text in pygame's built-in font, so that a picture is the same on every machine.

Arrows, which that font lacks, are drawn as lines. Other missing letters use a system font.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import groupby

import pygame

from sim.render.theme import Colour

SMALLEST_PX = 8
_MISSING = "\uffff"
"""A code point without a glyph in any font: its picture is that of a missing glyph."""
_WIDE = (
    "notosanscjkjp,notosanscjksc,wenquanyizenhei,microsoftyahei,applesdgothicneo,dejavusans,arialunicodems"
)


FINER = 2
"""Text is rendered this many times larger and scaled down, which evens out the spacing of letters."""
ARROWS = {"→": (1, 0), "←": (-1, 0), "↑": (0, -1), "↓": (0, 1)}


@lru_cache(maxsize=64)
def _font(px: int, wide: bool = False) -> pygame.font.Font:
    if not pygame.font.get_init():
        pygame.font.init()
    if wide:
        return pygame.font.SysFont(_WIDE, px * 3 // 4)
    return pygame.font.Font(None, px)


@lru_cache(maxsize=1_024)
def _is_missing(letter: str) -> bool:
    """Whether pygame's font has no glyph for a letter."""
    font, white = _font(20), (255, 255, 255)
    shown, empty = (font.render(each, False, white) for each in (letter, _MISSING))
    return pygame.image.tobytes(shown, "RGBA") == pygame.image.tobytes(empty, "RGBA")


def _font_runs(text: str) -> Iterator[tuple[str, bool]]:
    """Splits a text into (run, needs the system font); arrows are runs of their own, since they are drawn."""
    if text.isascii():
        yield text, False
        return

    def sort(letter: str) -> str:
        return letter if letter in ARROWS else "" if letter.isascii() or not _is_missing(letter) else "wide"

    for kind, letters in groupby(text, sort):
        yield "".join(letters), kind == "wide"


@lru_cache(maxsize=1_024)
def render_text(text: str, px: int, colour: Colour) -> pygame.Surface:
    """Renders a line of text, `px` pixels high. Unprintable characters become spaces."""
    px = max(SMALLEST_PX, px)
    shown = "".join(letter if letter.isprintable() else " " for letter in text)
    parts = [_render_run(part, wide, px * FINER, colour) for part, wide in _font_runs(shown)]
    height = _font(px * FINER).get_height()
    whole = pygame.Surface((sum(part.get_width() for part in parts), height), pygame.SRCALPHA)
    whole.fill((*colour, 0))
    x = 0
    for part in parts:
        whole.blit(part, (x, (height - part.get_height()) // 2))
        x += part.get_width()
    size = (-(-x // FINER), height // FINER)
    return pygame.transform.smoothscale(whole, size) if x else pygame.Surface((0, size[1]), pygame.SRCALPHA)


def _render_run(part: str, wide: bool, px: int, colour: Colour) -> pygame.Surface:
    if part[:1] not in ARROWS:
        return _font(px, wide).render(part, True, colour)
    side = px * 3 // 5
    drawn = pygame.Surface((side * len(part), side), pygame.SRCALPHA)
    drawn.fill((*colour, 0))
    for number, letter in enumerate(part):
        _arrow(drawn, pygame.Vector2(side * (number + 0.5), side / 2), ARROWS[letter], side, colour)
    return drawn


def _arrow(
    picture: pygame.Surface, middle: pygame.Vector2, way: tuple[int, int], side: int, colour: Colour
) -> None:
    along = pygame.Vector2(way)
    across = pygame.Vector2(-along.y, along.x)
    tip, tail = middle + along * side * 0.42, middle - along * side * 0.42
    pygame.draw.line(picture, colour, tail, tip, max(1, side // 8))
    for turn in (-1, 1):
        barb = tip - along * side * 0.28 + across * side * 0.26 * turn
        pygame.draw.line(picture, colour, tip, barb, max(1, side // 8))


@lru_cache(maxsize=8_192)
def text_width(text: str, px: int) -> int:
    """The width of a line of text, in pixels."""
    px = max(SMALLEST_PX, px) * FINER
    wide = (
        px * 3 // 5 * len(part) if part[0] in ARROWS else _font(px, fallback).size(part)[0]
        for part, fallback in _font_runs(text)
        if part
    )
    return -(-sum(wide) // FINER)


@lru_cache(maxsize=512)
def wrap_text(text: str, px: int, width: int) -> tuple[str, ...]:
    """Breaks a text into lines of at most `width` pixels: at spaces, and within words that are too long."""
    lines: list[str] = []
    for paragraph in text.split("\n"):
        line = ""
        for word in paragraph.split(" "):
            longer = f"{line} {word}" if line else word
            if text_width(longer, px) <= width:
                line = longer
                continue
            if line:
                lines.append(line)
            line = word
            while text_width(line, px) > width and len(line) > 1:
                fits = len(truncate(line, px, width, ""))
                lines.append(line[:fits])
                line = line[fits:]
        lines.append(line)
    return tuple(lines)


@lru_cache(maxsize=512)
def truncate(text: str, px: int, width: int, mark: str = "…") -> str:
    """Shortens a text to `width` pixels, at least one letter, and appends `mark` if it is shortened."""
    if text_width(text, px) <= width:
        return text
    low, high = 1, max(1, len(text) - 1)
    while low < high:
        middle = (low + high + 1) // 2
        if text_width(text[:middle].rstrip() + mark, px) <= width:
            low = middle
        else:
            high = middle - 1
    return text[:low].rstrip() + mark if mark else text[:low]
