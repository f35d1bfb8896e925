"""Decisions a second of a batch with sensors that err, on one core.

    python -m bench.batch_sensing --sensors fusion --weather rain

Default roads (8 × 30 cells), `priority`; the best of `--repeats` runs counts.
"""

from __future__ import annotations

import argparse
import time
from typing import get_args

import numpy as np

from sim.actions import Weather
from sim.batch import Batch
from sim.config import Config
from sim.perceive.parameters import SUITES


def decisions_a_second(config: Config, lanes: int, ticks: int, repeats: int) -> float:
    """Of lanes that begin their next road whenever a result has stood for a tick."""
    batch = Batch.of_seeds(config, np.arange(lanes, dtype=np.int64))
    batch.run(ticks)  # compiles
    best = 0.0
    for _ in range(repeats):
        before = _decisions(batch)
        start = time.process_time()
        batch.run(ticks)
        best = max(best, (_decisions(batch) - before) / (time.process_time() - start))
    return best


def _decisions(batch: Batch) -> int:
    totals = batch.totals()
    return sum(int(each.sum()) for each in (totals.forward, totals.lateral, totals.diagonal, totals.stay))


def main() -> None:
    """Print a row for each sensor and weather."""
    parser = argparse.ArgumentParser(prog="bench.batch_sensing")
    parser.add_argument("--sensors", nargs="*", default=list(SUITES), choices=list(SUITES))
    parser.add_argument("--weather", nargs="*", default=["clear", "rain"], choices=get_args(Weather))
    parser.add_argument("--lanes", type=int, default=512)
    parser.add_argument("--ticks", type=int, default=60)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    print("| sensor | weather | decisions a second |\n| --- | --- | --- |")
    for sensor in options.sensors:
        for weather in options.weather:
            config = Config(sensor=sensor, weather=weather, planner="priority", reset_delay_s=0.5)
            found = decisions_a_second(config, options.lanes, options.ticks, options.repeats)
            print(f"| `{sensor}` | {weather} | {found:,.0f} |", flush=True)


if __name__ == "__main__":
    main()
