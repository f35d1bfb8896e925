"""What planners and preferences do on every family of roads, with intervals. The tables of FAMILIES.md.

python -m bench.families --seeds 50 --write

Every planner drives the first episodes of the same seeds, tick by tick, by the live engine. Preferences are
compared with `balanced` seed by seed: an interval of mean differences that leaves out 0 is an effect.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import pairwise, product
from pathlib import Path
from statistics import fmean
from typing import Final, get_args

from sim.actions import Layout, Preference
from sim.config import Config
from sim.oracle import least_cost, least_ticks
from sim.search.costs import weights
from sim.search.time_expanded import around
from sim.state import SimState
from sim.statistics import mean, wilson
from sim.transition import step
from sim.types import Move, Outcome
from sim.world import World

FAMILIES: Final[tuple[Layout | None, ...]] = (None, *get_args(Layout))
WEIGHED: Final = "astar"
PLANNERS: Final = ("priority", "rules", "bfs", WEIGHED)
PREFERENCES: Final[tuple[Preference, ...]] = get_args(Preference)
BALANCED: Final = "balanced"
FARTHEST: Final = 8
"""Cells beyond which a distance is not told apart."""
_ASIDE: Final = {Move.LEFT: -1, Move.FORWARD_LEFT: -1, Move.RIGHT: 1, Move.FORWARD_RIGHT: 1}


@dataclass(frozen=True, slots=True)
class Driven:
    """What came of one episode; regrets are None where it did not arrive."""

    arrived: bool
    ticks: int
    late: int | None
    """ticks over the least"""
    dear: int | None
    """cost over the least, by the configuration's own charges"""
    clearance: float
    """mean distance to the nearest hazard or mover, in cells, diagonals counted as one"""
    beside: float
    """share of ticks with a hazard or mover in one of the eight cells around"""
    beside_potholes: float
    """the same of potholes alone, in ticks"""
    aside: float
    """sideways and diagonal moves per 100 ticks"""
    turns: float
    """changes of direction per 100 ticks: straight, to the left, to the right"""


def drive(config: Config) -> Driven:
    """The first episode of a configuration, to its end."""
    run = SimState.start(config)
    best, cheapest, charges = least_ticks(run), least_cost(run), weights(config)
    distances: list[int] = []
    moves: list[Move] = []
    paid = potholes = 0
    while run.world.outcome is Outcome.RUNNING:
        ticked = step(run)
        assert ticked.decision is not None
        run = ticked.state
        moves.append(ticked.decision.move)
        near_movers = _distance(run.world, run.world.right | run.world.left)
        near_fixed = _distance(run.world, run.world.fixed)
        distances.append(min(near_movers, near_fixed))
        potholes += _distance(run.world, run.world.potholes) == 1
        paid += charges.of(moves[-1]) + charges.fixed * (near_fixed <= 1)
        paid += charges.mover * max(0, charges.buffer + 1 - max(near_movers, 1))
    arrived = run.world.outcome is Outcome.SUCCESS
    sides = [_ASIDE.get(move, 0) for move in moves]
    turns = sum(one != other for one, other in pairwise(sides))
    whole = len(moves)
    return Driven(
        arrived=arrived,
        ticks=whole,
        late=whole - best if arrived and best is not None else None,
        dear=paid - cheapest if arrived and cheapest is not None else None,
        clearance=fmean(distances),
        beside=sum(distance <= 1 for distance in distances) / whole,
        beside_potholes=potholes,
        aside=100 * sum(side != 0 for side in sides) / whole,
        turns=100 * turns / whole,
    )


def _distance(world: World, board: int) -> int:
    """Cells to the nearest of a board from the vehicle, diagonals counted as one."""
    reached, distance = 1 << world.av, 0
    while not reached & board and distance < FARTHEST:
        reached, distance = around(reached, world.road), distance + 1
    return distance


def effect(
    one: Sequence[Driven], other: Sequence[Driven], measure: Callable[[Driven], float]
) -> tuple[float, float]:
    """What `one` has more than `other` on average where both arrive, and half the interval."""
    both = [(a, b) for a, b in zip(one, other, strict=True) if a.arrived and b.arrived]
    return mean([measure(a) - measure(b) for a, b in both])


INTENDED: Final[dict[Preference, tuple[str, int, Callable[[Driven], float]]]] = {
    "avoid_potholes": ("ticks beside potholes", -1, lambda driven: driven.beside_potholes),
    "smooth_ride": ("changes of direction per 100 ticks", -1, lambda driven: driven.turns),
    "fastest": ("ticks", -1, lambda driven: driven.ticks),
    "cautious": ("mean distance to the nearest, cells", 1, lambda driven: driven.clearance),
}
"""What each preference should change against `balanced`, and to which side."""


def configured(family: Layout | None, planner: str, wishes: tuple[Preference, ...], seed: int) -> Config:
    """One cell's configuration: the default road, or one of a family."""
    return Config(layout=family, planner=planner, preferences=wishes, seed=seed)


Cells = dict[tuple[Layout | None, str, str], list[Driven]]


def driven(families: Iterable[Layout | None], seeds: int, workers: int) -> Cells:
    """Every cell of the table, its episodes spread over processes."""
    cells: Cells = {}
    with ProcessPoolExecutor(workers) as pool:
        for family, planner in product(families, PLANNERS):
            for wish in (None, *PREFERENCES) if planner == WEIGHED else (None,):
                configs = [
                    configured(family, planner, (wish,) if wish else (), seed) for seed in range(seeds)
                ]
                cells[family, planner, wish or BALANCED] = list(pool.map(drive, configs, chunksize=4))
                if sys.stderr.isatty():
                    print(f"\r{_named(family)}, {planner}, {wish}      ", end="", file=sys.stderr)
    return cells


def tables(cells: Cells) -> str:
    """Both tables as Markdown."""
    lines = [
        "| family | planner | preference | arrives % | ticks over the least | cost over the least "
        "| nearest, cells | ticks beside something % | aside / 100 ticks | turns / 100 ticks |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for (family, planner, wish), found in cells.items():
        hits = sum(each.arrived for each in found)
        low, high = wilson(hits, len(found))
        late = [each.late for each in found if each.late is not None]
        dear = [each.dear for each in found if each.dear is not None]
        told = [
            family or "scattered",
            f"`{planner}`",
            wish if planner == WEIGHED else "–",
            f"{100 * hits / len(found):.0f} ({100 * low:.0f}–{100 * high:.0f})",
            _said(late, 2),
            _said(dear, 0),
            _said([each.clearance for each in found], 2),
            _said([100 * each.beside for each in found], 1),
            _said([each.aside for each in found], 1),
            _said([each.turns for each in found], 1),
        ]
        lines.append(f"| {' | '.join(told)} |")
    lines += [
        "",
        "| preference | what it should change | " + " | ".join(map(_named, _families(cells))) + " |",
    ]
    lines.append("| --- | --- |" + " --- |" * len(_families(cells)))
    for wish, (name, side, measure) in INTENDED.items():
        told = []
        for family in _families(cells):
            more, half = effect(cells[family, WEIGHED, wish], cells[family, WEIGHED, BALANCED], measure)
            sure = "**" if side * more > half else ""
            told.append(f"{sure}{more:+.2f}{sure} ± {half:.2f}")
        lines.append(f"| {wish} | {name} ({'more' if side > 0 else 'fewer'}) | {' | '.join(told)} |")
    return "\n".join(lines)


def _families(cells: Cells) -> list[Layout | None]:
    return list(dict.fromkeys(family for family, _, _ in cells))


def _named(family: Layout | None) -> str:
    return family or "scattered"


def _said(values: Sequence[float], digits: int) -> str:
    if not values:
        return "–"
    middle, half = mean(values)
    return f"{middle:.{digits}f} ± {half:.{digits}f}"


def main(arguments: Sequence[str] = ()) -> None:
    """Drive, and print the tables; `--write` puts them into FAMILIES.md."""
    parser = argparse.ArgumentParser(prog="python -m bench.families")
    parser.add_argument("--seeds", type=int, default=40)
    parser.add_argument("--family", choices=[_named(family) for family in FAMILIES])
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args(arguments)
    families = [family for family in FAMILIES if asked.family in (None, _named(family))]
    began = time.perf_counter()
    cells = driven(families, asked.seeds, asked.workers)
    told = tables(cells)
    print(told)
    print(f"\n{asked.seeds} roads a cell, in {time.perf_counter() - began:.0f} s")
    if asked.write:
        page = Path(__file__).with_name("FAMILIES.md")
        head = page.read_text(encoding="utf-8").partition("<!-- tables -->")[0]
        counted = f"{asked.seeds} roads (seeds 0 to {asked.seeds - 1}) in each cell."
        page.write_text(f"{head}<!-- tables -->\n\n{counted}\n\n{told}\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
