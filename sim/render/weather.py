"""Draws weather and time of day over a finished picture of the road, lightly: everything stays readable.

Rain and snow are drawn by tick and phase, without randomness: a picture of a moment is always the same.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import pygame

from sim.config import Config

Veil = tuple[int, int, int, int]

_LIGHT: Final[dict[str, Veil]] = {
    "dusk": (60, 30, 50, 50),
    "dawn": (90, 60, 70, 40),
    "night": (6, 10, 34, 115),
}
_AIR: Final[dict[str, Veil]] = {
    "rain": (70, 85, 100, 40),
    "fog": (205, 210, 214, 95),
    "snow": (225, 230, 238, 50),
}
_DROPS: Final = 60
"""in a square of ten cells"""
_RAIN: Final = (190, 205, 225, 120)
_SNOW: Final = (250, 252, 255, 200)
_STEP: Final = 0.754877666
"""Multiples of it, modulo 1, are spread evenly (the plastic number's inverse)."""


def draw_weather(picture: pygame.Surface, config: Config, unit_px: int, tick: int, phase: float) -> None:
    """Draws what the configuration says of weather and light; nothing in clear weather by day."""
    for veil in (_AIR.get(config.weather), _LIGHT.get(config.time_of_day)):
        if veil is not None:
            picture.blit(_veil(picture.get_size(), veil), (0, 0))
    if config.weather in ("rain", "snow"):
        _draw_drops(picture, config.weather, unit_px, tick + phase)


@lru_cache(maxsize=8)
def _veil(size: tuple[int, int], colour: Veil) -> pygame.Surface:
    veil = pygame.Surface(size, pygame.SRCALPHA)
    veil.fill(colour)
    return veil


def _draw_drops(picture: pygame.Surface, weather: str, unit_px: int, time: float) -> None:
    """Draws falling drops or flakes at a time in ticks."""
    width, height = picture.get_size()
    unit = max(4, unit_px)
    layer = pygame.Surface((width, height), pygame.SRCALPHA)
    count = min(400, round(_DROPS * width * height / (100 * unit * unit)) + 1)
    falls = 1.7 if weather == "rain" else 0.35
    for number in range(1, count + 1):
        across = number * _STEP % 1.0
        down = (number * _STEP * _STEP + falls * time) % 1.0
        x, y = round(across * width), round(down * height)
        if weather == "rain":
            pygame.draw.line(layer, _RAIN, (x, y), (x - unit // 12, y + unit // 4))
        else:
            pygame.draw.circle(layer, _SNOW, (x, y), max(1, unit // 28))
    picture.blit(layer, (0, 0))
