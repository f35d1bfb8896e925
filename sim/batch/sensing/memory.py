"""Columns of what a lane remembers from tick to tick besides its grid (int64)."""

from __future__ import annotations

from typing import Final

BEFORE, TICK_BEFORE, LAST_NUMBER, COUNT = 0, 1, 2, 6
"""`BEFORE`: where the vehicle was in the tick before, −1 where nothing is believed yet; `TICK_BEFORE`: the
tick of the episode then; `LAST_NUMBER` and `COUNT`: for each kind of `sim.perceive.look.NUMBER`, the highest
number before this episode and how many things of it are on the road."""
COLUMNS_KEPT: Final = 10
