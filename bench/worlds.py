"""What planners achieve: 100,000 worlds by density, beside the earlier sketch and the source's report.

python -m bench worlds
"""

from __future__ import annotations

import sys
import time

import numpy as np

from sim.batch import Batch, BatchPlanner
from sim.config import Config

DENSITIES = (None, 0, 10, 20, 40, 60)
SKETCH = {None: 97.9, 10: 93.2, 20: 80.6, 40: 45.2, 60: 15.4}
"""Success of the rule in per cent, as the design's sketch measured it."""
SOLVABLE = {None: 100.0, 10: 100.0, 20: 100.0, 40: 99.9, 60: 98.9}


def main(each: int = 20_000, group: int = 4_000) -> None:
    """Drive `each` worlds of every density with all three planners."""
    began = time.perf_counter()
    print("| potholes | drivable (sketch) | `priority` arrives (sketch) | crashes | stuck | moves | ticks |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    rows = []
    for potholes in DENSITIES:
        counted = dict.fromkeys(("solvable", "missed", "bfs", "weighted", "best", "lost"), 0)
        rule = np.zeros(8, np.int64)
        for first in range(0, each, group):
            configs = [Config(seed=seed, potholes=potholes) for seed in range(first, first + group)]
            least = Batch(configs).least("bfs")
            driven = least > 0
            counted["solvable"] += int(driven.sum())
            counted["best"] += int(least[driven].sum())
            for planner in ("bfs", "weighted"):
                ticks, missed, crashed = _drive(configs, planner, driven)
                counted[planner] += ticks
                counted["missed"] += missed
                counted["lost"] += crashed
            batch = Batch(configs, after="stop")
            batch.run_to_end("priority")
            totals = batch.totals()
            rule += [getattr(totals, name).sum() for name in totals.__slots__]
            if sys.stderr.isatty():
                print(f"\r{potholes} potholes: {first + group} of {each}", end="", file=sys.stderr)
        rows.append((potholes, counted))
        moves = " / ".join(f"{100 * count / rule[:4].sum():.0f}" for count in rule[:4])
        arrives, crashes, stuck = (100 * count / each for count in rule[4:7])
        print(
            f"| {_named(potholes)} | {100 * counted['solvable'] / each:.1f} % "
            f"({SOLVABLE.get(potholes, '–')}) "
            f"| {arrives:.1f} % ({SKETCH.get(potholes, '–')}) | {crashes:.1f} % "
            f"| {stuck:.1f} % | {moves} | {rule[7] / max(1, rule[4]):.1f} |"
        )
    print(
        "\n| potholes | drivable roads | not arrived | crashes | least ticks | `bfs` | `weighted` (astar) |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for potholes, counted in rows:
        best, roads = counted["best"], counted["solvable"]
        print(
            f"| {_named(potholes)} | {roads} | {counted['missed']} | "
            f"{counted['lost']} | {best / roads:.3f} | {counted['bfs'] / best:.4f} × | "
            f"{counted['weighted'] / best:.4f} × |"
        )
    worlds = each * len(DENSITIES)
    print(f"\n{worlds} worlds, three planners each, in {time.perf_counter() - began:.0f} s")


def _named(potholes: int | None) -> str:
    return "15 % a row" if potholes is None else str(potholes)


def _drive(configs: list[Config], planner: BatchPlanner, drivable: np.ndarray) -> tuple[int, int, int]:
    """Ticks of the drivable roads together, how many did not arrive, and crashes of all."""
    batch = Batch(configs, after="stop")
    batch.run_to_end(planner)
    totals = batch.totals()
    missed = int((totals.successes[drivable] == 0).sum())
    return int(totals.ticks_to_goal[drivable].sum()), missed, int(totals.crashes.sum())


if __name__ == "__main__":
    main()
