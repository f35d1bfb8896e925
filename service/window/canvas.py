"""The screen, of which only what has changed is drawn again."""

from __future__ import annotations

from collections.abc import Callable, Hashable

import pygame

from service.window import theme as look
from sim.render import theme


class Canvas:
    """Parts of a picture, each with a key that says whether it still looks the same."""

    def __init__(self, screen: pygame.Surface) -> None:
        self.screen = screen
        self._parts: dict[str, tuple[tuple[int, int, int, int], Hashable]] = {}
        self._dirty: list[pygame.Rect] = []
        self._over: Hashable = None
        self.clear()

    def clear(self) -> None:
        """Forget everything; all is drawn anew."""
        self._parts.clear()
        self._over = None
        self.screen.fill(look.GROUND)
        self._dirty = [self.screen.get_rect()]

    def part(self, name: str, place: pygame.Rect, key: Hashable, draw: Callable[[], pygame.Surface]) -> None:
        """One part; what is smaller than its place stands in the middle of it."""
        state = (tuple(place), key)
        if self._parts.get(name) == state:
            return
        self._parts[name] = state  # type: ignore[assignment]
        picture = draw()
        if picture.get_size() != place.size:
            self.screen.fill(theme.BODY, place)
        spot = picture.get_rect(center=place.center).clip(place)
        self.screen.set_clip(place)
        self.screen.blit(picture, picture.get_rect(center=place.center))
        self.screen.set_clip(None)
        self._dirty.append(place if picture.get_size() != place.size else spot)

    def over(self, key: Hashable, picture: Callable[[], pygame.Surface]) -> None:
        """A card over everything. It is laid again whenever anything under it was drawn."""
        if key == self._over and not self._dirty:
            return
        self._over = key
        shape = picture()
        place = shape.get_rect(center=self.screen.get_rect().center)
        self.screen.blit(shape, place)
        self._dirty.append(place)

    @property
    def covered(self) -> bool:
        """Whether a card lies over everything."""
        return self._over is not None

    def changed(self) -> list[pygame.Rect]:
        """What was drawn since this was last asked."""
        dirty, self._dirty = self._dirty, []
        return dirty
