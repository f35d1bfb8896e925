"""What the sensor is worth, and what the weather did, as JSON values."""

from __future__ import annotations

from typing import Any

from service.contract.encode.scene import misperception_json
from sim.explain.sensing import Sensing
from sim.explain.weather_effect import WeatherEffect

Json = dict[str, Any]


def sensing_json(found: Sensing) -> Json:
    """How far the sensor detects, and what it gets wrong; ids as in the world."""
    reach = found.reach
    return {
        "sensor": found.state.config.sensor,
        "faithful": found.faithful,
        "range_m": None if reach is None else round(reach.metres, 3),
        "range_cells": None if reach is None else reach.cells,
        "half_detected_cells": None
        if reach is None
        else {kind.value: cells for kind, cells in reach.half.items()},
        "things": found.things,
        "blind": found.blind,
        **misperception_json(found.wrong),
    }


def weather_effect_json(found: WeatherEffect) -> Json:
    """What the weather did to a drive."""
    differs = found.differs
    return {
        "weather": found.weather,
        "caused": found.caused,
        "outcome": found.outcome,
        "clear_outcome": found.clear_outcome,
        "differs": None
        if differs is None
        else {"tick": differs.tick, "made": differs.made, "would": differs.would},
        "evidence": {"ticks": found.clear_ticks},
    }
