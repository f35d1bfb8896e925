"""The first picture: the road one is about to drive, and the one question, how many potholes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import pygame

from service.refusals import refusals
from service.window import theme as look
from service.window.texts import language, table, text
from sim.config import Config, ConfigError
from sim.render import render, theme
from sim.render.text import render_text, truncate, wrap_text
from sim.render.theme import MAX_SIDE_PX
from sim.state import SimState, StepResult
from sim.transition import step

DEFAULT_POTHOLES: Final = 10
MOST_DIGITS: Final = 4
CARD: Final = (430, 372)


class Start:
    """Asks for a number, over a road that already has it."""

    def __init__(self, config_of: Callable[[int], Config]) -> None:
        """`config_of` raises `ConfigError` for a number that no road can have."""
        self._config_of = config_of
        self.text = str(DEFAULT_POTHOLES)
        self.message = ""
        self.waiting = False
        """whether it is answered, and the language is still being read"""
        self._fresh = True
        self._tick: StepResult | None = None
        self._before: SimState | None = None
        self._tick_s = 0.0
        self._look_again()

    @property
    def potholes(self) -> int | None:
        """The number, if it is one that a road can have."""
        return None if self.message or not self.text else int(self.text)

    def text_in(self, text: str) -> None:
        """Digits; the first replaces what was proposed."""
        digits = "".join(letter for letter in text if letter in "0123456789")
        if digits:
            self.text = ("" if self._fresh else self.text) + digits
            self.text = (self.text.lstrip("0") or "0")[:MOST_DIGITS]
            self._fresh = False
            self._look_again()

    def key(self, key: int) -> None:
        """Backspace, and up and down for one more or less."""
        number = int(self.text or 0)
        if key == pygame.K_BACKSPACE:
            self.text = "" if self._fresh else self.text[:-1]
        elif key == pygame.K_UP:
            self.text = str(number + 1)[:MOST_DIGITS]
        elif key == pygame.K_DOWN:
            self.text = str(max(0, number - 1))
        else:
            return
        self._fresh = False
        self._look_again()

    def _look_again(self) -> None:
        try:
            run = SimState.start(self._config_of(int(self.text or 0)))
        except ConfigError as error:
            told = "; ".join(refusals(language()).problem(problem) for problem in error.problems)
            self.message = f"{told[0].upper()}{told[1:]}."
            return
        self.message = "" if self.text else text("start", "number")
        self._before, self._tick = None, StepResult(run, {}, ())

    def draw(self, screen: pygame.Surface, now_s: float) -> None:
        """All of the window."""
        screen.fill(look.GROUND)
        width, height = screen.get_size()
        wide = width >= 2 * CARD[0]
        self._go_on(now_s)
        assert self._tick is not None
        before = self._before
        room = (width - CARD[0] - 60 if wide else width, height)
        road = render(
            "road",
            self._tick.state,
            before=before.world if before else None,
            decision=self._tick.decision,
            phase=(now_s - self._tick_s) / self._tick.state.config.step_seconds if before else 1.0,
            size=(min(MAX_SIDE_PX, max(64, room[0])), min(MAX_SIDE_PX, max(64, room[1]))),
        )
        centre = (width - room[0] // 2, height // 2) if wide else (width // 2, height // 2)
        screen.blit(road, road.get_rect(center=centre))
        card = self._card(now_s)
        screen.blit(card, card.get_rect(center=((width - room[0]) // 2 if wide else width // 2, height // 2)))

    def _go_on(self, now_s: float) -> None:
        assert self._tick is not None
        if self._before is None:
            self._tick_s, self._before = now_s, self._tick.state
            self._tick = step(self._tick.state)
            return
        step_s = self._tick.state.config.step_seconds
        if now_s - self._tick_s >= step_s:
            self._tick_s = now_s if now_s - self._tick_s > 2 * step_s else self._tick_s + step_s
            self._before = self._tick.state
            self._tick = step(self._tick.state)

    def _card(self, now_s: float) -> pygame.Surface:
        card = look.card(CARD)
        width = CARD[0]
        card.blit(render_text("Roadtalk", 62, theme.TEXT), (32, 30))
        about = text("start", "about")
        for number, line in enumerate(wrap_text(about, 22, width - 64)):
            card.blit(render_text(line, 22, theme.TEXT_QUIET), (32, 84 + number * 22))
        card.blit(render_text(text("start", "question"), 27, theme.TEXT), (32, 152))
        box = pygame.Rect(32, 180, 132, 58)
        pygame.draw.rect(card, look.FIELD, box, border_radius=8)
        edge = theme.REFUSED if self.message else look.ACCENT
        pygame.draw.rect(card, edge, box, 2, border_radius=8)
        number_sign = render_text(self.text, 46, theme.TEXT_QUIET if self._fresh else theme.TEXT)
        spot = card.blit(number_sign, number_sign.get_rect(midleft=(48, box.centery + 2)))
        if int(now_s * 2) % 2 == 0:
            x = (spot.right if self.text else 48) + 3
            card.fill(look.ACCENT, (x, box.centery - 18, 2, 36))
        button = pygame.Rect(180, 180, 218, 58)
        ready = self.potholes is not None
        pygame.draw.rect(card, look.ACCENT if ready else look.CAP, button, border_radius=8)
        wait = text("start", "wait") + "." * (int(now_s * 3) % 4)
        label = wait if self.waiting else text("start", "drive")
        sign = render_text(label, 32, theme.TEXT)
        cap = look.key_cap("Enter", 19)
        wide = sign.get_width() + (0 if self.waiting else cap.get_width() + 12)
        spot = card.blit(sign, sign.get_rect(midleft=(button.centerx - wide // 2, button.centery + 2)))
        if not self.waiting:
            card.blit(cap, cap.get_rect(midleft=(spot.right + 12, button.centery)))
        if self.message:
            card.blit(render_text(truncate(self.message, 20, width - 64), 20, theme.REFUSED), (32, 248))
        else:
            card.blit(
                render_text(text("start", "advice"), 20, theme.TEXT_QUIET),
                (32, 248),
            )
        pygame.draw.line(card, look.EDGE, (32, 282), (width - 32, 282))
        for row, (key, what) in enumerate(table("start", "hints")):
            keys = look.key_cap(key, 18)
            card.blit(keys, (32, 298 + row * 30))
            card.blit(render_text(what, 20, theme.TEXT_QUIET), (86, 301 + row * 30))
        return card

    def button(self, screen: pygame.Surface) -> pygame.Rect:
        """Where it is clicked to begin."""
        width, height = screen.get_size()
        wide = width >= 2 * CARD[0]
        room = width - CARD[0] - 60 if wide else width
        card = pygame.Rect((0, 0), CARD)
        card.center = ((width - room) // 2 if wide else width // 2, height // 2)
        return pygame.Rect(card.x + 180, card.y + 180, 218, 58)
