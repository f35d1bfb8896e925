"""The line to talk in, the reply under it, and what is offered to go on with."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

import pygame

from service.window import theme as look
from service.window.exchange import Exchange, told
from service.window.panels import PANELS, Panels, title
from service.window.text_input import Line
from service.window.texts import table, text
from sim.render import theme
from sim.render.text import render_text, text_width, truncate, wrap_text

FIELD_PX: Final = 38
BAR_PX: Final = 24
SIZES: Final = (look.TEXT_PX, 19, 18)
"""of the letters of a reply, which are as far apart as they are high"""
"""What a newcomer is offered."""


@dataclass
class Console:
    """All there is to talking, besides understanding."""

    line: Line = field(default_factory=Line)
    focused: bool = False
    latest: Exchange | None = None
    picked: int = -1
    """which of the offers stands in the line"""
    scroll: int = 0
    spots: list[tuple[pygame.Rect, tuple[str, str]]] = field(default_factory=list)
    """what can be clicked, where it was drawn: ("say" or "toggle" or "focus" or "help", what)"""

    @property
    def offers(self) -> tuple[str, ...]:
        """Sentences that can be picked now."""
        return self.latest.offers if self.latest is not None else ()

    @property
    def untouched(self) -> bool:
        """Whether nothing has been written since the latest reply."""
        said = self.latest.said if self.latest is not None else None
        return self.line.text in ("", said) or self.line.text in self.offers

    def take(self, exchange: Exchange) -> None:
        """Show what came of what was said; ↑ brings back what was refused, to be put right."""
        self.latest, self.picked, self.scroll = exchange, -1, 0

    def pick(self, by: int) -> bool:
        """The next of the offers into the line, or the one before; False where there is none."""
        if not self.offers or not self.untouched or self.picked + by < -1:
            return False
        self.picked = min(self.picked + by, len(self.offers) - 1)
        said = self.latest.said if self.latest is not None else None
        self.line.set(self.offers[self.picked] if self.picked >= 0 else said or "")
        return True

    def chosen(self, digit: str) -> str | None:
        """The offer with this number, where one is asked about."""
        if self.latest is None or not self.latest.asks or not self.untouched or not digit.isdecimal():
            return None
        number = int(digit)
        return self.offers[number - 1] if 1 <= number <= len(self.offers) else None

    def key(self, panels: Panels, busy: bool, now_s: float) -> tuple[object, ...]:
        """What its picture depends on."""
        blink = self.focused and int(now_s * 2) % 2
        dots = int(now_s * 3) % 4 if busy else None
        line = self.line
        return (
            line.text,
            line.cursor,
            line.composing,
            self.focused,
            blink,
            dots,
            self.latest,
            self.picked,
            self.scroll,
            frozenset(panels.shown),
            panels.large,
        )


def draw_console(
    console: Console, panels: Panels, size: tuple[int, int], *, busy: bool, now_s: float
) -> pygame.Surface:
    """The console in `size`; its spots are where it can be clicked, from its corner."""
    picture = pygame.Surface(size)
    picture.fill(look.GROUND)
    console.spots = []
    _draw_field(picture, console, busy=busy, now_s=now_s)
    room = pygame.Rect(0, FIELD_PX + 8, size[0], max(0, size[1] - FIELD_PX - BAR_PX - 14))
    if room.height >= look.LINE_PX:
        area = picture.subsurface(room.clip(picture.get_rect()))
        _draw_reply(area, console, room.topleft)
    _draw_bar(picture, console, panels)
    return picture


def _draw_field(picture: pygame.Surface, console: Console, *, busy: bool, now_s: float) -> None:
    line, width = console.line, picture.get_width()
    box = pygame.Rect(0, 0, width, min(FIELD_PX, picture.get_height()))
    pygame.draw.rect(picture, look.FIELD, box, border_radius=8)
    pygame.draw.rect(picture, look.ACCENT if console.focused else look.EDGE, box, 2, border_radius=8)
    console.spots.append((box, ("focus", "")))
    px, x0 = 23, 34
    pygame.draw.polygon(
        picture,
        look.ACCENT if console.focused else theme.TEXT_QUIET,
        [(14, box.centery - 6), (22, box.centery), (14, box.centery + 6)],
    )
    room = pygame.Rect(x0, 4, max(1, width - x0 - 40), box.height - 8)
    if not line.text and not line.composing and not console.focused:
        hint = render_text(truncate(text("console", "prompt"), px, room.width), px, theme.TEXT_QUIET)
        picture.blit(hint, hint.get_rect(midleft=(x0, box.centery + 1)))
    before = line.text[: line.cursor] + line.composing
    caret = text_width(before, px)
    shift = max(0, caret - room.width + 4)
    clip = picture.get_clip()
    picture.set_clip(room)
    whole = before + line.text[line.cursor :]
    if whole:
        sign = render_text(whole, px, theme.TEXT)
        spot = sign.get_rect(midleft=(x0 - shift, box.centery + 1))
        picture.blit(sign, spot)
        if line.composing:
            start = x0 - shift + text_width(line.text[: line.cursor], px)
            pygame.draw.line(picture, look.ACCENT, (start, spot.bottom), (x0 - shift + caret, spot.bottom), 2)
    if console.focused and int(now_s * 2) % 2 == 0:
        picture.fill(look.ACCENT, (x0 - shift + caret, box.centery - 11, 2, 22))
    picture.set_clip(clip)
    if busy:
        for dot in range(int(now_s * 3) % 4):
            pygame.draw.circle(picture, look.ACCENT, (width - 34 + dot * 9, box.centery), 3)


def _draw_reply(area: pygame.Surface, console: Console, corner: tuple[int, int]) -> None:
    """What came of the latest; as much as there is room for, from `scroll` lines on."""
    exchange = console.latest
    width, height = area.get_size()
    if exchange is None:
        x = _words(area, text("console", "try"), 4, 7, theme.TEXT_QUIET) + 10
        _draw_offers(area, console, tuple(table("console", "first")), x, 2, corner, wrap_x=4)
        return
    said = "" if exchange.said is None else text("console", "said", text=exchange.said)
    y = 2
    if said:
        _words(area, truncate(said, look.SMALL_PX, width - 8), 4, y, theme.TEXT_QUIET, look.SMALL_PX)
        y += 19
    below = 28 if exchange.changes or exchange.offers else 0
    room = height - y - below
    # A long reply is written smaller before it has to be scrolled.
    px = next((px for px in SIZES if len(wrap_text(exchange.reply, px, width - 12)) * px <= room), SIZES[-1])
    lines, line_px = wrap_text(exchange.reply, px, width - 12), px
    fits = max(1, room // line_px)
    console.scroll = max(0, min(console.scroll, len(lines) - fits))
    ink = theme.TEXT if exchange.done else theme.LINES["held_back"] if exchange.asks else theme.REFUSED
    for line in lines[console.scroll : console.scroll + fits]:
        _words(area, line, 4, y, ink, px)
        y += line_px
    if len(lines) > fits:
        _draw_more(area, console.scroll, fits, len(lines))
    y += 4
    if exchange.changes:
        x = 4
        for change in exchange.changes:
            shape = look.chip(told(change), look.CAP, theme.TEXT)
            if x + shape.get_width() > width - 110:
                break
            area.blit(shape, (x, y))
            x += shape.get_width() + 8
        if x > 4:
            cap = look.key_cap("Ctrl-Z")
            area.blit(cap, (x + 2, y + 3))
            _words(
                area,
                text("console", "undo"),
                x + cap.get_width() + 10,
                y + 4,
                theme.TEXT_QUIET,
                look.SMALL_PX,
            )
    elif exchange.offers:
        _draw_offers(area, console, exchange.offers, 4, y, corner, numbered=exchange.asks)


def _draw_offers(
    area: pygame.Surface,
    console: Console,
    offers: tuple[str, ...],
    x: int,
    y: int,
    corner: tuple[int, int],
    *,
    wrap_x: int = 4,
    numbered: bool = False,
) -> None:
    for number, offer in enumerate(offers):
        label = truncate(
            f"{number + 1}  {offer}" if numbered else offer, look.SMALL_PX, area.get_width() - 40
        )
        here = number == console.picked
        shape = look.chip(label, look.ACCENT if here else look.CAP, theme.TEXT)
        if x + shape.get_width() > area.get_width() and x > wrap_x:
            x, y = wrap_x, y + shape.get_height() + 4
        if y + shape.get_height() > area.get_height():
            return
        spot = area.blit(shape, (x, y))
        console.spots.append((spot.move(corner), ("say", offer)))
        x = spot.right + 8


def _draw_more(area: pygame.Surface, first: int, fits: int, count: int) -> None:
    """A bar at the side, for a reply that is longer than its room."""
    height = area.get_height()
    top, length = height * first // count, max(8, height * fits // count)
    pygame.draw.rect(area, look.EDGE, (area.get_width() - 4, top, 4, length), border_radius=2)


def _draw_bar(picture: pygame.Surface, console: Console, panels: Panels) -> None:
    """The views, each with its key; those that are hidden are dim."""
    width, y, x = picture.get_width(), picture.get_height() - BAR_PX, 0
    roomy = width >= 640
    for number, name in enumerate(PANELS):
        on = name in panels.visible
        cap = look.key_cap(f"F{number + 1}")
        label = render_text(title(name), look.SMALL_PX, theme.TEXT if on else theme.TEXT_QUIET)
        room = cap.get_width() + (label.get_width() + 6 if roomy else 0)
        spot = pygame.Rect(x, y, room, BAR_PX)
        if spot.right > width - 70:
            break
        picture.blit(cap, cap.get_rect(midleft=(x, spot.centery)))
        if roomy:
            picture.blit(label, label.get_rect(midleft=(x + cap.get_width() + 6, spot.centery + 1)))
        if on:
            picture.fill(look.ACCENT, (x, spot.bottom - 2, room, 2))
        console.spots.append((spot, ("toggle", name)))
        x = spot.right + 14
    label = render_text(text("console", "help"), look.SMALL_PX, theme.TEXT_QUIET)
    cap = look.key_cap("?")
    spot = pygame.Rect(width - label.get_width() - cap.get_width() - 6, y, 0, BAR_PX)
    spot.width = width - spot.x
    if spot.x > x:
        picture.blit(cap, cap.get_rect(midleft=(spot.x, spot.centery)))
        picture.blit(label, label.get_rect(midright=(width, spot.centery + 1)))
        console.spots.append((spot, ("help", "")))


def _words(
    area: pygame.Surface,
    text: str,
    x: int,
    y: int,
    colour: tuple[int, int, int],
    px: int = look.TEXT_PX,
) -> int:
    sign = render_text(text, px, colour)
    area.blit(sign, (x, y))
    return x + sign.get_width()
