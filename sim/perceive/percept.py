"""The one value that sensors hand to forecasting."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sim.rules.behaviour import DEFAULT_BEHAVIOUR
from sim.rules.dynamics import DEFAULT_DYNAMICS
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
    potholes: Board
    barriers: Board
    right: Board
    left: Board
    pedestrians: Board
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
    dynamics: str = DEFAULT_DYNAMICS
    """how autonomous vehicles move (`sim.rules.dynamics`)"""
    behaviour: str = DEFAULT_BEHAVIOUR
    """how the others move (`sim.rules.behaviour`)"""
