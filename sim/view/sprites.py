"""Things seen from above, drawn once for each size and look, and kept.

Sprites are drawn at three times their size and smoothed down, since pygame's shapes have hard edges.
A pothole's rim and cracks follow from its id alone.
"""

from __future__ import annotations

from functools import lru_cache
from math import cos, pi, sin

import pygame

from sim.randomness import Stream
from sim.view import theme
from sim.view.theme import Colour

FINER = 3
_SPRITES = 512


@lru_cache(maxsize=_SPRITES)
def av_sprite(px: int) -> pygame.Surface:
    """The autonomous vehicle, facing up the road."""
    return _shadowed(_car(px, theme.AV, theme.AV_GLASS, lights=True))


def vehicle_sprite(px: int, look: int, heading: str, disabled: bool) -> pygame.Surface:
    """An obstacle vehicle facing `heading`; any number `look` picks its colour."""
    return _vehicle(
        px, theme.DISABLED if disabled else theme.VEHICLES[look % len(theme.VEHICLES)], heading, disabled
    )


@lru_cache(maxsize=_SPRITES)
def _vehicle(px: int, colour: Colour, heading: str, disabled: bool) -> pygame.Surface:
    sprite = _car(px, colour, theme.GLASS, lights=not disabled)
    return _shadowed(pygame.transform.rotate(sprite, 90 if heading == "left" else -90))


def pedestrian_sprite(px: int, look: int, heading: str, disabled: bool) -> pygame.Surface:
    """A pedestrian from above: shoulders, head, and a foot ahead; any number `look` picks the colour."""
    return _pedestrian(
        px, theme.DISABLED if disabled else theme.PEDESTRIANS[look % len(theme.PEDESTRIANS)], heading
    )


@lru_cache(maxsize=_SPRITES)
def _pedestrian(px: int, body: Colour, heading: str) -> pygame.Surface:
    canvas, unit = _canvas(px)
    centre = canvas.get_rect().center
    ahead = -1 if heading == "left" else 1
    _ellipse(
        canvas, (0, 0, 0, 70), (centre[0] + unit // 14, centre[1] + unit // 10), (unit * 0.24, unit * 0.34)
    )
    _ellipse(
        canvas,
        (*_darker(body, 0.5), 255),
        (centre[0] + ahead * unit * 0.1, centre[1] - unit * 0.1),
        (unit * 0.16, unit * 0.1),
    )
    _ellipse(canvas, (*body, 255), centre, (unit * 0.2, unit * 0.36))
    _ellipse(
        canvas, (*theme.SKIN, 255), (centre[0] + ahead * unit * 0.02, centre[1]), (unit * 0.16, unit * 0.17)
    )
    return _smoothed(canvas, px)


@lru_cache(maxsize=_SPRITES)
def barrier_sprite(px: int) -> pygame.Surface:
    """A striped barrier on two feet."""
    canvas, unit = _canvas(px)
    board = pygame.Rect(0, 0, int(unit * 0.8), int(unit * 0.26))
    board.center = canvas.get_rect().center
    shadow = board.move(unit // 26, unit // 14)
    pygame.draw.rect(canvas, (0, 0, 0, 90), shadow, border_radius=unit // 24)
    for x in (board.left + unit // 8, board.right - unit // 8):
        foot = pygame.Rect(0, 0, unit // 10, int(unit * 0.42))
        foot.center = (x, board.centery)
        pygame.draw.rect(canvas, (70, 74, 82), foot, border_radius=unit // 30)
    pygame.draw.rect(canvas, theme.BARRIER[1], board, border_radius=unit // 24)
    stripe = board.width // 6
    for n in range(-1, 7, 2):
        x = board.left + n * stripe
        shape = [
            (x, board.bottom),
            (x + stripe, board.bottom),
            (x + 2 * stripe, board.top),
            (x + stripe, board.top),
        ]
        inside = [(min(max(px_, board.left), board.right), py_) for px_, py_ in shape]
        pygame.draw.polygon(canvas, theme.BARRIER[0], inside)
    pygame.draw.rect(canvas, _darker(theme.BARRIER[0], 0.6), board, unit // 50, border_radius=unit // 24)
    return _smoothed(canvas, px)


@lru_cache(maxsize=_SPRITES)
def pothole_sprite(px: int, name: str) -> pygame.Surface:
    """A hole with a broken rim and cracks running from it, the same for the same id."""
    canvas, unit = _canvas(px)
    draws = Stream.of(0, name)
    centre = canvas.get_rect().center
    corners = 14

    def rim(radius: float, roughness: float, salt: int) -> list[tuple[float, float]]:
        rough = draws.narrow(salt)
        return [
            (
                centre[0]
                + unit * radius * (1 + roughness * (rough.uniform(n) - 0.5)) * cos(2 * pi * n / corners),
                centre[1]
                + unit
                * radius
                * 0.86
                * (1 + roughness * (rough.uniform(n) - 0.5))
                * sin(2 * pi * n / corners),
            )
            for n in range(corners)
        ]

    for crack in range(6):
        line = draws.narrow(9, crack)
        angle = 2 * pi * (crack + line.uniform(0)) / 6
        reach, points = 0.2, []
        for bend in range(4):
            points.append((centre[0] + unit * reach * cos(angle), centre[1] + unit * reach * sin(angle)))
            reach += 0.05 + 0.04 * line.uniform(bend + 1)
            angle += 0.7 * (line.uniform(bend + 9) - 0.5)
        pygame.draw.lines(canvas, theme.CRACK, False, points, max(2, unit // 60))
    for salt, (radius, colour) in enumerate(zip((0.33, 0.27, 0.19), theme.HOLE, strict=True)):
        pygame.draw.polygon(canvas, colour, rim(radius, 0.34, salt))
    light = rim(0.33, 0.34, 0)
    pygame.draw.lines(canvas, (86, 90, 98), False, light[1:7], max(2, unit // 70))
    return _smoothed(canvas, px)


def _car(px: int, colour: Colour, glass: Colour, *, lights: bool) -> pygame.Surface:
    """A car seen from above, nose up."""
    canvas, unit = _canvas(px)
    body = pygame.Rect(0, 0, int(unit * 0.5), int(unit * 0.82))
    body.center = canvas.get_rect().center
    wheel = pygame.Rect(0, 0, unit // 14, unit // 6)
    for side in (body.left, body.right):
        for end in (body.top + unit // 5, body.bottom - unit // 5):
            wheel.center = (side, end)
            pygame.draw.rect(canvas, (16, 17, 20), wheel, border_radius=unit // 40)
    pygame.draw.rect(canvas, _darker(colour, 0.62), body, border_radius=unit // 6)
    pygame.draw.rect(canvas, colour, body.inflate(-unit // 24, -unit // 24), border_radius=unit // 7)
    middle = body.centerx
    for top, height, wide, narrow in ((0.22, 0.15, 0.19, 0.155), (0.66, 0.11, 0.155, 0.18)):
        y = body.top + body.height * top
        pane = [
            (middle - unit * wide, y),
            (middle + unit * wide, y),
            (middle + unit * narrow, y + unit * height),
            (middle - unit * narrow, y + unit * height),
        ]
        pygame.draw.polygon(canvas, glass, pane)
    roof = pygame.Rect(0, 0, int(unit * 0.32), int(unit * 0.22))
    roof.center = (middle, int(body.top + body.height * 0.53))
    pygame.draw.rect(canvas, _lighter(colour, 0.22), roof, border_radius=unit // 16)
    if lights:
        for x in (body.left + unit * 0.09, body.right - unit * 0.09):
            _ellipse(canvas, (*theme.HEADLIGHT, 255), (x, body.top + unit * 0.035), (unit * 0.1, unit * 0.05))
            _ellipse(
                canvas, (*theme.TAILLIGHT, 255), (x, body.bottom - unit * 0.03), (unit * 0.1, unit * 0.045)
            )
    return _smoothed(canvas, px)


def _shadowed(sprite: pygame.Surface) -> pygame.Surface:
    """The same over its shadow, which falls the same way whichever way it faces."""
    width, height = sprite.get_size()
    shape = pygame.mask.from_surface(sprite).to_surface(setcolor=(0, 0, 0, 110), unsetcolor=(0, 0, 0, 0))
    soft = (max(1, width // 5), max(1, height // 5))
    shadow = pygame.transform.smoothscale(pygame.transform.smoothscale(shape, soft), (width, height))
    whole = pygame.Surface((width, height), pygame.SRCALPHA)
    whole.blit(shadow, (width // 22, height // 15))
    whole.blit(sprite, (0, 0))
    return whole


def _canvas(px: int) -> tuple[pygame.Surface, int]:
    unit = px * FINER
    return pygame.Surface((unit, unit), pygame.SRCALPHA), unit


def _smoothed(canvas: pygame.Surface, px: int) -> pygame.Surface:
    return pygame.transform.smoothscale(canvas, (px, px))


def _ellipse(
    canvas: pygame.Surface,
    colour: tuple[int, int, int, int],
    centre: tuple[float, float],
    size: tuple[float, float],
) -> None:
    """A filled ellipse of full width and height `size`; alpha is kept as given."""
    box = pygame.Rect(0, 0, max(1, int(size[0])), max(1, int(size[1])))
    box.center = (int(centre[0]), int(centre[1]))
    pygame.draw.ellipse(canvas, colour, box)


def _darker(colour: Colour, share: float) -> Colour:
    return int(colour[0] * share), int(colour[1] * share), int(colour[2] * share)


def _lighter(colour: Colour, share: float) -> Colour:
    r, g, b = (int(part + (255 - part) * share) for part in colour)
    return r, g, b
