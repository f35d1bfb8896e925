"""The one value that sensors hand to forecasting."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sim.road import Board, Road


@dataclass(frozen=True, slots=True, kw_only=True)
class Percept:
    """What is believed to be where, with the ids that sensors tell apart. Boards as in `World`."""

    road: Road
    tick: int
    episode_tick: int
    ego: int
    """cell index of the vehicle that looks"""
    ego_id: str
    potholes: Board
    barriers: Board
    right: Board
    left: Board
    pedestrians: Board
    yielding: Board
    """movers seen to give way to autonomous vehicles in this tick"""
    vehicles: Board
    """autonomous vehicles, the one that looks included"""
    movers: Mapping[int, str]
    hazards: Mapping[int, str]
