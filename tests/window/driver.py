"""A window driven as a person would, with time and events brought by hand."""

from __future__ import annotations

from pathlib import Path

import pygame

from service.window.console import Console
from service.window.controls import Controls
from service.window.exchange import Exchange
from service.window.loading import Loaded, Loading
from service.window.local_session import Game
from service.window.window import Window
from sim.config import Config

FRAME_S = 1 / 60


class Ready(Loading):
    """A language that was read before."""

    def __init__(self, loaded: Loaded) -> None:
        super().__init__()
        self._found.append(loaded)

    def begin(self) -> None:
        """Nothing is left to be done."""


CARELESS = Config(seed=2, potholes=40, vehicles=30, planner="priority", attentive=0.0)
"""A road that ends in a crash: nobody brakes, and the source's rule drives."""


class Driver:
    """Sends real events through SDL's queue, and brings the time."""

    def __init__(
        self,
        loaded: Loaded,
        *,
        size: tuple[int, int] = (1440, 900),
        config: Config | None = None,
        ask: bool = False,
        folder: Path | None = None,
    ) -> None:
        pygame.display.init()
        screen = pygame.display.set_mode(size, pygame.RESIZABLE)
        pygame.event.clear()
        base = config or Config(seed=4, potholes=10)

        def config_of(potholes: int | None) -> Config:
            return base if potholes is None or not ask else base.with_parts(potholes=potholes)

        self.now_s = 100.0
        self.window = Window(
            screen, config_of, ask=ask, loading=Ready(loaded), now_s=self.now_s, folder=folder
        )
        self.frames(1)

    def frames(self, count: int = 1) -> list[pygame.Rect]:
        """So many frames; what the last one drew."""
        dirty: list[pygame.Rect] = []
        for _ in range(count):
            for event in pygame.event.get():
                self.window.handle(event)
            self.now_s += FRAME_S
            dirty = self.window.frame(self.now_s)
        return dirty

    def seconds(self, seconds: float) -> None:
        """Let time pass."""
        self.frames(round(seconds / FRAME_S))

    def press(self, key: int, mod: int = 0, text: str = "") -> None:
        """A key down and up, with the letter it makes."""
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=mod, unicode=text))
        if text:
            pygame.event.post(pygame.event.Event(pygame.TEXTINPUT, text=text))
        pygame.event.post(pygame.event.Event(pygame.KEYUP, key=key, mod=mod))
        self.frames(1)

    def letter(self, text: str) -> None:
        """A key that makes a letter."""
        self.press(pygame.key.key_code(text) if text.isalpha() and text.isascii() else 0, text=text)

    def type(self, text: str) -> None:
        """Several letters."""
        for each in text:
            self.letter(each)

    def click(self, spot: tuple[int, int]) -> None:
        """The left button, once."""
        pygame.event.post(pygame.event.Event(pygame.MOUSEBUTTONDOWN, pos=spot, button=1))
        self.frames(1)

    def say(self, sentence: str) -> Exchange:
        """A sentence typed and sent; what came of it."""
        if not self.console.focused:
            self.letter("/")
        self.press(pygame.K_u, pygame.KMOD_CTRL)
        self.type(sentence)
        self.press(pygame.K_RETURN)
        return self.answered()

    def answered(self) -> Exchange:
        """The latest exchange, once it is there."""
        self.game.settle()
        self.frames(1)
        assert self.console.latest is not None
        return self.console.latest

    @property
    def game(self) -> Game:
        assert self.window.game is not None
        return self.window.game

    @property
    def controls(self) -> Controls:
        assert self.window.controls is not None
        return self.window.controls

    @property
    def console(self) -> Console:
        return self.window.console

    @property
    def screen(self) -> pygame.Surface:
        return self.window.canvas.screen

    def colours(self, place: pygame.Rect) -> set[tuple[int, int, int]]:
        """All colours in a region of the screen."""
        part = self.screen.subsurface(place.clip(self.screen.get_rect()))
        raw = pygame.image.tobytes(part, "RGB")
        return {(raw[at], raw[at + 1], raw[at + 2]) for at in range(0, len(raw), 3)}

    def picture(self) -> bytes:
        """All that is on the screen."""
        return pygame.image.tobytes(self.screen, "RGB")

    def close(self) -> None:
        self.window.close()
        pygame.display.quit()
