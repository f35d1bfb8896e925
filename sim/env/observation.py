"""What a learner is shown, the same for one world and for many.

The *planes* of a road are those that planners can have as well (`sim.perceive.observe`).

A *window* is the part around the ego, with an eighth plane: cells that are not on the road.

An *image* (uint8, 0 to 255) holds the same in three channels of square blocks of pixels, large enough for the
convolutional networks of Stable-Baselines3 (36 pixels a side): red what stays, green what moves, blue the
vehicle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from sim.config import Config
from sim.env.options import one_of, whole_number
from sim.perceive.observe import (
    BARRIERS,
    LEFT,
    ORDER,
    PEDESTRIANS,
    PLANES,
    POTHOLES,
    RIGHT,
    STEPPING,
    VEHICLE,
    Planes,
)
from sim.types import HAZARDS, MARKED, Kind

OFF_ROAD: Final = PLANES
"""One plane more, in windows only."""
_OF_BATCH: Final = (POTHOLES, BARRIERS, RIGHT, LEFT, PEDESTRIANS, VEHICLE, STEPPING)
_LATER: Final = tuple(
    (180 if kind.fixed else 20, ORDER.index(kind))
    for kind in (*HAZARDS, *MARKED)
    if kind not in (Kind.POTHOLE, Kind.BARRIER, Kind.PEDESTRIAN)
)
"""Red of later kinds in an image, and their planes. Those of two such kinds look alike."""

KINDS: Final = ("planes", "image", "image_first")
"""Planes; an image of rows × columns × channels; one of channels × rows × columns."""

MIN_IMAGE_PX: Final = 36
MAX_WINDOW: Final = 512


def batch_planes(planes: Planes) -> Planes:
    """Returns the planes of `Batch.observe` and, empty, those of the kinds that a batch does not know."""
    if planes.shape[1] == PLANES:
        return planes
    whole = np.zeros((planes.shape[0], PLANES, *planes.shape[2:]), np.uint8)
    whole[:, _OF_BATCH] = planes
    return whole


@dataclass(frozen=True, slots=True)
class Window:
    """How many cells around the ego are shown: rows ahead and behind, columns on either side."""

    ahead: int
    behind: int
    side: int

    @staticmethod
    def of(parts: Sequence[int]) -> Window:
        """From (ahead, behind, side). Raises `ValueError`."""
        if not isinstance(parts, tuple | list) or len(parts) != 3:
            raise ValueError(f"window is (rows ahead, rows behind, columns on either side), not {parts!r}")
        names = ("rows ahead", "rows behind", "columns on either side")
        return Window(
            *(
                whole_number(f"window: {name}", part, 0, MAX_WINDOW)
                for name, part in zip(names, parts, strict=True)
            )
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the window."""
        return self.ahead + self.behind + 1, 2 * self.side + 1

    def cut(self, planes: Planes, vehicles: NDArray[np.int64]) -> Planes:
        """Every world's window (shape: worlds, 8, rows, columns of it) from its planes and vehicle's cell."""
        worlds, count, rows, columns = planes.shape
        high, wide = self.shape
        padded = np.zeros((worlds, count + 1, rows + high - 1, columns + wide - 1), np.uint8)
        padded[:, OFF_ROAD] = 1
        road = slice(self.ahead, self.ahead + rows), slice(self.side, self.side + columns)
        padded[:, OFF_ROAD, road[0], road[1]] = 0
        padded[:, :count, road[0], road[1]] = planes
        padded[:, STEPPING] = planes[:, STEPPING, :1, :1]
        row, column = vehicles // columns, vehicles % columns
        cut: Planes = padded[
            np.arange(worlds)[:, None, None, None],
            np.arange(count + 1)[None, :, None, None],
            (row[:, None] + np.arange(high))[:, None, :, None],
            (column[:, None] + np.arange(wide))[:, None, None, :],
        ]
        return cut


@dataclass(frozen=True, slots=True)
class Observer:
    """One way of showing worlds."""

    kind: str
    window: Window | None
    shown: tuple[int, int]
    """rows and columns of cells"""

    @staticmethod
    def of(config: Config, kind: str, window: Sequence[int] | None) -> Observer:
        """The way of this kind. Raises `ValueError`."""
        cut = None if window is None else Window.of(window)
        shown = (config.rows, config.columns) if cut is None else cut.shape
        return Observer(one_of("observation", kind, KINDS), cut, shown)

    @property
    def space(self) -> spaces.Box[np.uint8]:
        """The space of one world's observation."""
        rows, columns = self.shown
        if self.kind == "planes":
            count = PLANES if self.window is None else PLANES + 1
            return spaces.Box(0, 1, (count, rows, columns), np.uint8)
        high, wide = rows * self.block_px, columns * self.block_px
        shape = (high, wide, 3) if self.kind == "image" else (3, high, wide)
        return spaces.Box(0, 255, shape, np.uint8)

    @property
    def block_px(self) -> int:
        """Pixels of a cell's side in an image: so many that the image's shorter side has 36."""
        return -(-MIN_IMAGE_PX // min(self.shown))

    def of_planes(self, planes: Planes, vehicles: NDArray[np.int64]) -> Planes:
        """Every world's observation (shape: worlds, then `space`) from its planes and its vehicle's cell."""
        cells = planes if self.window is None else self.window.cut(planes, vehicles)
        if self.kind == "planes":
            return cells
        painted = self._painted(cells).repeat(self.block_px, axis=2).repeat(self.block_px, axis=3)
        return painted if self.kind == "image_first" else np.ascontiguousarray(painted.transpose(0, 2, 3, 1))

    def _painted(self, cells: Planes) -> Planes:
        """Three channels, a value for each cell; every combination of planes has a value of its own."""
        stepping = cells[:, STEPPING]
        red = 120 * cells[:, POTHOLES] + 255 * cells[:, BARRIERS]
        for shade, plane in _LATER:
            red = red + shade * cells[:, plane]
        if self.window is not None:
            red = red + 60 * cells[:, OFF_ROAD]
        on_foot = cells[:, PEDESTRIANS]
        green = 60 * cells[:, LEFT] + 90 * cells[:, RIGHT] + 60 * on_foot + 90 * (on_foot & stepping)
        blue = (200 + 55 * stepping) * cells[:, VEHICLE]
        return np.stack((red, green, blue), axis=1).astype(np.uint8)
