"""The built-in sensors other than the perfect one. Their arrays are loaded with the first look."""

from __future__ import annotations

from dataclasses import dataclass

from sim.config import Config
from sim.perceive.parameters import SUITES
from sim.perceive.percept import Percept
from sim.perceive.sensor import Belief
from sim.world import World


@dataclass(frozen=True)
class GridSensor:
    """A suite of devices and the belief that their looks are gathered in."""

    name: str
    suite: str
    """the key of `SUITES`"""
    remembers: bool = True
    """whether what was seen before counts; without, every look stands for itself"""
    faithful = False

    @property
    def stateless(self) -> bool:
        """See `Sensor`."""
        return not self.remembers

    def perceive(self, world: World, config: Config, ego: int, belief: Belief) -> tuple[Percept, Belief]:
        """See `Sensor.perceive`."""
        # Needs numpy, which sessions with the perfect sensor do without.
        from sim.perceive.grid_sensor import perceive_grid

        return perceive_grid(world, config, ego, belief, SUITES[self.suite], self.remembers)


GRID_SENSORS = tuple(GridSensor(name, name) for name in SUITES)
