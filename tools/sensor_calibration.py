"""How well beliefs are calibrated: of the cells believed to be taken at p, the share that is.

    python -m tools.sensor_calibration --cells 1000000

Every ride is a generated road with a seed of its own, driven by `rules` with the sensor. In every tick, all
cells from the vehicle's row to as far as the sensor reaches are counted: believed (the chance that any
hypothesis of the cell is true) against true (a hazard or a mover is there). The expected calibration error
is the mean gap between the two over ten bins of belief, weighed by cells; that of cells in doubt leaves the
bin below 0.1 out, which holds most cells and is easy.
"""

from __future__ import annotations

import argparse
from typing import get_args

import numpy as np

from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.perceive import NO_BELIEF
from sim.perceive.belief import GridBelief, probabilities
from sim.perceive.grid_sensor import gather
from sim.perceive.parameters import SUITES
from sim.perceive.sensor_model import sensor_model, tuning_of
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome
from sim.world.grid import cells_of

BINS = 10


def roads(seed: int, sensor: str, weather: Weather, light: TimeOfDay) -> Config:
    """A configuration with counts that change from seed to seed."""
    return Config(
        seed=seed,
        sensor=sensor,
        weather=weather,
        time_of_day=light,
        potholes=(None, 10, 20)[seed % 3],
        vehicles=(None, 10, 25)[seed // 3 % 3],
        pedestrians=(0, 4)[seed // 9 % 2],
        barriers=(0, 6)[seed // 18 % 2],
    )


def bins_of(sensor: str, weather: Weather, light: TimeOfDay, cells: int) -> np.ndarray:
    """Per bin: cells, sum of beliefs, cells that are taken. Stops after `cells` cells."""
    found = np.zeros((BINS, 3))
    seed = 0
    while found[:, 0].sum() < cells:
        _count_ride(roads(seed, sensor, weather, light), found)
        seed += 1
    return found


def _count_ride(config: Config, found: np.ndarray) -> None:
    suite = SUITES[config.sensor]
    state = SimState.start(config)
    reach = max(
        sensor_model(
            spec, config.weather, config.time_of_day, config.cell_m, config.columns, tuning_of(config)
        ).reach
        for spec in suite
    )
    while state.world.outcome is Outcome.RUNNING:
        world, road = state.world, state.world.road
        before = state.belief if isinstance(state.belief, GridBelief) else NO_BELIEF
        layers = gather(world, config, 0, before, suite).layers
        row = world.av // road.columns
        likely = 1.0 - np.prod(1.0 - probabilities(layers), axis=0)
        there = np.zeros(road.columns * road.rows)
        there[cells_of(world.fixed | world.moving)] = 1.0
        window = slice(max(0, row - reach), row + 1)
        believed = likely[window].ravel()
        true = there.reshape(road.rows, road.columns)[window].ravel()
        place = np.minimum((believed * BINS).astype(int), BINS - 1)
        for column, weights in enumerate((None, believed, true)):
            found[:, column] += np.bincount(place, weights, BINS)
        state = step(state).state


def error(found: np.ndarray) -> float:
    """The expected calibration error of some bins."""
    cells = found[:, 0].sum()
    return float(np.abs(found[:, 1] - found[:, 2]).sum() / cells) if cells else 0.0


def main() -> None:
    """Print a line for each sensor and weather."""
    parser = argparse.ArgumentParser(prog="tools.sensor_calibration")
    parser.add_argument("--cells", type=int, default=100_000)
    parser.add_argument("--sensors", nargs="*", default=list(SUITES))
    parser.add_argument("--weather", nargs="*", default=list(get_args(Weather)))
    parser.add_argument("--light", nargs="*", default=["day"])
    parser.add_argument("--bins", action="store_true", help="print every bin")
    options = parser.parse_args()
    print(f"{'sensor':8} {'weather':7} {'light':6} {'cells':>9}  error  in doubt")
    for sensor in options.sensors:
        for weather in options.weather:
            for light in options.light:
                found = bins_of(sensor, weather, light, options.cells)
                told = f"{error(found):6.4f}  {error(found[1:]):6.4f}"
                print(f"{sensor:8} {weather:7} {light:6} {int(found[:, 0].sum()):9}  {told}", flush=True)
                if options.bins:
                    for number, (cells, believed, true) in enumerate(found):
                        if cells:
                            share = f"{believed / cells:.3f} believed, {true / cells:.3f} true"
                            print(
                                f"  {number / BINS:.1f} to {(number + 1) / BINS:.1f}: {int(cells):8}  {share}"
                            )


if __name__ == "__main__":
    main()
