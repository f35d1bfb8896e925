"""What `rules` achieves beside `priority`, through the live engine, with 95 % intervals (Wilson).

python -m bench planners
python -m bench.planners --seeds 20000 --side 500 --processes 2 --write

`--write` replaces the table of PLANNERS.md.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from multiprocessing import Pool
from pathlib import Path
from typing import Any

from sim.config import Config
from sim.forecast import Forecast
from sim.search.reachability import reachability, steps_left
from sim.state import SimState
from sim.statistics import wilson
from sim.transition import step
from sim.types import Move, Outcome

PLANNERS = ("rules", "priority")
DENSITIES = (None, 0, 10, 20, 40, 60)
SIDES: tuple[dict[str, Any], ...] = (
    {"courtesy": 0.5},
    {"attentive": 0.9},
    {"attentive": 0.0},
    {"pedestrians": 10},
    {"columns": 4, "rows": 20},
    {"columns": 16, "rows": 60},
)
IN_A_ROW = 6
"""So many moves to the left or right without another between count as swinging."""
GROUP = 250


@dataclass
class Tally:
    """What came of drivable roads; `least` is the sum of the fewest ticks on those where it arrived."""

    roads: int = 0
    ends: Counter[Outcome] = field(default_factory=Counter)
    ticks: int = 0
    least: int = 0
    swings: int = 0
    moves: Counter[Move] = field(default_factory=Counter)

    def add(self, other: Tally) -> None:
        """Count another's roads as well."""
        self.roads += other.roads
        self.ends += other.ends
        self.ticks += other.ticks
        self.least += other.least
        self.swings += other.swings
        self.moves += other.moves

    def row(self, name: str, planner: str) -> str:
        """A line of the table."""
        arrived = self.ends[Outcome.SUCCESS]
        moves = max(1, self.moves.total())
        kinds = (
            (Move.FORWARD,),
            (Move.LEFT, Move.RIGHT),
            (Move.FORWARD_LEFT, Move.FORWARD_RIGHT),
            (Move.STAY,),
        )
        mix = " / ".join(f"{100 * sum(self.moves[move] for move in kind) / moves:.0f}" for kind in kinds)
        counts = (arrived, self.ends[Outcome.CRASH], self.ends[Outcome.STUCK])
        ends = " | ".join(_share(count, self.roads) for count in counts)
        ticks = f"{self.ticks / max(1, arrived):.2f} ({self.least / max(1, arrived):.2f})"
        swings = _share(self.swings, self.roads)
        return f"| {name} | `{planner}` | {self.roads} | {ends} | {ticks} | {swings} | {mix} % |"


def driven(seeds: Iterable[int], parts: dict[str, Any]) -> dict[str, Tally]:
    """First episodes of these seeds, by planner; roads that cannot be driven are left out."""
    tallies = {planner: Tally() for planner in PLANNERS}
    for seed in seeds:
        config = Config(seed=seed, **parts)
        start = SimState.start(config)
        limit = steps_left(config, start.world.episode_tick)
        forecast = Forecast.of_truth(start.world, config, limit)
        least = reachability(forecast, 1 << start.world.av, limit).ticks
        if least is None:
            continue
        for planner, tally in tallies.items():
            _drive(SimState(config.with_parts(planner=planner), start.world), least, tally)
    return tallies


def _drive(run: SimState, least: int, tally: Tally) -> None:
    """One episode to its end."""
    aside = longest = 0
    while run.world.outcome is Outcome.RUNNING:
        tick = step(run)
        run = tick.state
        if tick.decision is not None:
            tally.moves[tick.decision.move] += 1
            aside = aside + 1 if tick.decision.move in (Move.LEFT, Move.RIGHT) else 0
            longest = max(longest, aside)
    tally.roads += 1
    tally.ends[run.world.outcome] += 1
    tally.swings += longest >= IN_A_ROW
    if run.world.outcome is Outcome.SUCCESS:
        tally.ticks += run.world.episode_tick
        tally.least += least


def rows(seeds: int, side: int) -> Iterator[tuple[str, dict[str, Any], int]]:
    """Name, configuration and number of seeds of every row."""
    yield "default", {}, seeds
    for potholes in DENSITIES[1:]:
        yield f"{potholes} potholes", {"potholes": potholes}, side * 2
    for parts in SIDES:
        yield ", ".join(f"{name} {value}" for name, value in parts.items()), parts, side
        if "columns" not in parts:
            name = ", ".join(f"{name} {value}" for name, value in {"potholes": 20, **parts}.items())
            yield name, {"potholes": 20, **parts}, side


def main(seeds: int = 2_000, side: int = 500, processes: int = 1, write: bool = False) -> None:
    """Print the table; `write` also puts it into PLANNERS.md."""
    began = time.perf_counter()
    lines: list[str] = []

    def add(line: str) -> None:
        lines.append(line)
        print(line, flush=True)

    add(
        "| road | planner | drivable roads | arrives | crashes | stuck | ticks when it arrives (fewest) "
        f"| {IN_A_ROW} sideways in a row | forward / sideways / diagonal / stays |"
    )
    add("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    with Pool(processes) as pool:
        for name, parts, count in rows(seeds, side):
            groups = [range(first, min(first + GROUP, count)) for first in range(0, count, GROUP)]
            work = partial(driven, parts=parts)
            found = pool.imap_unordered(work, groups) if processes > 1 else map(work, groups)
            sums = {planner: Tally() for planner in PLANNERS}
            for part in found:
                for planner, tally in part.items():
                    sums[planner].add(tally)
            for planner, tally in sums.items():
                add(tally.row(name, planner))
    print(f"\n{seeds} seeds, {side} of side rows, in {time.perf_counter() - began:.0f} s", file=sys.stderr)
    if write:
        page = Path(__file__).with_name("PLANNERS.md")
        head = page.read_text(encoding="utf-8").partition("<!-- table -->")[0]
        page.write_text("\n".join([f"{head}<!-- table -->\n", *lines, ""]), encoding="utf-8")


def _share(hits: int, tries: int) -> str:
    """Per cent with its interval."""
    if not tries:
        return "–"
    low, high = wilson(hits, tries)
    return f"{100 * hits / tries:.2f} % ({100 * low:.2f}–{100 * high:.2f})"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=2_000, help="seeds of the default road")
    parser.add_argument("--side", type=int, default=500, help="seeds of the side rows; twice that by density")
    parser.add_argument("--processes", type=int, default=1, help="processes to share the work")
    parser.add_argument("--write", action="store_true", help="replace the table of PLANNERS.md")
    main(**vars(parser.parse_args()))
