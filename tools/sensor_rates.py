"""Success, crash and stuck rates over sensor, weather, density and planner, with Wilson intervals.

    python -m tools.sensor_rates --worlds 100

`--memory off` drives on each look alone, without the belief filter. `--markdown` prints a table of success.
All conditions are driven on the same roads, so two of them are compared road by road: at the end stand the
conditions that are worse than another one in one respect and still drive more roads to the goal (McNemar's
exact test, adjusted by Holm).
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args

from sim.actions import Weather
from sim.config import Config
from sim.perceive import register_sensor
from sim.perceive.devices import GridSensor
from sim.perceive.kernel import run as kernel
from sim.perceive.parameters import SUITES
from sim.state import SimState
from sim.statistics import holm, mcnemar, wilson
from sim.transition import step
from sim.types import Outcome

DENSITIES: dict[str, dict[str, Any]] = {
    "light": {"potholes": 4, "vehicles": 8},
    "default": {},
    "heavy": {"potholes": 20, "vehicles": 25},
}
ENDS = (Outcome.SUCCESS, Outcome.CRASH, Outcome.STUCK)
DOUBTED = 0.05
"""Differences with a smaller adjusted p-value are exceptions."""


@dataclass(frozen=True, slots=True)
class Condition:
    """What a road is driven under."""

    planner: str
    sensor: str
    weather: Weather
    light: str
    density: str

    def __str__(self) -> str:
        return f"{self.planner:9} {self.sensor:8} {self.weather:6} {self.light:6} {self.density:8}"

    def config(self, options: argparse.Namespace) -> Config:
        """The configuration, without a seed."""
        once = options.memory == "off" and self.sensor in SUITES
        return Config(
            planner=self.planner,
            sensor=f"{self.sensor}-once" if once else self.sensor,
            weather=self.weather,
            time_of_day=self.light,  # type: ignore[arg-type]
            preferences=tuple(options.preferences),
            **DENSITIES[self.density],
        )

    def better(self) -> Iterator[Condition]:
        """The conditions next to it that are better and otherwise the same."""
        rest = (self.planner, self.sensor)
        if self.weather != "clear":
            yield Condition(*rest, "clear", self.light, self.density)
        if self.light != "day":
            yield Condition(*rest, self.weather, "day", self.density)
        if self.sensor not in ("perfect", "fusion"):
            yield Condition(self.planner, "fusion", self.weather, self.light, self.density)
        if self.density == "heavy":
            yield Condition(*rest, self.weather, self.light, "default")


def outcome_of(config: Config) -> Outcome:
    """How an episode ends."""
    state = SimState.start(config)
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state.world.outcome


def conditions(options: argparse.Namespace) -> Iterator[Condition]:
    """Every combination that was asked for."""
    for planner in options.planners:
        for sensor in options.sensors:
            for weather in options.weather:
                for light in options.light:
                    for density in options.densities:
                        yield Condition(planner, sensor, weather, light, density)


def compared(ends: dict[Condition, list[Outcome]]) -> Iterator[tuple[Condition, Condition, int, int]]:
    """Worse and better condition, and the roads that only the one and only the other drove to the goal."""
    for worse, found in ends.items():
        for better in worse.better():
            if better in ends:
                pairs = list(zip(found, ends[better], strict=True))
                more = sum(a is Outcome.SUCCESS is not b for a, b in pairs)
                less = sum(b is Outcome.SUCCESS is not a for a, b in pairs)
                yield worse, better, more, less


def told(count: int, worlds: int) -> str:
    """A share in percent with its interval."""
    low, high = wilson(count, worlds)
    return f"{100 * count / worlds:.0f} ({100 * low:.0f} to {100 * high:.0f})"


def print_markdown(ends: dict[Condition, list[Outcome]], options: argparse.Namespace) -> None:
    """A table of success: a row for each planner, sensor, light and density."""
    rows: dict[tuple[str, ...], list[str]] = {}
    for at, found in ends.items():
        row = rows.setdefault((at.planner, at.sensor, at.light, at.density), [])
        row.append(told(found.count(Outcome.SUCCESS), options.worlds))
    print(f"\n| planner | sensor | light | density | {' | '.join(options.weather)} |")
    print("| --- " * (4 + len(options.weather)) + "|")
    for names, cells in rows.items():
        print(f"| {' | '.join((*names, *cells))} |")


def print_inversions(ends: dict[Condition, list[Outcome]]) -> None:
    """Where worse conditions did better."""
    pairs = list(compared(ends))
    values = holm([mcnemar(more, less) for _, _, more, less in pairs])
    found = [(p, *pair) for p, pair in zip(values, pairs, strict=True) if pair[2] > pair[3]]
    sure = [each for each in found if each[0] < DOUBTED]
    print(f"\n{len(pairs)} pairs of a worse and a better condition. The worse one arrives more often in")
    print(
        f"{len(found)}, in {len(sure)} of them with p < {DOUBTED} (McNemar, Holm). The greatest differences:"
    )
    for p, worse, better, more, less in sorted(found, key=lambda each: each[3] - each[4])[-5:]:
        print(f"p {p:.3f}: {more} against {less} roads: {worse} / {better}")


def main() -> None:
    """Print a line for each combination, and what is not monotone."""
    parser = argparse.ArgumentParser(prog="tools.sensor_rates")
    parser.add_argument("--worlds", type=int, default=50)
    parser.add_argument("--planners", nargs="*", default=["rules"])
    parser.add_argument("--sensors", nargs="*", default=["perfect", *SUITES])
    parser.add_argument("--weather", nargs="*", default=list(get_args(Weather)))
    parser.add_argument("--light", nargs="*", default=["day"])
    parser.add_argument("--densities", nargs="*", default=list(DENSITIES))
    parser.add_argument("--preferences", nargs="*", default=[])
    parser.add_argument("--memory", choices=("on", "off"), default="on")
    parser.add_argument("--markdown", action="store_true")
    options = parser.parse_args()
    if options.memory == "off":
        for suite in SUITES:
            register_sensor(GridSensor(f"{suite}-once", suite, remembers=False))
    kernel.load()
    ends: dict[Condition, list[Outcome]] = {}
    print("planner   sensor   weather light  density   success %       crash %         stuck %")
    for condition in conditions(options):
        config = condition.config(options)
        found = [outcome_of(config.with_parts(seed=seed)) for seed in range(options.worlds)]
        ends[condition], counts = found, Counter(found)
        print(
            f"{condition}  " + " ".join(f"{told(counts[end], options.worlds):15}" for end in ENDS), flush=True
        )
    if options.markdown:
        print_markdown(ends, options)
    print_inversions(ends)


if __name__ == "__main__":
    main()
