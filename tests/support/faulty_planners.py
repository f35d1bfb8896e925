"""Planners that break one promise each, and one that keeps them all."""
# ruff: noqa: ARG002 - they must look like planners

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from dataclasses import replace

from sim.config import Config
from sim.forecast import Forecast
from sim.plan import Decision
from sim.plan.priority import PriorityPlanner
from sim.types import Move


class Good(PriorityPlanner):
    name = "good"


class Raises(Good):
    name = "raises"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        raise ZeroDivisionError("no way out")


class Dies(Good):
    name = "dies"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        os._exit(3)


class Hangs(Good):
    name = "hangs"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        if forecast.tick >= 3:
            time.sleep(3600)
        return super().decide(forecast, config)


class Nonsense(Good):
    name = "nonsense"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        return "sideways"  # type: ignore[return-value]


class Sideways(Good):
    name = "sideways"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        return replace(super().decide(forecast, config), move="sideways")  # type: ignore[arg-type]


class Leaves(Good):
    """Always left, even off the road."""

    name = "leaves"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        return replace(super().decide(forecast, config), move=Move.LEFT)


class Lies(Good):
    """Says that every cell is free."""

    name = "lies"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        taken = super().decide(forecast, config)
        free = taken.option(Move.STAY).reason.FREE
        return replace(taken, options=tuple(replace(o, reason=free, causes=()) for o in taken.options))


class Careless(Good):
    """Ahead, whatever is there."""

    name = "careless"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        return replace(super().decide(forecast, config), move=Move.FORWARD)


class Remembers(Good):
    """Counts its calls."""

    name = "remembers"

    def __init__(self) -> None:
        self.calls = 0

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        self.calls += 1
        taken = super().decide(forecast, config)
        return replace(taken, move=Move.STAY) if self.calls % 3 == 0 else taken


class Meddles(Good):
    """Takes the hazards away from what it is shown."""

    name = "meddles"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        taken = super().decide(forecast, config)
        forecast.hazards.clear()  # type: ignore[attr-defined]
        return taken


class Peeps(Good):
    """Reads further than it asked for."""

    name = "peeps"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        forecast.blocked(5)
        return super().decide(forecast, config)


class Endless(Good):
    name = "endless"

    def horizon(self, config: Config) -> int:
        return -1


FAULTY = (Raises, Dies, Hangs, Nonsense, Sideways, Leaves, Endless)
"""What a session must withstand."""


def package(folder: str, planners: Mapping[str, type[object]] | None = None, name: str = "faulty") -> None:
    """Make a folder look like an installed package that brings these planners, or all of this file."""
    info = os.path.join(folder, f"{name}-1.0.dist-info")
    os.makedirs(info)
    if planners is None:
        planners = {each.name: each for each in (Good, *FAULTY)}
    lines = [f"{key} = {each.__module__}:{each.__name__}" for key, each in planners.items()]
    with open(os.path.join(info, "entry_points.txt"), "w") as points:
        points.write("[roadtalk.planners]\n" + "\n".join(lines) + "\n")
    with open(os.path.join(info, "METADATA"), "w") as metadata:
        metadata.write(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
