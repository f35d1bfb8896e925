"""Failures by cause: which sensor or which conditions would have avoided each, found by running it again.

    python -m tools.sensor_attribution --failures 1000

Every failure is verified: each alternative that is said to avoid it is run as a session of its own.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter

from sim.config import Config
from sim.explain.attribution import Alternative, attribute
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

SENSORS = ("camera", "lidar", "radar", "fusion")
WEATHER = ("clear", "rain", "fog", "snow")
LIGHT = ("day", "night")


def config_of(seed: int) -> Config:
    """Sensor, weather and light by seed; default roads and roads with more potholes."""
    number, sensor = divmod(seed, len(SENSORS))
    number, weather = divmod(number, len(WEATHER))
    number, light = divmod(number, len(LIGHT))
    return Config(
        seed=seed,
        sensor=SENSORS[sensor],
        weather=WEATHER[weather],
        time_of_day=LIGHT[light],
        potholes=(None, 15)[number % 2],
    )  # type: ignore[arg-type]


def verified(config: Config, found: Alternative) -> bool:
    """Whether a session with that setting ends as the alternative says."""
    state = SimState.start(config.with_parts(**{found.setting: found.value}))
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return (state.world.outcome, state.world.tick) == (found.outcome, found.ticks)


def main() -> int:
    """Print how many failures each alternative would have avoided."""
    parser = argparse.ArgumentParser(prog="tools.sensor_attribution")
    parser.add_argument("--failures", type=int, default=100)
    options = parser.parse_args()
    told: Counter[str] = Counter()
    asked: Counter[str] = Counter()
    seed = failures = wrong = 0
    while failures < options.failures:
        config = config_of(seed)
        seed += 1
        timeline = Timeline(config)
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        found = attribute(timeline)
        if found is None:
            continue
        failures += 1
        told["no alternative"] += not found.avoided_by
        told["a matter of sensing (perfect avoids it)"] += found.by_sensing
        for each in found.alternatives:
            asked[f"{each.setting} {each.value}"] += 1
            told[f"{each.setting} {each.value}"] += each.avoids
            wrong += not verified(config, each)
    print(f"{failures} failures of {seed} episodes, {wrong} alternatives that a session of its own denies")
    for name, count in told.most_common():
        print(f"{count:6} of {asked[name] or failures:6}  {name}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
