"""What one tick of sensing takes: percept, belief and forecast, live.

    python -m bench.sensing

Every tick of some drives is sensed again `--repeats` times, and its shortest time counts; printed is the mean
over the ticks. The forecast is rolled out as far as `rules` reads it in every tick.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from statistics import mean
from typing import get_args

from sim.actions import Weather
from sim.config import Config
from sim.forecast import predict
from sim.perceive import perceive
from sim.perceive.belief import GridBelief
from sim.perceive.grid_sensor import gather, show
from sim.perceive.kernel import run as kernel
from sim.perceive.parameters import SUITES
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

FORECAST_TICKS = 8


def states_of(config: Config, count: int) -> list[SimState]:
    """The first states of drives on roads of several seeds."""
    found: list[SimState] = []
    seed = 0
    while len(found) < count:
        state = SimState.start(config.with_parts(seed=seed))
        seed += 1
        while state.world.outcome is Outcome.RUNNING:
            found.append(state)
            state = step(state).state
    return found[:count]


def compiled(state: SimState) -> None:
    """A tick as it is sensed live."""
    percept, _ = perceive(state.world, state.config, 0, state.belief)
    predict(percept, FORECAST_TICKS).slices[0]


def in_arrays(state: SimState) -> None:
    """The same tick without the kernel."""
    world, config, suite = state.world, state.config, SUITES[state.config.sensor]
    belief = state.belief if isinstance(state.belief, GridBelief) else None
    percept, _ = show(world, config, 0, belief, gather(world, config, 0, belief, suite))
    predict(percept, FORECAST_TICKS).slices[0]


def microseconds(states: list[SimState], work: Callable[[SimState], None], repeats: int) -> float:
    """The mean over the states of the shortest time."""
    best = [1 << 62] * len(states)
    for _ in range(repeats):
        for place, state in enumerate(states):
            before = time.perf_counter_ns()
            work(state)
            best[place] = min(best[place], time.perf_counter_ns() - before)
    return mean(best) / 1_000


def main() -> None:
    """Print a row for each sensor."""
    parser = argparse.ArgumentParser(prog="bench.sensing")
    parser.add_argument("--states", type=int, default=200)
    parser.add_argument("--repeats", type=int, default=15)
    parser.add_argument("--weather", nargs="*", default=["clear", "rain"], choices=get_args(Weather))
    options = parser.parse_args()
    kernel.load()
    print("| sensor | weather | compiled (µs) | in arrays (µs) |\n| --- | --- | --- | --- |")
    for sensor in SUITES:
        for weather in options.weather:
            states = states_of(Config(sensor=sensor, weather=weather), options.states)
            times = [microseconds(states, work, options.repeats) for work in (compiled, in_arrays)]
            print(f"| `{sensor}` | {weather} | {times[0]:.0f} | {times[1]:.0f} |", flush=True)


if __name__ == "__main__":
    main()
