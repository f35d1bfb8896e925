"""Colours, sizes and labels of the pictures."""

from __future__ import annotations

from typing import Final

Colour = tuple[int, int, int]

CELL_PX: Final = 90
"""side of a cell in the road view, in pixels, if no size is given"""

MAX_SIDE_PX: Final = 2_160
"""longest side of a picture, in pixels"""

VERGE: Final[Colour] = (34, 44, 38)
ASPHALT: Final[Colour] = (52, 56, 63)
ASPHALT_GRAIN: Final[tuple[Colour, ...]] = ((47, 51, 58), (57, 61, 68), (61, 65, 72))
VERGE_LIGHT: Final[Colour] = (195, 207, 180)
ASPHALT_LIGHT: Final[Colour] = (109, 113, 121)
ASPHALT_GRAIN_LIGHT: Final[tuple[Colour, ...]] = ((103, 107, 115), (115, 119, 127), (121, 125, 133))
LANE_LINE_LIGHT: Final[Colour] = (201, 204, 210)
EDGE_LINE: Final[Colour] = (232, 226, 205)
LANE_LINE: Final[Colour] = (112, 118, 127)
FINISH: Final[tuple[Colour, Colour]] = ((238, 238, 234), (28, 30, 34))

AV: Final[Colour] = (64, 132, 255)
OTHER_AVS: Final[tuple[Colour, ...]] = ((150, 104, 255), (38, 188, 214), (246, 120, 190))
"""egos beside the first, in the order of their ids"""
AV_GLASS: Final[Colour] = (20, 38, 74)
VEHICLES: Final[tuple[Colour, ...]] = (
    (222, 92, 84),
    (226, 148, 66),
    (190, 112, 200),
    (92, 176, 142),
    (206, 190, 96),
    (150, 160, 176),
)
GLASS: Final[Colour] = (30, 34, 42)
SENSOR: Final[Colour] = (223, 233, 255)
TYRE: Final[Colour] = (14, 15, 18)
HEADLIGHT: Final[Colour] = (255, 240, 190)
TAILLIGHT: Final[Colour] = (255, 74, 66)
DISABLED: Final[Colour] = (104, 104, 108)
PEDESTRIANS: Final[tuple[Colour, ...]] = ((236, 196, 92), (112, 200, 206), (238, 138, 150), (170, 200, 110))
SKIN: Final[Colour] = (224, 184, 150)
HAIR: Final[Colour] = (74, 52, 38)
SHOE: Final[Colour] = (36, 42, 56)
BARRIER: Final[tuple[Colour, Colour]] = ((240, 122, 48), (244, 240, 232))
FOOT: Final[Colour] = (70, 74, 82)
LAMP: Final[Colour] = (255, 196, 84)
HOLE: Final[tuple[Colour, Colour, Colour]] = ((40, 42, 47), (24, 25, 28), (12, 12, 14))
CRACK: Final[Colour] = (30, 32, 36)
CRUMBLE: Final[Colour] = (66, 69, 76)
RIM: Final[Colour] = (92, 96, 104)
IMPACT: Final[tuple[Colour, Colour, Colour]] = ((240, 84, 78), (250, 176, 72), (255, 244, 214))
BOX: Final[Colour] = (204, 208, 214)
MOVE: Final[Colour] = (96, 220, 140)
UNDER_WAY: Final[Colour] = (110, 163, 255)
"""the move that is being made, and the way behind it"""
NEXT: Final[Colour] = (95, 224, 160)
WAIT: Final[Colour] = (240, 84, 78)
EXPECTED: Final[dict[str, Colour]] = {"vehicle": (255, 162, 155), "pedestrian": (127, 224, 189)}
"""movers where they are expected"""

PANEL: Final = (18, 20, 24, 205)
TEXT: Final[Colour] = (236, 238, 242)
TEXT_QUIET: Final[Colour] = (160, 168, 178)
OUTCOMES: Final[dict[str, Colour]] = {
    "success": (78, 201, 122),
    "crash": (240, 84, 78),
    "stuck": (240, 178, 70),
}

SCHEMATIC_ROAD: Final[Colour] = (38, 41, 47)
SCHEMATIC_GRID: Final[Colour] = (52, 56, 63)
SCHEMATIC: Final[dict[str, Colour]] = {
    "av": AV,
    "vehicle": (226, 84, 78),
    "pedestrian": (112, 200, 206),
    "pothole": (240, 200, 70),
    "barrier": (240, 122, 48),
}

OTHER_KIND: Final[Colour] = (190, 130, 230)


def colour_of(kind: str) -> Colour:
    """The colour of a kind where it is a mark and not a picture; one for all kinds without their own."""
    return SCHEMATIC.get(kind, OTHER_KIND)


def colour_of_ego(number: int) -> Colour:
    """The colour of an ego by its place in `World.avs`."""
    return OTHER_AVS[(number - 1) % len(OTHER_AVS)] if number else AV


REASONS: Final[dict[str, str]] = {
    "free": "free",
    "off_road": "off the road",
    "pothole": "pothole",
    "barrier": "barrier",
    "disabled_mover": "broken down",
    "mover_stays": "in the way",
    "mover_enters": "coming",
    "mover_swaps": "head-on",
    "mover_crosses": "cut off",
    "ego_stays": "in the way",
    "ego_enters": "coming",
    "ego_swaps": "head-on",
    "ego_crosses": "cut off",
}
"""why a move is not chosen; for movers the name of the mover is put before it"""
MOVES: Final[dict[str, str]] = {
    "forward": "forward",
    "left": "left",
    "right": "right",
    "forward_left": "forward left",
    "forward_right": "forward right",
    "stay": "stay",
}

BODY: Final[Colour] = (24, 27, 32)
"""background of views other than the road"""
OFF_ROAD: Final[Colour] = (30, 38, 34)
ZERO: Final[Colour] = (74, 80, 90)
ON_KIND: Final[Colour] = (16, 18, 22)
"""text on the colour of a kind"""
REFUSED: Final[Colour] = (240, 108, 98)
LINES: Final[dict[str, Colour]] = {
    "crashed": OUTCOMES["crash"],
    "failed": OUTCOMES["crash"],
    "planner_failed": OUTCOMES["crash"],
    "arrived": OUTCOMES["success"],
    "stuck": OUTCOMES["stuck"],
    "no_way": OUTCOMES["stuck"],
    "way_open": OUTCOMES["success"],
    "held_back": OUTCOMES["stuck"],
    "changed": (120, 170, 255),
    "taught": (120, 170, 255),
    "forgotten": (120, 170, 255),
}
"""colours of lines of the log by event type; other lines have the colour of text"""
