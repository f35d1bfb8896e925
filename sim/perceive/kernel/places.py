"""Where what is in the arguments of the kernel's functions.

- `numbers` (int64): the head (`KEY` to `HEAD`), then the things (cells, kinds, numbers), the cells of the
  autonomous vehicles, and the movers that are followed (layer, cell before, cell after);
- `boards` (uint8): the bytes of the boards `ROAD_RIGHT`, `BELIEVED_FIXED` and `FOLLOWED_RIGHT`;
- `layers` (int16): log odds by layer and cell, changed in place;
- `tables`: `sim.perceive.kernel.tables.SuiteTables`;
- `spots` (int64): rows ahead and column of every thing and vehicle;
- `hidden` (int16): by cell, 1 where a body hides it; the last row is the vehicle's own, the first that of
  the furthest cell that any device sees;
- `reports` (int64): kind, cell, heading (1 right, 0 left), the place of the thing among all, −1 for a false
  alarm, and the row and column of the cell;
- `in_view` (2, things; int64): the places of the things that a device may detect, and words of the detected;
- `shown` (int64): the head (`SHOWN_FIXED` to `SHOWN_HEAD`), then cell, kind and thing of each that is shown,
  then kind, cell and thing of each report;
- `marked` (uint8): the bytes of the boards `SEEN_RIGHT` to `SEEN`.
"""

from __future__ import annotations

from typing import Final

from sim.perceive.kernel.tables import BOARD_OF, LEVELS

KEY, EPISODE, TICK, EGO, HERE, COLUMNS, ROWS, REMEMBERED, TICK_BEFORE, THINGS, FIXED_THINGS, AVS, FOLLOWED = (
    range(13)
)
ROW, COLUMN = 13, 14
HEAD: Final = 15
"""Places in `numbers`. `REMEMBERED`: whether there is a belief from the tick before; `THINGS` and what
follows: how many there are; `ROW` and `COLUMN`: of `HERE`, divided once."""
ROAD_RIGHT, BELIEVED_FIXED, FOLLOWED_RIGHT = range(3)

REPORT_KIND, REPORT_CELL, REPORT_HEADING, REPORT_THING, REPORT_ROW, REPORT_COLUMN = range(6)
REPORT: Final = 6
"""Columns of `reports`."""

SHOWN_FIXED, SHOWN_MOVERS, REPORTS, TIES = range(4)
SHOWN_HEAD: Final = 4
"""Places in `shown`: how many there are, and whether a likelihood is too near a tie to be rounded here."""
TRIPLE: Final = 3

SEEN_RIGHT, SEEN_LEFT, SEEN_FIXED, SEEN_HOLDING, SEEN_OTHERS, SEEN_BOARDS = range(6)
SEEN_DOUBTS: Final = SEEN_BOARDS + int(BOARD_OF.max()) + 1
SEEN: Final = SEEN_DOUBTS + len(LEVELS)
"""Places in `marked`: movers by heading, unions of `Boards`, the kinds with a board, the levels of doubt."""
