"""Success, crash and stuck rates over sensor, weather, density and planner, with Wilson intervals.

    python -m tools.sensor_rates --worlds 100

`--memory off` drives on each look alone, without the belief filter.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from typing import Any, get_args

from sim.actions import Weather
from sim.config import Config
from sim.perceive import register_sensor
from sim.perceive.devices import GridSensor
from sim.perceive.parameters import SUITES
from sim.state import SimState
from sim.statistics import wilson
from sim.transition import step
from sim.types import Outcome

DENSITIES: dict[str, dict[str, Any]] = {
    "light": {"potholes": 4, "vehicles": 8},
    "default": {},
    "heavy": {"potholes": 20, "vehicles": 25},
}


def outcome_of(config: Config) -> Outcome:
    """How an episode ends."""
    state = SimState.start(config)
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state.world.outcome


def conditions(options: argparse.Namespace) -> Iterator[tuple[str, Config]]:
    """Every combination that was asked for, with its name."""
    for planner in options.planners:
        for sensor in options.sensors:
            for weather in options.weather:
                for light in options.light:
                    for density in options.densities:
                        name = f"{planner:9} {sensor:8} {weather:6} {light:6} {density:8}"
                        used = f"{sensor}-once" if options.memory == "off" and sensor in SUITES else sensor
                        yield (
                            name,
                            Config(
                                planner=planner,
                                sensor=used,
                                weather=weather,
                                time_of_day=light,
                                preferences=tuple(options.preferences),
                                **DENSITIES[density],
                            ),
                        )


def main() -> None:
    """Print a line for each combination."""
    parser = argparse.ArgumentParser(prog="tools.sensor_rates")
    parser.add_argument("--worlds", type=int, default=50)
    parser.add_argument("--planners", nargs="*", default=["rules"])
    parser.add_argument("--sensors", nargs="*", default=["perfect", *SUITES])
    parser.add_argument("--weather", nargs="*", default=list(get_args(Weather)))
    parser.add_argument("--light", nargs="*", default=["day"])
    parser.add_argument("--densities", nargs="*", default=list(DENSITIES))
    parser.add_argument("--preferences", nargs="*", default=[])
    parser.add_argument("--memory", choices=("on", "off"), default="on")
    options = parser.parse_args()
    if options.memory == "off":
        for suite in SUITES:
            register_sensor(GridSensor(f"{suite}-once", suite, remembers=False))
    print("planner   sensor   weather light  density   success %           crash %             stuck %")
    for name, config in conditions(options):
        ends = Counter(outcome_of(config.with_parts(seed=seed)) for seed in range(options.worlds))
        told = []
        for outcome in (Outcome.SUCCESS, Outcome.CRASH, Outcome.STUCK):
            low, high = wilson(ends[outcome], options.worlds)
            share = ends[outcome] / options.worlds
            told.append(f"{100 * share:5.1f} ({100 * low:.1f} to {100 * high:.1f})")
        print(f"{name}  " + "  ".join(f"{each:18}" for each in told), flush=True)


if __name__ == "__main__":
    main()
