"""The window: events in, one frame out; time is told from outside, so that a test can bring its own."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from functools import partial
from pathlib import Path
from typing import Final

import pygame

from service.refusals import refusals
from service.window import theme as look
from service.window.animation import Showing
from service.window.canvas import Canvas
from service.window.console import Console, draw_console
from service.window.controls import Controls
from service.window.exchange import Exchange
from service.window.layout import Shape, arrange, body_of, close_of, head_of
from service.window.loading import Loading
from service.window.local_session import Game
from service.window.overlays import draw_help, draw_quit
from service.window.panels import PANELS, Panels, title
from service.window.start_screen import Start
from service.window.texts import language, text
from sim.config import Config
from sim.generation import GenerationError
from sim.render import MIN_SIDE_PX, render
from sim.render.log_view import draw_log
from sim.render.occupancy_view import draw_occupancy
from sim.render.plan_view import draw_plan
from sim.render.theme import MAX_SIDE_PX
from sim.types import Mode

LOG_LINES: Final = 120
Spot = tuple[pygame.Rect, tuple[str, str]]


class Window:
    """All that is on the screen."""

    def __init__(
        self,
        screen: pygame.Surface,
        config_of: Callable[[int | None], Config],
        *,
        ask: bool,
        loading: Loading,
        now_s: float = 0.0,
        folder: Path | None = None,
    ) -> None:
        """`config_of` a number of potholes, which is asked for first where `ask`; pictures go to `folder`."""
        self.canvas = Canvas(screen)
        self._size = screen.get_size()
        self.panels = Panels()
        self.console = Console()
        self.game: Game | None = None
        self.closed = False
        self.fullscreen = False
        self._config_of = config_of
        self._loading = loading
        self._folder = folder or Path()
        self._last_s = now_s
        self._showing: Showing | None = None
        self._controls: Controls | None = None
        self._places: Mapping[str, pygame.Rect] = {}
        self._over_spots: list[Spot] = []
        self._card: tuple[Hashable, pygame.Surface] | None = None
        self.start = Start(config_of)
        if not ask:
            self.start.waiting = True
        loading.begin()

    @property
    def controls(self) -> Controls | None:
        """What is done to the game, once there is one."""
        return self._controls

    @property
    def size(self) -> tuple[int, int]:
        """What it was last drawn in."""
        return self._size

    def place(self, name: str) -> pygame.Rect:
        """Where a panel or the `console` stands. Raises `KeyError` for one that is not shown."""
        return self._places[name]

    # Events

    def handle(self, event: pygame.event.Event) -> None:
        """One event."""
        if event.type == pygame.QUIT:
            self.closed = True
        elif self._controls is None:
            self._handle_start(event)
        else:
            self._handle_game(event, self._controls)
            self.closed = self.closed or self._controls.quitting

    def _handle_start(self, event: pygame.event.Event) -> None:
        if event.type == pygame.TEXTINPUT:
            self.start.text_in(event.text)
        elif event.type == pygame.KEYDOWN and event.key == pygame.K_ESCAPE:
            self.closed = True
        elif event.type == pygame.KEYDOWN and event.key in (pygame.K_RETURN, pygame.K_KP_ENTER):
            self._answered()
        elif event.type == pygame.KEYDOWN:
            self.start.key(event.key)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1 and self._on_button(event.pos):
            self._answered()

    def _on_button(self, spot: tuple[int, int]) -> bool:
        return self.start.button(self.canvas.screen).collidepoint(spot)

    def _answered(self) -> None:
        if self.start.potholes is not None:
            self.start.waiting = True

    def _handle_game(self, event: pygame.event.Event, controls: Controls) -> None:
        if event.type == pygame.KEYDOWN:
            controls.key_down(event.key, event.mod)
        elif event.type == pygame.KEYUP:
            controls.key_up(event.key)
        elif event.type == pygame.TEXTINPUT:
            controls.letters(event.text)
        elif event.type == pygame.TEXTEDITING:
            controls.composing(event.text)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            found = next((what for spot, what in self._spots() if spot.collidepoint(event.pos)), None)
            if found is not None:
                controls.clicked(*found)
        elif event.type == pygame.MOUSEWHEEL:
            self._wheel(event.y)

    def _wheel(self, by: int) -> None:
        assert self._controls is not None
        place = self._places.get("console")
        if place is not None and place.collidepoint(pygame.mouse.get_pos()):
            self.console.scroll = max(0, self.console.scroll - by)
        else:
            self._controls.log_back = max(0, self._controls.log_back + by)

    def _spots(self) -> list[Spot]:
        """What can be clicked, the topmost first."""
        if self._over_spots:
            return self._over_spots
        spots: list[Spot] = []
        for name, place in self._places.items():
            if name == "console":
                spots += [(spot.move(place.topleft), what) for spot, what in self.console.spots]
            else:
                spots += [(close_of(place), ("hide", name)), (head_of(place), ("panel", name))]
        return spots

    # Frames

    def frame(self, now_s: float) -> list[pygame.Rect]:
        """Go on to this time and draw what has changed; where that is."""
        elapsed, self._last_s = now_s - self._last_s, now_s
        if self.game is None:
            self._begin(now_s)
        if self.game is None:
            self.start.draw(self.canvas.screen, now_s)
            return [self.canvas.screen.get_rect()]
        self.game.advance(elapsed)
        self._take_replies()
        self._draw(now_s)
        return self.canvas.changed()

    def resize(self, screen: pygame.Surface) -> None:
        """The window has another size, or is another one."""
        self.canvas = Canvas(screen)
        self._size = screen.get_size()
        self._card = None

    def close(self) -> None:
        """Let go of the game."""
        if self.game is not None:
            self.game.close()

    def _begin(self, now_s: float) -> None:
        loaded = self._loading.ready()
        if loaded is None or not self.start.waiting:
            return
        asked = self.start.potholes
        try:
            self.game = Game(self._config_of(asked), loaded, self.panels)
        except GenerationError as error:
            told = refusals(language()).problem(error.problems[0])
            self.start.message, self.start.waiting = f"{told[0].upper()}{told[1:]}.", False
            return
        self._showing = Showing(self.game.session, now_s)
        self._controls = Controls(self.game, self.console, self.panels)
        self.canvas.clear()

    def _take_replies(self) -> None:
        assert self.game is not None
        assert self._controls is not None
        for exchange in self.game.exchanges:
            self.console.take(exchange)
        self.game.exchanges.clear()
        if self._controls.picture_wanted:
            self._controls.picture_wanted = False
            self.console.take(self._save_picture())
        self.fullscreen = self._controls.fullscreen

    def _save_picture(self) -> Exchange:
        assert self.game is not None
        tick, number = self.game.session.run.world.tick, 1
        path = self._folder / f"roadtalk-tick-{tick}.png"
        while path.exists():
            number += 1
            path = self._folder / f"roadtalk-tick-{tick}-{number}.png"
        try:
            pygame.image.save(self.canvas.screen, path)
        except (OSError, pygame.error) as error:
            return Exchange(None, text("picture", "failed", path=path, error=error), done=False)
        return Exchange(None, text("picture", "saved", path=path))

    def _draw(self, now_s: float) -> None:
        assert self.game is not None
        assert self._controls is not None
        assert self._showing is not None
        self._showing.follow(now_s)
        run = self._showing.after
        shape = Shape(run.config.columns, run.config.rows, min(run.config.visible_rows, run.config.rows))
        overlay = self._controls.overlay
        places = arrange(
            self.canvas.screen.get_size(), frozenset(self.panels.shown), self.panels.large, shape
        )
        if places != self._places or (overlay is None and self.canvas.covered):
            self._places = places
            self.canvas.clear()
        for name in self.panels.visible:
            self._draw_panel(name, places[name], now_s)
        console = self.console
        self.canvas.part(
            "console",
            places["console"],
            console.key(self.panels, self.game.busy, now_s),
            lambda: draw_console(
                console,
                self.panels,
                places["console"].size,
                busy=self.game is not None and self.game.busy,
                now_s=now_s,
            ),
        )
        self._draw_over(overlay)

    def _draw_over(self, overlay: str | None) -> None:
        if overlay is None:
            self._over_spots, self._card = [], None
            return
        size = self.canvas.screen.get_size()
        if self._card is None or self._card[0] != overlay:
            card, self._over_spots = (draw_help if overlay == "help" else draw_quit)(size)
            self._card = (overlay, card)
        shape = self._card[1]
        self.canvas.over(overlay, lambda: shape)

    def _draw_panel(self, name: str, place: pygame.Rect, now_s: float) -> None:
        large = self.panels.large == name
        status = self._status(name)
        key = f"F{PANELS.index(name) + 1}"
        head = head_of(place)
        self.canvas.part(
            f"{name} head",
            head,
            (status, large),
            lambda: look.title_bar(head.width, title(name), key, status, large=large, height=head.height),
        )
        body = body_of(place)
        if min(body.size) >= MIN_SIDE_PX:
            look_of, draw = self._body(name, body.size, now_s)
            self.canvas.part(name, body, look_of, draw)

    def _status(self, name: str) -> str:
        assert self.game is not None
        assert self._showing is not None
        session, run = self.game.session, self._showing.after
        match name:
            case "road":
                planner = self.game.loaded.words.planner(run.config.planner)
                driver = text("status", "by_hand") if run.mode is Mode.MANUAL else planner
                speed = self.game.loaded.words.speed(session.playback_speed)
                standing = text("status", "paused") if session.paused else speed
                return text("status", "road", standing=standing, driver=driver, seed=run.config.seed)
            case "plan":
                return text("status", "plan", tick=self._showing.planned[0].world.tick)
            case _:
                return ""

    def _body(
        self, name: str, size: tuple[int, int], now_s: float
    ) -> tuple[Hashable, Callable[[], pygame.Surface]]:
        """What a panel's picture depends on, and how it is drawn."""
        assert self.game is not None
        assert self._showing is not None
        assert self._controls is not None
        showing, run = self._showing, self._showing.after
        room = (min(size[0], MAX_SIDE_PX), min(size[1], MAX_SIDE_PX))
        match name:
            case "road":
                phase = showing.phase(now_s)
                return (id(run), phase), partial(
                    render,
                    "road",
                    run,
                    before=showing.before.world,
                    decision=showing.moving,
                    phase=phase,
                    size=room,
                )
            case "schematic":
                return id(run), lambda: _around(
                    render("schematic", run, size=room),
                    run.world.av // run.config.columns / run.config.rows,
                    size,
                )
            case "occupancy":
                return id(run), lambda: _around(
                    draw_occupancy(run, room), run.world.av // run.config.columns / run.config.rows, size
                )
            case "plan":
                state, decision = showing.planned
                return (id(state), decision), lambda: draw_plan(state, decision, size, self._narration())
            case _:
                log, decisions = self.game.session.log, self.game.decisions
                lines = decisions.among(log.latest(LOG_LINES))
                self._controls.log_back = back = min(self._controls.log_back, max(0, len(lines) - 1))
                return (log.last_number, decisions.changes, back), lambda: draw_log(lines, size, back)

    def _narration(self) -> str | None:
        assert self.game is not None
        assert self._showing is not None
        state, decision = self._showing.planned
        return None if decision is None else self.game.loaded.words.decision(decision, state)


def _around(picture: pygame.Surface, share: float, size: tuple[int, int]) -> pygame.Surface:
    """What fits of a picture that is too high, with the vehicle in it."""
    over = picture.get_height() - size[1]
    if over <= 0:
        return picture
    top = min(over, max(0, int(picture.get_height() * share - size[1] / 2)))
    return picture.subsurface((0, top, picture.get_width(), size[1]))
