"""Cards that lie over everything: the keys with sentences to try, and the question before leaving."""

from __future__ import annotations

from typing import Final

import pygame

from service.window import theme as look
from service.window.keys import examples, key_groups
from service.window.texts import text
from sim.render import theme
from sim.render.text import render_text, text_width, truncate

ROW_PX: Final = 25
SMALL_ROW_PX: Final = 20
PAD: Final = 24

Spots = list[tuple[pygame.Rect, tuple[str, str]]]


def draw_help(size: tuple[int, int]) -> tuple[pygame.Surface, Spots]:
    """All keys, and sentences that can be clicked; `size` is the window's. Spots count from its corner."""
    wide = size[0] >= 1_100
    small = not wide or size[1] < 720
    row = SMALL_ROW_PX if small else ROW_PX
    px = row - 4
    blocks, sentences = key_groups(), examples()
    width = min(size[0] - 24, 1_060 if wide else 780)
    columns = 2
    column = (width - PAD * (columns + 1)) // columns
    left = sum(len(keys) + 2 for _, keys in blocks[:2])
    right = len(blocks[2][1]) + 2 + len(sentences) + 2
    height = min(size[1] - 24, 58 + max(left, right) * row + PAD)
    shape = look.card((width, height))
    title = render_text(text("help", "title"), 30 if not small else 25, theme.TEXT)
    shape.blit(title, (PAD, 18))
    close = look.key_cap("Esc")
    shape.blit(close, (width - PAD - close.get_width(), 20))
    corner = ((size[0] - width) // 2, (size[1] - height) // 2)
    y = 58
    for name, keys in blocks[:2]:
        y = _group(shape, name, keys, PAD, y, column, row, px)
    x = PAD * 2 + column
    y = _group(shape, *blocks[2], x, 58, column, row, px)
    y = _head(shape, text("help", "sentences"), x, y, row, px)
    spots: Spots = []
    for example in sentences:
        sign = render_text(truncate(example, px, column), px, theme.LINES["changed"])
        spot = shape.blit(sign, (x, y + (row - sign.get_height()) // 2))
        spots.append(
            (pygame.Rect(x, y, column, row).move(corner).clip(spot.move(corner)), ("write", example))
        )
        y += row
    return shape, spots


def _head(shape: pygame.Surface, name: str, x: int, y: int, row: int, px: int) -> int:
    sign = render_text(name, px + 2, look.ACCENT)
    shape.blit(sign, (x, y + row // 4))
    return y + row + row // 4


def _group(
    shape: pygame.Surface,
    name: str,
    keys: tuple[tuple[str, str], ...],
    x: int,
    y: int,
    width: int,
    row: int,
    px: int,
) -> int:
    y = _head(shape, name, x, y, row, px)
    caps = max(look.key_cap(key, px - 3).get_width() for key, _ in keys) + 12
    for key, what in keys:
        cap = look.key_cap(key, px - 3)
        shape.blit(cap, (x, y + (row - cap.get_height()) // 2))
        sign = render_text(truncate(what, px, width - caps), px, theme.TEXT)
        shape.blit(sign, (x + caps, y + (row - sign.get_height()) // 2 + 1))
        y += row
    return y + row // 2


def draw_quit(size: tuple[int, int]) -> tuple[pygame.Surface, Spots]:
    """Whether to leave."""
    width, height = min(420, size[0] - 16), 132
    shape = look.card((width, height), look.ACCENT)
    title = render_text(text("quit", "question"), 30, theme.TEXT)
    shape.blit(title, title.get_rect(midtop=(width // 2, 24)))
    corner = ((size[0] - width) // 2, (size[1] - height) // 2)
    spots: Spots = []
    words = {spot: text("quit", "answers", spot) for _, spot in _ANSWERS}
    room = sum(look.key_cap(key, 20).get_width() + text_width(words[spot], 21) for key, spot in _ANSWERS) + 44
    x = (width - room) // 2
    for key, spot in _ANSWERS:
        cap = look.key_cap(key, 20)
        start = x
        shape.blit(cap, (x, 80))
        x += cap.get_width() + 8
        sign = render_text(words[spot], 21, theme.TEXT)
        shape.blit(sign, (x, 84))
        x += sign.get_width()
        spots.append((pygame.Rect(start, 74, x - start, 34).move(corner), (spot, "")))
        x += 28
    return shape, spots


_ANSWERS: Final = (("Enter", "quit"), ("Esc", "stay"))
