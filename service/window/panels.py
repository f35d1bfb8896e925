"""Which views are shown, and which one is large: by key, by click, by sentence."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

from service.actions import Hide, Show

PANELS: Final = ("road", "schematic", "occupancy", "plan", "log")
"""The views of the window, in the order of their keys F1 to F5."""

TITLES: Final = {
    "road": "Road",
    "schematic": "Schematic",
    "occupancy": "Occupancy",
    "plan": "Plan",
    "log": "Log",
}
NAMES: Final = {
    "road": "the road",
    "schematic": "the schematic",
    "occupancy": "the occupancy matrix",
    "plan": "the plan",
    "log": "the log",
}
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
            return "All views again."
        self.shown.add(name)
        self.large = name
        return f"{NAMES[name].capitalize()}, large. Esc brings the others back."

    def show(self, name: str) -> str:
        """Show one; one that is shown already becomes large."""
        if name in self.shown and (self.large or name) == name:
            return (
                self.enlarge(name) if self.large != name else f"{NAMES[name].capitalize()} is large already."
            )
        self.shown.add(name)
        self.large = None
        return f"Showing {NAMES[name]}."

    def hide(self, name: str) -> str:
        """Hide one."""
        if name not in self.shown:
            return f"{NAMES[name].capitalize()} is hidden already."
        self.shown.discard(name)
        if self.large == name:
            self.large = None
        return f"{NAMES[name].capitalize()} is hidden; F{PANELS.index(name) + 1} brings it back."

    def do(self, action: Show | Hide) -> str:
        """What a sentence asked for. Raises `KeyError` for a view that `lacking` tells of."""
        name = HELD_IN.get(action.view, action.view)
        if name not in PANELS:
            raise KeyError(name)
        return self.show(name) if isinstance(action, Show) else self.hide(name)


def lacking(action: Show | Hide) -> str | None:
    """Why a view is not here, as a sentence; None if it is."""
    if HELD_IN.get(action.view, action.view) in PANELS:
        return None
    return f"There is no view of {action.view} here. There are: {', '.join(PANELS)}."
