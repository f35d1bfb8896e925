"""The window on a real display, sixty times a second until it is closed."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable
from os import environ
from typing import Final

import pygame

from service.window.loading import Loading
from service.window.window import Window
from sim.config import Config
from sim.render.sprites import av_sprite

FPS: Final = 60
UNSEEN: Final = ("dummy", "offscreen", "evdev")
"""Drivers that SDL falls back to where nobody would see the window; they must be asked for by name."""
REPEAT_AFTER_MS: Final = 350
REPEAT_EVERY_MS: Final = 35


class NoDisplayError(Exception):
    """There is nothing to show a window on."""


def open_display(size: tuple[int, int]) -> pygame.Surface:
    """A window that can be resized. Raises `NoDisplayError`."""
    try:
        pygame.display.init()
        driver = pygame.display.get_driver()
        if driver in UNSEEN and driver != environ.get("SDL_VIDEODRIVER"):
            pygame.display.quit()
            raise NoDisplayError("neither X11 nor Wayland nor any other was found")
        pygame.display.set_icon(av_sprite(64))
        screen = pygame.display.set_mode(size, pygame.RESIZABLE)
    except pygame.error as error:
        raise NoDisplayError(str(error)) from error
    pygame.display.set_caption("Roadtalk")
    pygame.key.set_repeat(REPEAT_AFTER_MS, REPEAT_EVERY_MS)
    pygame.key.start_text_input()
    return screen


def play(
    screen: pygame.Surface, config_of: Callable[[int | None], Config], *, ask: bool, loading: Loading
) -> None:
    """Until it is closed. Raises `LoadError` where the language cannot be read."""
    window = Window(screen, config_of, ask=ask, loading=loading, now_s=time.perf_counter())
    clock = pygame.time.Clock()
    frozen = fullscreen = False
    window_size = screen.get_size()
    try:
        while not window.closed:
            for event in pygame.event.get():
                window.handle(event)
            surface: pygame.Surface | None = pygame.display.get_surface()
            if window.fullscreen != fullscreen:
                fullscreen = window.fullscreen
                window_size = window.size if fullscreen else window_size
                surface = _other_mode(fullscreen, window_size)
            if surface is not None and (
                surface is not window.canvas.screen or surface.get_size() != window.size
            ):
                window.resize(surface)
            dirty = window.frame(time.perf_counter())
            if dirty:
                pygame.display.update(dirty)
            if not frozen and window.game is not None:
                # The grammar is a great many objects that stay: they are looked through for garbage no more.
                gc.collect()
                gc.freeze()
                frozen = True
            clock.tick(FPS)
    finally:
        window.close()
        pygame.display.quit()


def _other_mode(fullscreen: bool, size: tuple[int, int]) -> pygame.Surface | None:
    """The whole screen, or a window of that size again; what there was, where the display cannot."""
    try:
        if fullscreen:
            return pygame.display.set_mode((0, 0), pygame.FULLSCREEN)
        return pygame.display.set_mode(size, pygame.RESIZABLE)
    except pygame.error:
        return pygame.display.get_surface()
