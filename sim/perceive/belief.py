"""What a vehicle believes of the road: an occupancy grid in log odds, and the names of what it follows.

The grid has a layer for every kind of fixed hazard and two for every kind of mover, one for each heading.
Every cell of every layer is a hypothesis of its own, as in occupancy grids (Moravec & Elfes, 1985; Thrun,
Burgard & Fox, "Probabilistic Robotics", 2005, chapter 9): that two things are seldom in one cell is left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from sim.config import COUNTS, Config
from sim.perceive.log_odds import LIMIT, PROBABILITY, log_odds
from sim.types import HAZARDS, KINDS, MOVERS, Kind
from sim.world.boards import Boards
from sim.world.grid import Board, Road
from sim.world.layouts import has_barriers, vehicles_on_average

Layers = NDArray[np.int32]
"""Log odds (`sim.perceive.log_odds`); shape: layers, rows, columns."""

FIXED: Final = len(HAZARDS)
"""The layers of fixed hazards come first."""
LAYERS: Final = FIXED + 2 * len(MOVERS)
RIGHT: Final = {kind: FIXED + 2 * place for place, kind in enumerate(MOVERS)}
"""The layer of each kind of mover heading right; that of those heading left is the next."""
LAYER: Final = {kind: place for place, kind in enumerate(HAZARDS)}
"""The layer of each kind of fixed hazard."""

LEAST_PRIOR: Final = 0.002
"""What is believed at least of any cell between start and goal: people put things where no draw would."""
LAYOUT_BARRIERS: Final = 0.2
"""Share of cells with a barrier on roads of a family that draws its own (a judgement)."""

_PROBABILITY: Final = np.array(PROBABILITY)


@dataclass(frozen=True, slots=True)
class GridBelief:
    """A belief after a look. A value: equal beliefs have equal effects."""

    layers: bytes
    """`Layers` as 16-bit words"""
    right: Board
    left: Board
    boards: Boards
    """what was shown to the planner"""
    movers: tuple[tuple[int, str], ...]
    hazards: tuple[tuple[int, str], ...]
    """the names of what was shown, by cell"""
    vehicles: Board
    episode_tick: int
    phantoms: int
    """how many things that are not there have had a name"""


def probabilities(layers: Layers) -> NDArray[np.float64]:
    """The probability of each hypothesis."""
    found: NDArray[np.float64] = _PROBABILITY[layers + LIMIT]
    return found


def packed(layers: Layers) -> bytes:
    """The layers as bytes."""
    return layers.astype("<i2").tobytes()


def unpacked(words: bytes, road: Road) -> Layers:
    """The layers from bytes, as an array of their own."""
    grid = np.frombuffer(words, "<i2").astype(np.int32)
    return grid.reshape(LAYERS, road.rows, road.columns)


@lru_cache(maxsize=64)
def prior(config: Config, road: Road) -> Layers:
    """What is believed before any look: how many things of each kind such roads have on average."""
    grid = np.empty((LAYERS, road.rows, road.columns), np.int32)
    for kind in HAZARDS:
        grid[LAYER[kind]] = log_odds(density(config, kind))
    for kind in MOVERS:
        grid[RIGHT[kind] : RIGHT[kind] + 2] = log_odds(density(config, kind) / 2)
    grid[:, (0, -1)] = log_odds(LEAST_PRIOR)
    grid.setflags(write=False)  # shared by all who ask
    return grid


def density(config: Config, kind: Kind) -> float:
    """The share of cells between start and goal that hold a thing of a kind, on average."""
    rows = config.rows - 2
    count = getattr(config, COUNTS[kind]) if kind in COUNTS else 0
    if kind is Kind.BARRIER and has_barriers(config.layout):
        return LAYOUT_BARRIERS
    if count is None and kind is Kind.VEHICLE:
        count = vehicles_on_average(config.layout, config.columns, config.rows, config.vehicle_probability)
    elif count is None:
        count = rows * getattr(config, KINDS[kind].probability or "", 0.0)
    return max(2 * LEAST_PRIOR, count / (rows * config.columns))


def table_of(pairs: tuple[tuple[int, str], ...]) -> Mapping[int, str]:
    """A table of names by cell."""
    return dict(pairs)
