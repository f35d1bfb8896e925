"""The one value that sensors hand to forecasting."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sim.types import Kind
from sim.world.boards import Boards
from sim.world.grid import Board, Road


@dataclass(frozen=True, slots=True, kw_only=True)
class Percept:
    """What is believed to be where, with the ids that sensors tell apart. Boards as in `World`."""

    road: Road
    tick: int
    episode_tick: int
    ego: int
    """cell index of the vehicle that looks"""
    ego_id: str
    right: Board
    left: Board
    boards: Boards
    yielding: Board
    """movers seen to give way to autonomous vehicles in this tick"""
    attentive: Board
    """movers beside an autonomous vehicle that brake in this tick if it stands still"""
    vehicles: Board
    """autonomous vehicles, the one that looks included"""
    swept: bool
    """whether bodies collide by what they sweep within a tick (`Config.collision`)"""
    movers: Mapping[int, str]
    hazards: Mapping[int, str]

    @property
    def potholes(self) -> Board:
        """The cells of potholes."""
        return self.boards[Kind.POTHOLE]

    @property
    def barriers(self) -> Board:
        """The cells of barriers."""
        return self.boards[Kind.BARRIER]

    @property
    def pedestrians(self) -> Board:
        """The cells of pedestrians."""
        return self.boards[Kind.PEDESTRIAN]
