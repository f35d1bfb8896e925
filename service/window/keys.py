"""The keys, as the help tells them."""

from __future__ import annotations

from typing import Final

KEYS: Final[tuple[tuple[str, tuple[tuple[str, str], ...]], ...]] = (
    (
        "The road",
        (
            ("P or Space", "stand still, go on"),
            ("R", "this road again, from its start"),
            ("M", "drive by hand, or let it drive"),
            ("↑ ← → ↓", "by hand: forward, left, right, stay"),
            ("Shift ← →", "by hand: diagonally"),
            ("← →", "standing still: a tick back, a tick on"),
            (", .", "the same, by hand too"),
            ("+ −", "faster, slower"),
            ("Ctrl-Z  Ctrl-Y", "undo, redo"),
        ),
    ),
    (
        "Talking",
        (
            ("/ or Enter", "write a sentence; Enter says it"),
            ("↑ ↓", "what was said before; what is offered"),
            ("Tab", "complete it, or the next that is offered"),
            ("1 … 9", "choose, when asked which"),
            ("Ctrl-A  Ctrl-E", "to the beginning, to the end"),
            ("Ctrl-U  Ctrl-W", "without all before, without a word"),
            ("Ctrl-V", "paste"),
            ("PgUp  PgDn", "more of a long reply; of the log, when not writing"),
        ),
    ),
    (
        "The window",
        (
            ("F1 … F5", "show or hide a view"),
            ("Shift F1 … F5", "make it large; a click on its title too"),
            ("F11", "the whole screen"),
            ("S", "save a picture of the window"),
            ("?", "this help"),
            ("Esc", "leave the line, the help, the large view; quit"),
        ),
    ),
)
"""Groups of keys and what they do."""

EXAMPLES: Final = (
    "add five potholes",
    "add a barrier 20 m ahead in the left lane",
    "why did you do that?",
    "what if there were no potholes?",
    "exactly 12 cars",
    "use astar",
    "hide the log",
    "save this as before the jam",
    "when I say rush hour, I mean heavy traffic",
    "undo that",
)
"""Sentences to begin with; each is understood, which a test sees to."""
