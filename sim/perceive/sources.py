"""Which devices report what is shown: for answers and pictures, computed anew where it is asked for."""

from __future__ import annotations

from sim.config import Config
from sim.perceive.parameters import SUITES
from sim.perceive.percept import Percept
from sim.world import World


def reporting_devices(
    world: World, config: Config, percept: Percept, ego: int = 0
) -> dict[str, tuple[str, ...]]:
    """The names of the devices that report each thing of a percept in this tick, by its id.

    A thing that is remembered and not reported has none; nothing is listed for sensors not in `SUITES`.
    """
    if config.sensor not in SUITES:
        return {}
    from sim.perceive.grid_sensor import looks

    found: dict[str, tuple[str, ...]] = {}
    reported = [
        (each.model.spec.name, {(report.kind, report.cell) for report in each.reports})
        for each in looks(world, config, ego, SUITES[config.sensor])
    ]
    for thing in percept.things():
        place = thing.kind, world.road.index(thing.cell)
        found[thing.id] = tuple(name for name, places in reported if place in places)
    return found
