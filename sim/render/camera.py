"""The camera: which rows are on screen, and where a cell is drawn."""

from __future__ import annotations

from dataclasses import dataclass

from sim.config import Config
from sim.render.theme import CELL_PX, MAX_SIDE_PX

AHEAD_SHARE = 0.7
"""Vertical position of the ego on screen (0 is the top), so that more of the road ahead is seen."""


@dataclass(frozen=True, slots=True)
class Camera:
    """A view of `rows` rows from row `top` on (a fraction while it glides); sizes in pixels."""

    cell_px: int
    verge_px: int
    columns: int
    rows: int
    top: float

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture, in pixels."""
        return self.columns * self.cell_px + 2 * self.verge_px, self.rows * self.cell_px

    def centre(self, column: float, row: float) -> tuple[int, int]:
        """The centre of a cell on screen (x, y), in pixels."""
        x = self.verge_px + (column + 0.5) * self.cell_px
        return round(x), round((row + 0.5 - self.top) * self.cell_px)

    def sees(self, row: float) -> bool:
        """Whether any part of a row is on screen."""
        return self.top - 1.0 < row < self.top + self.rows


def camera_on(config: Config, row: float, size: tuple[int, int] | None) -> Camera:
    """The camera that follows an ego in `row`, within `size` pixels; it stops at both ends of the road."""
    rows = min(config.visible_rows, config.rows)
    width, height = size or (MAX_SIDE_PX, MAX_SIDE_PX)
    fitting = min(int(width / (config.columns + 0.5)), height // rows)
    cell = max(1, min(fitting, CELL_PX) if size is None else fitting)
    top = min(max(0.0, row + 0.5 - AHEAD_SHARE * rows), float(config.rows - rows))
    return Camera(cell, cell // 4, config.columns, rows, top)
