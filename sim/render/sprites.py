"""Sprites of things from above, drawn once per size and look, and cached.

Every sprite fills the box that its kind has in `sim.rules.collision_geometry`; only a soft shadow lies
outside it. Sprites are drawn at four times their size and scaled down, since pygame's shapes have hard
edges. A pothole's rim and cracks depend on its id alone.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import cos, pi, sin
from typing import Final

import pygame

from sim.randomness import Stream
from sim.render import theme
from sim.render.theme import Colour
from sim.rules.collision_geometry import SIZES
from sim.types import KINDS, Kind
from sim.world import Thing

FINER = 4
_SPRITES = 512


def sprite_of(thing: Thing, px: int) -> pygame.Surface:
    """A thing as its kind is drawn (`KindSpec.sprite`)."""
    return _DRAWN[KINDS[thing.kind].sprite](thing, px)


@lru_cache(maxsize=_SPRITES)
def av_sprite(px: int, number: int = 0) -> pygame.Surface:
    """An ego, facing up the road, with its sensor on the roof; `number` is its place in `World.avs`."""
    canvas, unit = _canvas(px)
    paint = theme.colour_of_ego(number)
    _car(canvas, unit, Kind.AV, paint, theme.AV_GLASS, lights=True)
    middle = canvas.get_rect().center
    sensor = (middle[0], middle[1] + unit * 0.1)
    for size, colour in ((0.094, theme.AV_GLASS), (0.07, theme.SENSOR), (0.034, paint)):
        _ellipse(canvas, (*colour, 255), sensor, (unit * size, unit * size))
    return _add_shadow(_downscale(canvas, px))


def vehicle_sprite(px: int, look: int, heading: str, disabled: bool) -> pygame.Surface:
    """An obstacle vehicle facing `heading`; the integer `look` selects its colour."""
    return _vehicle(
        px, theme.DISABLED if disabled else theme.VEHICLES[look % len(theme.VEHICLES)], heading, disabled
    )


@lru_cache(maxsize=_SPRITES)
def _vehicle(px: int, colour: Colour, heading: str, disabled: bool) -> pygame.Surface:
    canvas, unit = _canvas(px)
    _car(canvas, unit, Kind.VEHICLE, colour, theme.GLASS, lights=not disabled)
    turned = pygame.transform.rotate(canvas, 90 if heading == "left" else -90)
    return _add_shadow(_downscale(turned, px))


def pedestrian_sprite(px: int, look: int, heading: str, disabled: bool) -> pygame.Surface:
    """A pedestrian from above: shoulders, head, arms, a foot ahead; the integer `look` selects the colour."""
    return _pedestrian(
        px, theme.DISABLED if disabled else theme.PEDESTRIANS[look % len(theme.PEDESTRIANS)], heading
    )


@lru_cache(maxsize=_SPRITES)
def _pedestrian(px: int, body: Colour, heading: str) -> pygame.Surface:
    canvas, unit = _canvas(px)
    centre = canvas.get_rect().center
    ahead = -1 if heading == "left" else 1

    def spot(across: float, along: float, size: tuple[float, float], colour: Colour) -> None:
        at = (centre[0] + ahead * unit * across, centre[1] + unit * along)
        _ellipse(canvas, (*colour, 255), at, (unit * size[0], unit * size[1]))

    # Every ellipse stays within the body: 0.30 across, 0.32 along.
    spot(0.085, -0.05, (0.13, 0.08), theme.SHOE)
    spot(-0.085, 0.05, (0.13, 0.08), theme.SHOE)
    spot(0.06, 0.105, (0.12, 0.07), theme.SKIN)
    spot(-0.05, -0.105, (0.12, 0.07), theme.SKIN)
    spot(0, 0, (0.17, 0.31), _darker(body, 0.6))
    spot(0, 0, (0.15, 0.285), body)
    spot(0.012, 0, (0.15, 0.15), theme.SKIN)
    spot(-0.012, 0, (0.135, 0.14), theme.HAIR)
    return _add_shadow(_downscale(canvas, px))


@lru_cache(maxsize=_SPRITES)
def barrier_sprite(px: int) -> pygame.Surface:
    """A striped barrier on two feet, with a lamp at either end."""
    canvas, unit = _canvas(px)
    size = SIZES[Kind.BARRIER]
    across, along = float(size.across), float(size.along)
    for side in (-1, 1):
        _block(canvas, unit, (side * across * 0.34, 0), (0.075, along), theme.FOOT, 0.02)
    board = _block(canvas, unit, (0, 0), (across, 0.17), theme.BARRIER[1], 0.035)
    face = pygame.Surface(board.size, pygame.SRCALPHA)
    stripe, lean = board.width / 7, board.height * 0.55
    for n in range(-1, 8, 2):
        x = n * stripe
        shape = [(x, board.height), (x + stripe, board.height), (x + stripe + lean, 0), (x + lean, 0)]
        pygame.draw.polygon(face, theme.BARRIER[0], shape)
    face.fill((0, 0, 0, 60), (0, int(board.height * 0.74), board.width, board.height), pygame.BLEND_RGBA_SUB)
    mask = pygame.Surface(board.size, pygame.SRCALPHA)
    pygame.draw.rect(mask, (255, 255, 255, 255), mask.get_rect(), border_radius=int(unit * 0.035))
    face.blit(mask, (0, 0), special_flags=pygame.BLEND_RGBA_MIN)
    canvas.blit(face, board)
    pygame.draw.rect(
        canvas, _darker(theme.BARRIER[0], 0.6), board, max(1, unit // 70), border_radius=int(unit * 0.035)
    )
    for side in (-1, 1):
        middle = (canvas.get_width() / 2 + side * unit * across * 0.34, canvas.get_height() / 2)
        _ellipse(canvas, (*_darker(theme.LAMP, 0.6), 255), middle, (unit * 0.1, unit * 0.1))
        _ellipse(canvas, (*theme.LAMP, 255), middle, (unit * 0.075, unit * 0.075))
    return _add_shadow(_downscale(canvas, px))


@lru_cache(maxsize=_SPRITES)
def pothole_sprite(px: int, name: str) -> pygame.Surface:
    """A hole with a broken rim and cracks, the same for the same id."""
    canvas, unit = _canvas(px)
    draws = Stream.of(0, name)
    centre = canvas.get_rect().center
    half = float(SIZES[Kind.POTHOLE].across) / 2
    corners = 18

    def at(angle: float, reach: float) -> tuple[float, float]:
        """A point at the share `reach` of the way to the edge of a rounded square that fills the box."""
        x, y = cos(angle), sin(angle)
        radius = half * reach / max(abs(x), abs(y)) ** 0.45
        return centre[0] + unit * radius * x, centre[1] + unit * radius * y

    def rim(reach: float, roughness: float) -> list[tuple[float, float]]:
        rough = draws.narrow(0)
        return [at(2 * pi * n / corners, reach * (1 - roughness * rough.uniform(n))) for n in range(corners)]

    for crack in range(7):
        line = draws.narrow(9, crack)
        angle = 2 * pi * (crack + line.uniform(0)) / 7
        points = [at(angle + 0.3 * (line.uniform(bend) - 0.5), 0.7 + 0.09 * bend) for bend in range(4)]
        pygame.draw.lines(canvas, theme.CRACK, False, points, max(2, unit // 64))
    pygame.draw.polygon(canvas, theme.CRUMBLE, rim(0.97, 0.24))
    for reach, colour in zip((0.88, 0.74, 0.52), theme.HOLE, strict=True):
        pygame.draw.polygon(canvas, colour, rim(reach, 0.24))
    pygame.draw.lines(canvas, theme.RIM, False, rim(0.88, 0.24)[1:9], max(2, unit // 70))
    return _downscale(canvas, px)


def _car(
    canvas: pygame.Surface, unit: int, kind: Kind, colour: Colour, glass: Colour, *, lights: bool
) -> None:
    """A car seen from above, nose up, as long and wide as its kind's box."""
    size = SIZES[kind]
    wide, long = float(min(size)), float(max(size))
    for side in (-1, 1):
        for end in (-0.3, 0.29):
            _block(canvas, unit, (side * (wide / 2 - 0.02), end * long), (0.04, 0.12), theme.TYRE, 0.014)
        mirror = (side * (wide / 2 - 0.02), -0.115 * long)
        _block(canvas, unit, mirror, (0.04, 0.03), _darker(colour, 0.5), 0.012)
    # Drawn from the outside in, from dark to light, so that the sides look rounded.
    body = wide - 0.02
    for inset, shade in ((0.0, 0.5), (0.012, 0.74), (0.026, 0.88), (0.044, 1.0)):
        room = (body - 2 * inset, long - 2 * inset)
        _block(canvas, unit, (0, 0), room, _darker(colour, shade), 0.1 - inset, 0.07 - inset / 2)
    for side in (-1, 1):
        crease = (side * body * 0.24, -0.36 * long)
        _block(canvas, unit, crease, (0.012, 0.12), _darker(colour, 0.82), 0.006)
    _block(canvas, unit, (0, -0.38 * long), (body * 0.36, 0.1), _lighter(colour, 0.16), 0.03)
    _glass(canvas, unit, glass, body, long)
    _block(canvas, unit, (0, 0.06 * long), (body * 0.68, long * 0.27), _darker(colour, 0.86), 0.035)
    _block(canvas, unit, (0, 0.055 * long), (body * 0.62, long * 0.25), _lighter(colour, 0.2), 0.03)
    if lights:
        for side in (-1, 1):
            front, back = (side * body * 0.3, -long / 2 + 0.037), (side * body * 0.31, long / 2 - 0.022)
            _block(canvas, unit, front, (0.066, 0.036), theme.HEADLIGHT, 0.018)
            _block(canvas, unit, back, (0.08, 0.024), theme.TAILLIGHT, 0.012)


def _glass(canvas: pygame.Surface, unit: int, glass: Colour, body: float, long: float) -> None:
    """Draws the windows round the roof, wider in the middle, with light on the windscreen."""
    middle = canvas.get_rect().center

    def pane(*corners: tuple[float, float]) -> list[tuple[float, float]]:
        """Mirrors the corners of the right half; coordinates are shares of the body's width and length."""
        right = [(middle[0] + unit * body * x, middle[1] + unit * long * y) for x, y in corners]
        return right + [(2 * middle[0] - x, y) for x, y in reversed(right)]

    windows = pane((0.3, -0.215), (0.37, -0.19), (0.43, -0.06), (0.43, 0.18), (0.38, 0.29), (0.3, 0.305))
    pygame.draw.polygon(canvas, glass, windows)
    pygame.draw.polygon(canvas, _lighter(glass, 0.22), pane((0.27, -0.195), (0.34, -0.09)))


def _block(
    canvas: pygame.Surface,
    unit: int,
    middle: tuple[float, float],
    size: tuple[float, float],
    colour: Colour,
    front: float,
    back: float | None = None,
) -> pygame.Rect:
    """Draws a rounded rectangle, in cells from the centre of the canvas, with radii for front and back."""
    width, height = round(unit * size[0]), round(unit * size[1])
    left = round(canvas.get_width() / 2 + unit * middle[0] - width / 2)
    top = round(canvas.get_height() / 2 + unit * middle[1] - height / 2)
    rect = pygame.Rect(left, top, max(1, width), max(1, height))
    ahead, behind = round(unit * front), round(unit * (front if back is None else back))
    pygame.draw.rect(
        canvas,
        colour,
        rect,
        border_top_left_radius=ahead,
        border_top_right_radius=ahead,
        border_bottom_left_radius=behind,
        border_bottom_right_radius=behind,
    )
    return rect


def _add_shadow(sprite: pygame.Surface) -> pygame.Surface:
    """The same over its shadow, which falls the same way whichever way it faces."""
    width, height = sprite.get_size()
    shape = pygame.mask.from_surface(sprite).to_surface(setcolor=(0, 0, 0, 105), unsetcolor=(0, 0, 0, 0))
    soft = (max(1, width // 4), max(1, height // 4))
    shadow = pygame.transform.smoothscale(pygame.transform.smoothscale(shape, soft), (width, height))
    whole = pygame.Surface((width, height), pygame.SRCALPHA)
    whole.blit(shadow, (width // 36, height // 28))
    whole.blit(sprite, (0, 0))
    return whole


def _canvas(px: int) -> tuple[pygame.Surface, int]:
    unit = px * FINER
    return pygame.Surface((unit, unit), pygame.SRCALPHA), unit


def _downscale(canvas: pygame.Surface, px: int) -> pygame.Surface:
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


def _look(thing: Thing) -> tuple[int, str, bool]:
    return int(thing.id.rpartition("-")[2]), thing.heading or "left", thing.disabled


_DRAWN: Final[dict[str, Callable[[Thing, int], pygame.Surface]]] = {
    "ego": lambda thing, px: av_sprite(px, int(thing.id.rpartition("-")[2]) - 1),
    "car": lambda thing, px: vehicle_sprite(px, *_look(thing)),
    "pedestrian": lambda thing, px: pedestrian_sprite(px, *_look(thing)),
    "pothole": lambda thing, px: pothole_sprite(px, thing.id),
    "barrier": lambda _, px: barrier_sprite(px),
}
"""What there is to draw, by the names in `sim.types.KINDS`."""
