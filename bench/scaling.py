"""How the cost of a tick grows with the road and with what moves on it: a table, and a plot.

    python -m bench.scaling --write     also writes bench/scaling.svg and bench/SCALING.md

Every figure is the median of several ticks or plans at the beginning of a road, where they cost most.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path

from sim.batch import Batch
from sim.config import Config
from sim.forecast import Forecast
from sim.generation import generate
from sim.search.reachability import shortest_plan, steps_left
from sim.state import SimState
from sim.transition import step

SIZES = ((8, 30), (16, 120), (64, 512))
MOVERS = (1, 10, 50, 100, 500)
ENOUGH_S = 0.4
FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Cost:
    """Microseconds of one kind of work on one road; the batch in nanoseconds a decision."""

    columns: int
    rows: int
    movers: int
    generate_us: float
    priority_us: float
    astar_us: float
    dijkstra_us: float
    exact_plan_us: float
    digest_us: float
    batch_ns: float
    batch_exact_us: float


def main() -> None:
    """Measure all roads and print the table."""
    costs = []
    for columns, rows in SIZES:
        for movers in MOVERS:
            if movers <= columns * (rows - 2) // 2:
                costs.append(_cost(columns, rows, movers))
                if sys.stderr.isatty():
                    print(f"\r{columns} x {rows}, {movers} movers", end="", file=sys.stderr)
    table = _table(costs)
    print(table)
    if "--write" in sys.argv:
        head = "# Cost as roads grow\n\nWritten by `python -m bench.scaling --write`.\n\n![](scaling.svg)\n\n"
        (FOLDER / "SCALING.md").write_text(f"{head}{table}\n")
        _plot(costs)


def _cost(columns: int, rows: int, movers: int) -> Cost:
    holes = columns * rows // 60
    config = Config(columns=columns, rows=rows, vehicles=movers, potholes=holes, seed=1)
    runs = {
        planner: SimState.start(config.with_parts(planner=planner))
        for planner in ("priority", "astar", "dijkstra")
    }
    run = runs["priority"]

    def plan() -> object:
        limit = steps_left(run.config, 0)
        return shortest_plan(Forecast.of_truth(run.world, run.config, limit), limit)

    lanes = 512 if rows < 200 else 64
    configs = [config.with_parts(seed=seed) for seed in range(lanes)]
    batch, ticks = Batch(configs, after="restart"), 100
    return Cost(
        columns,
        rows,
        movers,
        generate_us=_median_us(lambda: generate(config, 1)),
        priority_us=_median_us(lambda: step(runs["priority"])),
        astar_us=_median_us(lambda: step(runs["astar"])),
        dijkstra_us=_median_us(lambda: step(runs["dijkstra"])),
        exact_plan_us=_median_us(plan),
        digest_us=_median_us(run.world.digest),
        batch_ns=_median_us(lambda: batch.run(ticks)) * 1e3 / (lanes * ticks),
        batch_exact_us=_median_us(lambda: Batch.least(batch, "bfs")) / lanes,
    )


def _median_us(work: Callable[[], object]) -> float:
    work()
    times, began = [], time.perf_counter()
    while not times or (time.perf_counter() - began < ENOUGH_S and len(times) < 200):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times) * 1e6


def _table(costs: list[Cost]) -> str:
    heads = (
        "road", "movers", "a road, µs", "live tick `priority`, µs", "`astar`, µs", "`dijkstra`, µs",
        "exact plan live, µs", "digest, µs", "batch decision, ns", "batch exact plan, µs",
    )  # fmt: skip
    lines = [f"| {' | '.join(heads)} |", f"|{' --- |' * len(heads)}"]
    for cost in costs:
        figures = [getattr(cost, field.name) for field in fields(Cost)][3:]
        told = " | ".join(f"{figure:,.1f}" if figure < 100 else f"{figure:,.0f}" for figure in figures)
        lines.append(f"| {cost.columns} × {cost.rows} | {cost.movers} | {told} |")
    return "\n".join(lines)


def _plot(costs: list[Cost]) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    names = {
        "priority_us": "live tick, priority",
        "astar_us": "live tick, astar",
        "dijkstra_us": "live tick, dijkstra",
        "exact_plan_us": "exact plan, live",
        "batch_exact_us": "exact plan, batch",
        "batch_ns": "decision, batch",
    }
    figure, axes = pyplot.subplots(1, len(SIZES), figsize=(11, 4.4), sharey=True, facecolor="white")
    for axis, size in zip(axes, SIZES, strict=True):
        here = [cost for cost in costs if (cost.columns, cost.rows) == size]
        for field, name in names.items():
            scale = 1e-3 if field == "batch_ns" else 1.0
            values = [getattr(cost, field) * scale for cost in here]
            axis.plot([cost.movers for cost in here], values, marker="o", markersize=4, label=name)
        axis.set(xscale="log", yscale="log", title=f"{size[0]} × {size[1]} cells", xlabel="movers")
        axis.grid(visible=True, which="major", alpha=0.3)
    axes[0].set_ylabel("microseconds")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncol=3, frameon=False)
    figure.tight_layout(rect=(0, 0.13, 1, 1))
    figure.savefig(FOLDER / "scaling.svg")


if __name__ == "__main__":
    main()
