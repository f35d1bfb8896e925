"""Small pictures and tables for notebooks, from values alone; everything said by others is escaped."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from service.contract.state import State

CELL = 14
"""Pixels of a cell."""

BEHIND = 3
"""Rows shown behind the vehicle."""

COLOURS = {
    "av": "#1f6feb",
    "vehicle": "#c2410c",
    "pedestrian": "#b45309",
    "pothole": "#111827",
    "barrier": "#dc2626",
}
ROUND = frozenset(("pothole", "pedestrian"))


def road(state: State) -> str:
    """The rows around the vehicle as a drawing, goal above, with a line of figures below."""
    first, shown = _window(state)
    marks = [
        _mark(thing.kind, thing.id, thing.cell[0], thing.cell[1] - first)
        for thing in state.things()
        if first <= thing.cell[1] < first + shown
    ]
    width, height = state.columns * CELL, shown * CELL
    said = f"tick {state.tick} · {state.status} · {'paused' if state.paused else 'running'} · {state.planner}"
    return (
        f'<figure style="margin:0"><svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"'
        f' role="img" aria-label="{escape(said)}"><rect width="{width}" height="{height}" fill="#d1d5db"/>'
        f"{''.join(marks)}</svg><figcaption>{escape(said)}</figcaption></figure>"
    )


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A caption and, where there are rows, a table below it."""
    lines = ["".join(f"<td>{escape(_shown(value))}</td>" for value in row) for row in rows]
    if not lines:
        return f"<p>{escape(caption)}</p>"
    top = "".join(f"<th>{escape(name)}</th>" for name in head)
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    return f"<p>{escape(caption)}</p><table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>"


def note(text: str) -> str:
    """A line in small print."""
    return f'<p style="font-size:smaller;opacity:0.75">{escape(text)}</p>'


def picture(data: bytes, media_type: str) -> str:
    """A picture inside the page."""
    coded = base64.b64encode(data).decode("ascii")
    return f'<img alt="the road" src="data:{escape(media_type)};base64,{coded}">'


def film(data: bytes, media_type: str) -> str:
    """A film inside the page: a GIF plays by itself, anything else when it is started."""
    if media_type.startswith("image/"):
        return picture(data, media_type)
    coded = base64.b64encode(data).decode("ascii")
    return f'<video controls src="data:{escape(media_type)};base64,{coded}"></video>'


def _window(state: State) -> tuple[int, int]:
    """The first row shown, and how many."""
    shown = min(state.visible_rows, state.rows)
    own = state.vehicles[0].cell[1] if state.vehicles else state.rows - 1
    return max(0, min(own + BEHIND + 1 - shown, state.rows - shown)), shown


def _mark(kind: str, name: str, column: int, row: int) -> str:
    x, y, colour = column * CELL, row * CELL, COLOURS.get(kind, "#6b7280")
    title = f"<title>{escape(name)}</title>"
    if kind in ROUND:
        half = CELL // 2
        return f'<circle cx="{x + half}" cy="{y + half}" r="{half - 2}" fill="{colour}">{title}</circle>'
    side = CELL - 2
    return f'<rect x="{x + 1}" y="{y + 1}" width="{side}" height="{side}" fill="{colour}">{title}</rect>'


def _shown(value: Any) -> str:
    return "–" if value is None else str(value)
