"""Draws the log: a line of text per event, with its tick; the newest last."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import pygame

from sim.render import theme
from sim.render.labels import label
from sim.render.text import render_text, text_width, wrap_text

TEXT_PX = 19
LINE_PX = 18
GAP_PX = 4
EMPTY = "Nothing has happened yet."


class Line(Protocol):
    """A line of the log."""

    @property
    def tick(self) -> int | str:
        """The tick of the event, or the ticks."""

    @property
    def type(self) -> str:
        """The type of the event; it decides the colour."""

    @property
    def text(self) -> str:
        """The event in words."""


def draw_log(lines: Sequence[Line], size: tuple[int, int], back: int = 0) -> pygame.Surface:
    """Draws the lines that fit, the newest at the bottom; skips the `back` newest lines."""
    picture = pygame.Surface(size)
    picture.fill(theme.BODY)
    if not lines:
        picture.blit(render_text(label(EMPTY), TEXT_PX, theme.TEXT_QUIET), (10, 8))
        return picture
    width, y = size[0], size[1] - GAP_PX
    shown = lines[: len(lines) - back] if back else lines
    gutter = max(
        text_width("00000", TEXT_PX - 3), text_width(str(shown[-1].tick), TEXT_PX - 3) if shown else 0
    )
    room = max(20, width - gutter - 24)
    broken: list[tuple[Line, tuple[str, ...]]] = []
    for number, line in enumerate(reversed(shown)):
        parts = wrap_text(line.text, TEXT_PX, room)
        y -= len(parts) * LINE_PX + GAP_PX
        if y < 0 and number:
            break
        broken.append((line, parts))
    # Lines that all fit start at the top; others end at the bottom.
    high = sum(len(parts) * LINE_PX + GAP_PX for _, parts in broken)
    y = GAP_PX if len(broken) == len(shown) and high <= size[1] - GAP_PX else size[1] - high
    for line, parts in reversed(broken):
        colour = theme.LINES.get(line.type, theme.TEXT)
        tick = render_text(str(line.tick), TEXT_PX - 3, theme.TEXT_QUIET)
        picture.blit(tick, (8 + gutter - tick.get_width(), y + 2))
        for row, part in enumerate(parts):
            picture.blit(render_text(part, TEXT_PX, colour), (16 + gutter, y + row * LINE_PX))
        y += len(parts) * LINE_PX + GAP_PX
    return picture
