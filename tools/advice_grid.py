"""Advice on a grid of hazards, distances, speeds and weathers against outcomes and published figures.

    python -m tools.advice_grid [--each 60] [--seed 1] [--neighbours 2000] [--cases]

Prints whether the stated chances come true (Monte Carlo, `tests.support.slow_motion`), whether the advice is
anywhere gentler or surer nearer or faster, and how far published figures agree. `--cases` lists every case.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import sqrt
from typing import Final

import numpy as np

from service.narration.advice import firmness
from sim.actions import Weather
from sim.hazard_advice import Advice, Figures, advise, physics
from sim.hazard_advice.parameters import FRICTION, GRAVITY, REACTION
from sim.types import PLACEABLE
from tests.support.slow_motion import Case, unharmed
from tools.published_stopping import (
    GREEN_BOOK,
    HIGHWAY_CODE,
    ROSEN_SANDER_RATIOS,
    TEFFT_DEATH,
    rss_distance,
)

DISTANCES_M: Final = (2, 5, 10, 15, 20, 30, 40, 60, 90, 140)
SPEEDS_KMH: Final = (10, 20, 30, 40, 50, 60, 80, 100, 130)
TOLERANCE: Final = 0.01
"""What the stated chance may be off beside chance itself: it is stated in whole hundredths."""


@dataclass(frozen=True, slots=True)
class Pair:
    """A case and one that is nearer, faster or both."""

    case: Advice
    worse: Advice

    @property
    def surer(self) -> bool:
        """Whether more is promised where there is less room or more speed."""
        return self.worse.confidence > self.case.confidence

    @property
    def gentler(self) -> bool:
        """Whether less is asked for there."""
        return firmness(self.worse) < firmness(self.case)


def grid() -> list[Advice]:
    """Advice on every combination."""
    cells = product(PLACEABLE, FRICTION, DISTANCES_M, SPEEDS_KMH)
    return [advise(hazard, metres, kmh, weather) for hazard, weather, metres, kmh in cells]


def grid_pairs(cases: Iterable[Advice]) -> Iterator[Pair]:
    """Every case with the next nearer one, the next faster one and the one that is both."""
    found = {(case.hazard, case.weather, case.distance_m, case.speed_kmh): case for case in cases}
    for (hazard, weather, metres, kmh), case in found.items():
        near = DISTANCES_M[max(0, DISTANCES_M.index(int(metres)) - 1)]
        fast = SPEEDS_KMH[min(len(SPEEDS_KMH) - 1, SPEEDS_KMH.index(int(kmh)) + 1)]
        for where, speed in {(near, kmh), (metres, fast), (near, fast)} - {(metres, kmh)}:
            yield Pair(case, found[hazard, weather, where, speed])


def random_pairs(count: int, seed: int) -> Iterator[Pair]:
    """Pairs from anywhere, most of them close to where the advice changes."""
    draw = np.random.default_rng(seed)
    weathers: tuple[Weather, ...] = tuple(FRICTION)
    for _ in range(count):
        hazard, weather = PLACEABLE[draw.integers(len(PLACEABLE))], weathers[draw.integers(len(weathers))]
        kmh = float(draw.uniform(5, 150))
        stops = physics.stopping_distance(kmh / 3.6, REACTION.middle, FRICTION[weather].middle)
        metres = min(900.0, 0.5 + stops * float(draw.uniform(0.03, 2.5)))
        nearer, faster = draw.choice([1.0, 1.02, 1.1, 1.4], size=2)
        yield Pair(
            advise(hazard, metres, kmh, weather), advise(hazard, metres / nearer, kmh * faster, weather)
        )


def came_true(cases: Sequence[Advice], each: int, seed: int) -> np.ndarray:
    """Share of `each` drivers per case that come away unharmed by following the advice."""
    played = [
        Case(case.hazard, case.distance_m, case.speed_kmh, case.weather, case.choice)
        for case in cases
        for _ in range(each)
    ]
    return unharmed(played, seed).reshape(len(cases), each).mean(axis=1)


def outside(case: Advice, share: float, each: int) -> bool:
    """Whether the share seen is beyond four standard errors of the chance that is stated."""
    spread = sqrt(max(case.chosen.chance * (1 - case.chosen.chance), 1 / each) / each)
    return abs(share - case.confidence) > 4 * spread + TOLERANCE


def published() -> Iterator[str]:
    """One line per published figure or curve."""
    gaps = [
        abs(physics.stopping_distance(mph * 0.44704, 0.67, 0.67) - sum(parts))
        for mph, parts in HIGHWAY_CODE.items()
    ]
    yield f"Highway Code, rule 126, at its own 0.67 s and 0.67 g: within {max(gaps):.1f} m"
    for mph, parts in HIGHWAY_CODE.items():
        yield f"  {mph} mph: {sum(parts)} m; {_stopping(mph * 1.609344)}"
    gaps = [
        metres - physics.stopping_distance(kmh / 3.6, 2.5, 3.4 / GRAVITY)
        for kmh, metres in GREEN_BOOK.items()
    ]
    yield f"AASHTO Green Book, at its 2.5 s and 3.4 m/s²: rounds up by {min(gaps):.1f} to {max(gaps):.1f} m"
    for kmh in (50, 80, 100, 130):
        yield f"  {kmh} km/h: {GREEN_BOOK[kmh]} m; {_stopping(kmh)}"
    gaps = [
        abs(
            rss_distance(kmh / 3.6, REACTION.middle, 0.0, FRICTION["clear"].middle * GRAVITY)
            - physics.stopping_distance(kmh / 3.6, REACTION.middle, FRICTION["clear"].middle)
        )
        for kmh in range(5, 151)
    ]
    yield f"RSS before something that stands, without speeding up, at our medians: within {max(gaps):.2g} m"
    for weather in FRICTION:
        ratios = [
            rss_distance(kmh / 3.6) / _figures(kmh, weather).stopping_most_m for kmh in (30, 50, 80, 100, 130)
        ]
        told = ", ".join(f"{ratio:.2f}" for ratio in ratios)
        yield f"  RSS with 1 s, 3.5 and 4 m/s² over our 95 % distance, {weather}, 30 to 130 km/h: {told}"
    yield "Risk of death on foot, ours (Rosén & Sander 2009) beside Tefft 2013:"
    for kmh, risk in TEFFT_DEATH.items():
        yield f"  {kmh} km/h: {float(physics.death_risk(kmh)):.0%} beside {risk:.0%}"
    for (fast, slow), least in ROSEN_SANDER_RATIOS.items():
        ratio = float(physics.death_risk(float(fast)) / physics.death_risk(float(slow)))
        yield f"  {fast} over {slow} km/h: {ratio:.1f} (published: more than {least:g})"


def _figures(kmh: float, weather: Weather) -> Figures:
    return advise(PLACEABLE[0], 50, kmh, weather).figures


def _stopping(kmh: float) -> str:
    """The distances in which half of all drivers and 95 of 100 stop, on a dry road."""
    figures = advise(PLACEABLE[0], 50, kmh).figures
    return f"half stop within {figures.stopping_m:.0f} m, 95 of 100 within {figures.stopping_most_m:.0f} m"


def main() -> int:
    """Prints the comparisons; fails where a chance does not come true or the advice is not monotone."""
    parser = argparse.ArgumentParser(prog="tools.advice_grid")
    parser.add_argument("--each", type=int, default=60, help="drivers for every case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--neighbours", type=int, default=2000, help="random pairs")
    parser.add_argument("--cases", action="store_true", help="list every case")
    options = parser.parse_args()
    cases = grid()
    shares = came_true(cases, options.each, options.seed)
    stated = np.array([case.confidence for case in cases])
    off = [case for case, share in zip(cases, shares, strict=True) if outside(case, share, options.each)]
    if options.cases:
        for case, share in zip(cases, shares, strict=True):
            print(
                f"{case.hazard:>10} {case.weather:>5} {case.distance_m:>4} m {case.speed_kmh:>3} km/h  "
                f"{case.choice:<15} {case.confidence:4.0%} stated, {share:4.0%} seen"
            )
    print(f"{len(cases)} cases, {options.each} drivers each: stated {stated.mean():.4f} in the mean, seen "
          f"{shares.mean():.4f}; {len(off)} cases off by more than chance")  # fmt: skip
    pairs = list(grid_pairs(cases))
    bad = [pair for pair in pairs if pair.surer or pair.gentler]
    print(f"{len(pairs)} neighbours on the grid: {len(bad)} surer or gentler where nearer or faster")
    drawn = list(random_pairs(options.neighbours, options.seed))
    worse = [pair for pair in drawn if pair.surer or pair.gentler]
    print(f"{len(drawn)} random neighbours: {len(worse)}")
    print("\n".join(published()))
    return 1 if off or bad or worse else 0


if __name__ == "__main__":
    sys.exit(main())
