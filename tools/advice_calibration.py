"""Is "97 % sure" right in 97 of 100 cases? Advice on random questions against what then happens.

python -m tools.advice_calibration [--questions 20000] [--each 1] [--seed 1] [--build-up 0.2]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim.hazard_advice import Advice, Choice, advise
from sim.hazard_advice.parameters import FRICTION
from sim.types import PLACEABLE, Kind
from tests.support.slow_motion import Case, unharmed

BINS = 10
AIM = 0.02


@dataclass(frozen=True, slots=True)
class Row:
    """Answers of about the same confidence."""

    least: float
    count: int
    stated: float
    true: float


def questions(count: int, seed: int) -> list[Advice]:
    """Advice on random questions, of every hazard and weather, mostly where it is not obvious what to do."""
    draw = np.random.default_rng(seed)
    kinds, weathers = (*PLACEABLE, Kind.AV), tuple(FRICTION)
    found = []
    for _ in range(count):
        weather = weathers[draw.integers(len(weathers))]
        speed_kmh = float(np.exp(draw.uniform(np.log(5), np.log(150))))
        speed = speed_kmh / 3.6
        stopping = speed * 1.0 + speed**2 / (2 * FRICTION[weather].middle * 9.81)
        distance = min(1000.0, max(0.5, stopping * float(draw.uniform(0.05, 2.5))))
        found.append(advise(kinds[draw.integers(len(kinds))], distance, speed_kmh, weather))
    return found


def outcomes(
    advised: Sequence[Advice], seed: int, each: int = 1, build_up_s: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Stated confidence and whether it came true, for `each` drivers of every question."""
    cases = [
        Case(advice.hazard, advice.distance_m, advice.speed_kmh, advice.weather, advice.choice)
        for advice in advised
        for _ in range(each)
    ]
    stated = np.repeat([advice.confidence for advice in advised], each)
    return stated, unharmed(cases, seed, build_up_s)


def table(stated: np.ndarray, true: np.ndarray) -> list[Row]:
    """Answers by their confidence, in bins of equal width."""
    which = np.minimum((stated * BINS).astype(int), BINS - 1)
    return [
        Row(number / BINS, int(there.sum()), float(stated[there].mean()), float(true[there].mean()))
        for number in range(BINS)
        if (there := which == number).any()
    ]


def calibration_error(rows: Sequence[Row]) -> float:
    """Expected calibration error (Naeini et al., 2015; Guo et al., 2017): mean gap, weighted by answers."""
    whole = sum(row.count for row in rows)
    return sum(row.count * abs(row.stated - row.true) for row in rows) / whole


def main() -> int:
    """Print the table and the error."""
    parser = argparse.ArgumentParser(prog="tools.advice_calibration")
    parser.add_argument("--questions", type=int, default=20_000)
    parser.add_argument("--each", type=int, default=1, help="drivers for every question")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build-up", type=float, default=0.0, help="seconds brakes take to full force")
    options = parser.parse_args()
    advised = questions(options.questions, options.seed)
    stated, true = outcomes(advised, options.seed + 1, options.each, options.build_up)
    rows = table(stated, true)
    print(f"{'confidence':>12} {'answers':>8} {'stated':>8} {'true':>8} {'gap':>8}")
    for row in rows:
        span = f"{row.least:.0%}–{row.least + 1 / BINS:.0%}"
        print(f"{span:>12} {row.count:8} {row.stated:8.2%} {row.true:8.2%} {row.true - row.stated:+8.2%}")
    error = calibration_error(rows)
    print(f"{len(stated)} cases: expected calibration error {error:.4f} (aim: at most {AIM})")
    chosen = np.repeat([advice.choice for advice in advised], options.each)
    for choice in Choice:
        of_it = chosen == choice
        if of_it.any():
            part = calibration_error(table(stated[of_it], true[of_it]))
            print(f"  {choice}: {int(of_it.sum())} cases, {part:.4f}")
    return 0 if error <= AIM else 1


if __name__ == "__main__":
    sys.exit(main())
