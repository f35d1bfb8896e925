"""Keys, letters and clicks, and what each of them does.

What is a letter comes as text, so that it is the letter on any keyboard; what is none comes as a key.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import pygame

from service.actions import Action, Pause, Redo, Resume, Rewind, Step, Undo
from service.window.console import Console
from service.window.exchange import Exchange
from service.window.local_session import Game
from service.window.panels import PANELS, Panels
from service.window.spoken import spoken_act
from service.window.texts import text
from sim.actions import Adjust, Drive, Reset, SetMode
from sim.types import Mode, Move

F_KEYS: Final = (pygame.K_F1, pygame.K_F2, pygame.K_F3, pygame.K_F4, pygame.K_F5)
MOVES: Final = {
    pygame.K_UP: Move.FORWARD,
    pygame.K_DOWN: Move.STAY,
    pygame.K_LEFT: Move.LEFT,
    pygame.K_RIGHT: Move.RIGHT,
}
SLANTED: Final = {
    Move.LEFT: Move.FORWARD_LEFT,
    Move.RIGHT: Move.FORWARD_RIGHT,
}
PAGE_LINES: Final = 3
HELD_S: Final = 0.18
"""While the clock stands an arrow held down is a move, or a tick, this often [s]."""
COMMAND: Final = pygame.KMOD_CTRL | pygame.KMOD_META


class Controls:
    """What a person does to the window."""

    def __init__(self, game: Game, console: Console, panels: Panels) -> None:
        self.game = game
        self.console = console
        self.panels = panels
        self.overlay: str | None = None
        """`help` or `quit`, where one lies over everything"""
        self.quitting = False
        self.log_back = 0
        self.fullscreen = False
        self.picture_wanted = False
        self._held: set[int] = set()
        self._repeated = False
        self._arrow_s = 0.0
        self._letters: dict[str, Callable[[], None]] = {
            "/": self.focus,
            "?": self._help,
            "p": self._pause,
            " ": self._pause,
            "r": lambda: self._do(Reset()),
            "m": self._mode,
            "s": self._picture,
            "+": lambda: self._speed("up"),
            "=": lambda: self._speed("up"),
            "-": lambda: self._speed("down"),
            "−": lambda: self._speed("down"),
            ",": lambda: self._do(Rewind(ticks=1)),
            ".": lambda: self._do(Step(ticks=1)),
        }

    def tell(self, reply: str) -> None:
        """A reply to something that needed no session."""
        self.console.take(Exchange(None, reply))

    def focus(self) -> None:
        """Write from now on."""
        self.console.focused = True
        self.overlay = None

    # Keys

    def key_down(self, key: int, mod: int) -> None:
        """A key that may be no letter."""
        self._repeated = key in self._held
        self._held.add(key)
        if key == pygame.K_ESCAPE:
            if not self._repeated:
                self._escape()
        elif self.overlay == "quit":
            if key in (pygame.K_RETURN, pygame.K_KP_ENTER):
                self.quitting = True
        elif key in F_KEYS and not self._repeated:
            name = PANELS[F_KEYS.index(key)]
            self.tell(self.panels.enlarge(name) if mod & pygame.KMOD_SHIFT else self.panels.toggle(name))
        elif key == pygame.K_F11 and not self._repeated:
            self.fullscreen = not self.fullscreen
        elif mod & COMMAND and key in (pygame.K_z, pygame.K_y):
            self._do(Redo() if key == pygame.K_y or mod & pygame.KMOD_SHIFT else Undo())
        elif key in (pygame.K_PAGEUP, pygame.K_PAGEDOWN):
            self._page(-1 if key == pygame.K_PAGEUP else 1)
        elif self.console.focused:
            self._line_key(key, mod)
        elif key in (pygame.K_RETURN, pygame.K_KP_ENTER):
            self.focus()
        elif key in MOVES and (not self._repeated or self._goes_on(key)):
            self._arrow(key, mod)

    def key_up(self, key: int) -> None:
        """A key was let go."""
        self._held.discard(key)

    def letters(self, text: str) -> None:
        """Letters, from whatever keyboard or input method."""
        if self.overlay == "quit":
            if text.lower() in ("y", "n") and not self._repeated:
                self.quitting, self.overlay = text.lower() == "y", None
            return
        sentence = self.console.chosen(text)
        if sentence is not None and self.overlay is None:
            self.say(sentence)
        elif self.console.focused:
            self.console.line.insert(text)
        elif not self._repeated:
            act = self._letters.get(text.lower())
            if act is not None:
                act()

    def composing(self, text: str) -> None:
        """What an input method is about to make letters of."""
        if self.console.focused:
            self.console.line.composing = text

    def _line_key(self, key: int, mod: int) -> None:
        line, console = self.console.line, self.console
        command = bool(mod & COMMAND)
        if key in (pygame.K_RETURN, pygame.K_KP_ENTER):
            self.say(line.text)
        elif key == pygame.K_TAB:
            if not console.pick(-1 if mod & pygame.KMOD_SHIFT else 1):
                whole = self.game.complete(line.text)
                if whole is not None:
                    line.set(whole)
        elif key == pygame.K_DOWN:
            if not console.pick(1):
                line.newer()
        elif key == pygame.K_UP:
            if console.picked < 0 or not console.pick(-1):
                line.older()
        elif key == pygame.K_LEFT:
            line.move_word(-1) if command else line.move(-1)
        elif key == pygame.K_RIGHT:
            line.move_word(1) if command else line.move(1)
        elif key == pygame.K_HOME or (command and key == pygame.K_a):
            line.home()
        elif key == pygame.K_END or (command and key == pygame.K_e):
            line.end()
        elif (command and key == pygame.K_w) or (command and key == pygame.K_BACKSPACE):
            line.delete_word()
        elif command and key == pygame.K_u:
            line.delete_before()
        elif (command and key == pygame.K_v) or (key == pygame.K_INSERT and mod & pygame.KMOD_SHIFT):
            line.insert(clipboard())
        elif key == pygame.K_BACKSPACE:
            line.backspace()
        elif key == pygame.K_DELETE:
            line.delete()

    def _page(self, way: int) -> None:
        if self.console.focused:
            self.console.scroll = max(0, self.console.scroll + way * PAGE_LINES)
        else:
            self.log_back = max(0, self.log_back - way * PAGE_LINES)

    def _escape(self) -> None:
        if self.overlay is not None:
            self.overlay = None
        elif self.console.focused:
            self.console.focused = False
            self.console.line.composing = ""
        elif self.panels.large is not None:
            self.panels.large = None
        else:
            self.overlay = "quit"

    def _arrow(self, key: int, mod: int) -> None:
        session, move = self.game.session, MOVES[key]
        self._arrow_s = self.game.now_s
        if session.run.mode is Mode.MANUAL:
            if mod & pygame.KMOD_SHIFT:
                move = SLANTED.get(move, move)
            # Standing still, a move is a turn: it is made at once.
            self._do(Drive(move=move), *((Step(ticks=1),) if session.paused else ()))
        elif session.paused and key in (pygame.K_LEFT, pygame.K_RIGHT):
            self._do(Rewind(ticks=1) if key == pygame.K_LEFT else Step(ticks=1))
        else:
            self.tell(text("drives_itself"))

    def _goes_on(self, key: int) -> bool:
        """Whether an arrow held down does the same again: a move once the one before is made."""
        session = self.game.session
        manual = session.run.mode is Mode.MANUAL
        if not manual and not (session.paused and key in (pygame.K_LEFT, pygame.K_RIGHT)):
            return False
        if not session.paused:
            return not session.run.queue
        return self.game.now_s - self._arrow_s >= HELD_S

    # Doing

    def say(self, text: str) -> None:
        """Say a sentence, from the line or from what is offered."""
        self.console.line.set(text)
        text = self.console.line.send()
        act = spoken_act(text)
        if act is not None:
            self._act(text, *act)
        elif text:
            self.game.say(text)

    def _act(self, said: str, name: str, view: str) -> None:
        """What the window does by itself, because it was said."""
        match name:
            case "enlarge":
                self.console.take(Exchange(said, self.panels.enlarge(view)))
            case "all_views":
                self.console.take(Exchange(said, self.panels.restore()))
            case "fullscreen":
                self.fullscreen = not self.fullscreen
                told = text("acts_told", "fullscreen", "on_" if self.fullscreen else "off_")
                self.console.take(Exchange(said, told))
            case "picture":
                self._picture()
            case "help" | "quit":
                self.overlay = name

    def _do(self, *actions: Action) -> None:
        self.game.do(*actions)

    def _pause(self) -> None:
        self._do(Resume() if self.game.session.paused else Pause())

    def _mode(self) -> None:
        manual = self.game.session.run.mode is Mode.MANUAL
        self._do(SetMode(mode=Mode.AUTO if manual else Mode.MANUAL))

    def _speed(self, way: str) -> None:
        self._do(Adjust(parameter="playback_speed", direction="up" if way == "up" else "down"))

    def _picture(self) -> None:
        self.picture_wanted = True

    def _help(self) -> None:
        self.overlay = None if self.overlay == "help" else "help"

    # The mouse

    def clicked(self, what: str, name: str) -> None:
        """A spot was clicked: what it is, and of which."""
        match what:
            case "panel":
                self.tell(self.panels.enlarge(name))
            case "hide":
                self.tell(self.panels.hide(name))
            case "toggle":
                self.tell(self.panels.toggle(name))
            case "say":
                self.say(name)
            case "write":
                self.focus()
                self.console.line.set(name)
            case "focus":
                self.focus()
            case "help":
                self._help()
            case "quit":
                self.quitting = True
            case "stay":
                self.overlay = None


def clipboard() -> str:
    """What can be pasted; nothing where the machine offers none."""
    try:
        if hasattr(pygame.scrap, "get_text"):
            return str(pygame.scrap.get_text())
        if not pygame.scrap.get_init():
            pygame.scrap.init()
        data = pygame.scrap.get("text/plain;charset=utf-8") or pygame.scrap.get(pygame.SCRAP_TEXT)
    except (pygame.error, NotImplementedError):
        return ""
    return data.decode("utf-8", "replace").rstrip("\0") if data else ""
