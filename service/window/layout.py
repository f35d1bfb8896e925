"""Where everything stands, for any size of the window and any shape of the road.

The road takes what the others leave; the strip below, with the line to type in and the log, takes what
the road cannot use. Nothing here draws.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import pygame

HEAD_PX: Final = 26
"""height of a panel's title"""
LEAST_STRIP_PX: Final = 178
LARGE_STRIP_PX: Final = 150
MOST_PLAN_PX: Final = 560
MOST_TALL_SHARE: Final = 0.2
"""of the width, for a view of the whole road"""


@dataclass(frozen=True, slots=True)
class Shape:
    """Columns, rows, and rows seen at once, of a road."""

    columns: int
    rows: int
    seen: int


def gap_of(size: tuple[int, int]) -> int:
    """Room between things."""
    return 12 if min(size) >= 800 else 8


@lru_cache(maxsize=8)
def arrange(
    size: tuple[int, int], shown: frozenset[str], large: str | None, shape: Shape
) -> Mapping[str, pygame.Rect]:
    """A place for each view that is shown, title included, and for the `console`."""
    gap = gap_of(size)
    inner = pygame.Rect(gap, gap, max(1, size[0] - 2 * gap), max(1, size[1] - 2 * gap))
    if large is not None:
        strip = min(LARGE_STRIP_PX, inner.height // 2)
        top = max(1, inner.height - strip - gap)
        console = pygame.Rect(inner.x, inner.bottom - strip, inner.width, strip)
        return {large: pygame.Rect(inner.x, inner.y, inner.width, top), "console": console}
    above = [name for name in ("road", "schematic", "occupancy", "plan") if name in shown]
    if not above:
        return _strip(inner, "log" in shown, gap, {})
    least = min(LEAST_STRIP_PX, inner.height // 2)
    highest = max(1, inner.height - least - gap)
    best = max(
        range(highest, max(1, highest // 2), -6) if "road" in above else (highest,),
        key=lambda top: (_road_cell(inner.width, top, above, gap, shape), -top),
    )
    places = _columns(pygame.Rect(inner.x, inner.y, inner.width, best), above, gap, shape)
    rest = pygame.Rect(inner.x, inner.y + best + gap, inner.width, inner.height - best - gap)
    return _strip(rest, "log" in shown, gap, places)


def _strip(room: pygame.Rect, log: bool, gap: int, places: dict[str, pygame.Rect]) -> dict[str, pygame.Rect]:
    width = max(260, room.width * 38 // 100) if log else 0
    if log:
        places["log"] = pygame.Rect(room.right - width, room.y, width, room.height)
    console = room.width - width - gap if log else room.width
    places["console"] = pygame.Rect(room.x, room.y, max(1, console), room.height)
    return places


def _tall_px(width: int, top: int, shape: Shape) -> int:
    """Width of a view of the whole road."""
    body = max(1, top - HEAD_PX - 8)
    cell = max(1, min(body // shape.rows, int(width * MOST_TALL_SHARE) // shape.columns))
    return max(84, cell * shape.columns + 16)


def _widths(width: int, top: int, above: Collection[str], gap: int, shape: Shape) -> dict[str, int]:
    widths = {name: _tall_px(width, top, shape) for name in ("schematic", "occupancy") if name in above}
    if "plan" in above:
        widths["plan"] = max(170, min(380, width * 22 // 100))
    wide = "road" if "road" in above else "plan" if "plan" in above else None
    used = sum(px for name, px in widths.items() if name != wide) + gap * (len(above) - 1)
    if wide is not None:
        widths[wide] = max(1, width - used)
    else:
        for name in widths:
            widths[name] = max(1, (width - gap * (len(above) - 1)) // len(widths))
    return widths


def _road_cell(width: int, top: int, above: Collection[str], gap: int, shape: Shape) -> int:
    """Side of a cell of the road view, were this the height of the upper part."""
    if "road" not in above:
        return 0
    room = _widths(width, top, above, gap, shape)["road"]
    return min(int(room / (shape.columns + 0.5)), (top - HEAD_PX) // shape.seen)


def _columns(room: pygame.Rect, above: Collection[str], gap: int, shape: Shape) -> dict[str, pygame.Rect]:
    widths = _widths(room.width, room.height, above, gap, shape)
    if "road" in widths and "plan" in widths:
        # What the road cannot use because of its height, the plan can.
        cell = _road_cell(room.width, room.height, above, gap, shape)
        spare = widths["road"] - int(cell * (shape.columns + 0.5)) - 2
        more = max(0, min(spare, MOST_PLAN_PX - widths["plan"], room.height - 300 - widths["plan"]))
        widths["road"] -= more
        widths["plan"] += more
    places, x = {}, room.x
    for name in above:
        places[name] = pygame.Rect(x, room.y, widths[name], room.height)
        x += widths[name] + gap
    return places


def body_of(panel: pygame.Rect) -> pygame.Rect:
    """The panel without its title."""
    return pygame.Rect(panel.x, panel.y + HEAD_PX, panel.width, max(1, panel.height - HEAD_PX))


def head_of(panel: pygame.Rect) -> pygame.Rect:
    """The panel's title."""
    return pygame.Rect(panel.x, panel.y, panel.width, min(HEAD_PX, panel.height))


def close_of(panel: pygame.Rect) -> pygame.Rect:
    """What is clicked to hide it."""
    return pygame.Rect(panel.right - HEAD_PX, panel.y, HEAD_PX, HEAD_PX)
