"""Which views are shown, and which one is large: by key, by click, by sentence."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

from service.actions import Hide, Show
from service.resources import DEFAULT_LANGUAGE
from service.window.texts import language, text

PANELS: Final = ("road", "schematic", "occupancy", "plan", "log")
"""The views of the window, in the order of their keys F1 to F5."""

HELD_IN: Final = {"path": "plan", "potholes": "schematic", "metrics": "road"}
"""Views that can be asked for and are part of another here."""


@dataclass
class Panels:
    """What is on screen."""

    shown: set[str] = field(default_factory=lambda: set(PANELS))
    large: str | None = None

    @property
    def visible(self) -> tuple[str, ...]:
        """Those that have room on the screen."""
        if self.large is not None:
            return (self.large,)
        return tuple(name for name in PANELS if name in self.shown)

    def toggle(self, name: str) -> str:
        """Show what is hidden and hide what is shown; what came of it, in a sentence."""
        return self.hide(name) if name in self.shown else self.show(name)

    def enlarge(self, name: str) -> str:
        """Give all the room to one, or give it back."""
        if self.large == name:
            self.large = None
            return text("panels", "all_again")
        self.shown.add(name)
        self.large = name
        return text("panels", "large", view=_named(name))

    def restore(self) -> str:
        """Show all of them, none larger."""
        self.shown, self.large = set(PANELS), None
        return text("panels", "all_again")

    def show(self, name: str) -> str:
        """Show one; one that is shown already becomes large."""
        if name in self.shown and (self.large or name) == name:
            if self.large != name:
                return self.enlarge(name)
            return text("panels", "large_already", view=_named(name))
        self.shown.add(name)
        self.large = None
        return text("panels", "showing", view=text("views", name))

    def hide(self, name: str) -> str:
        """Hide one."""
        if name not in self.shown:
            return text("panels", "hidden_already", view=_named(name))
        self.shown.discard(name)
        if self.large == name:
            self.large = None
        return text("panels", "hidden", view=_named(name), key=PANELS.index(name) + 1)

    def do(self, action: Show | Hide) -> str:
        """What a sentence asked for. Raises `KeyError` for a view that `lacking` tells of."""
        name = HELD_IN.get(action.view, action.view)
        if name not in PANELS:
            raise KeyError(name)
        return self.show(name) if isinstance(action, Show) else self.hide(name)


def title(name: str) -> str:
    """The title of a view."""
    return text("titles", name)


def _named(name: str) -> str:
    """A view at the beginning of a sentence."""
    view = text("views", name)
    return view[0].upper() + view[1:]


def _listed() -> list[str]:
    return list(PANELS) if language() == DEFAULT_LANGUAGE else [title(name) for name in PANELS]


def lacking(action: Show | Hide) -> str | None:
    """Why a view is not here, as a sentence; None if it is."""
    if HELD_IN.get(action.view, action.view) in PANELS:
        return None
    return text("panels", "lacking", view=action.view, views=", ".join(_listed()))
