"""Whether confidence holds: in what share of the cases with "90 %" does the vehicle arrive?

`python -m tools.confidence_calibration [worlds]` asks in random worlds with courtesy between 0 and 1,
then runs each on under its own seed, which the answer does not know, and compares. The expected
calibration error is the mean distance between what was stated and what came of it, bin by bin, weighted by
cases (Naeini, Cooper & Hauskrecht, "Obtaining well calibrated probabilities using Bayesian binning", 2015).
"""

from __future__ import annotations

import random
import sys
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from sim.config import Config
from sim.explain.confidence import Confidence, Method, confidence
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

PLANNERS = ("priority",) * 8 + ("bfs", "astar")


@dataclass(frozen=True, slots=True)
class Case:
    """What was stated, and what came of it."""

    stated: float
    arrived: bool
    found: Confidence


def cases(count: int, seed: int = 0) -> Iterator[Case]:
    """Answers in random worlds at random moments, each with what really came."""
    draw = random.Random(seed)
    while count:
        timeline = Timeline(drawn_config(draw))
        for _ in range(draw.randrange(timeline.config.rows)):
            timeline.advance()
        if timeline.state.world.outcome is Outcome.RUNNING:
            found = confidence(timeline)
            yield Case(found.stated, end_of(timeline.state) is Outcome.SUCCESS, found)
            count -= 1


def drawn_config(draw: random.Random) -> Config:
    """A road from empty to crowded, with movers that may or may not give way."""
    columns, rows = draw.choice([3, 4, 8, 11]), draw.choice([8, 30])
    cells = columns * (rows - 2)
    return Config(
        seed=draw.randrange(2**32),
        columns=columns,
        rows=rows,
        potholes=draw.choice([None, 0, cells // 10, cells // 6]),
        vehicles=draw.choice([None, cells // 8, cells // 5, cells // 4]),
        pedestrians=draw.choice([0, 2]),
        barriers=draw.choice([0, 2]),
        courtesy=draw.uniform(0.02, 0.98),
        planner=draw.choice(PLANNERS),
    )


def end_of(state: SimState) -> Outcome:
    """How the episode ends when it is run on."""
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state.world.outcome


def bins(found: Sequence[Case]) -> dict[str, list[Case]]:
    """Cases by what was stated: all, none, and tenths between."""
    binned: dict[str, list[Case]] = defaultdict(list)
    for case in sorted(found, key=lambda case: case.stated):
        tenth = min(9, int(case.stated * 10))
        whole = {0.0: "0 % exactly", 1.0: "100 % exactly"}
        binned[whole.get(case.stated, f"{10 * tenth} to {10 * tenth + 10} %")].append(case)
    return binned


def error(found: Sequence[Case]) -> float:
    """The expected calibration error."""
    return sum(abs(mean_stated(each) - share(each)) * len(each) for each in bins(found).values()) / len(found)


def mean_stated(found: Sequence[Case]) -> float:
    """The mean of what was stated."""
    return sum(case.stated for case in found) / len(found)


def share(found: Sequence[Case]) -> float:
    """In what share of the cases it arrived."""
    return sum(case.arrived for case in found) / len(found)


def main(count: int) -> None:
    """Print the table."""
    found = list(cases(count))
    print(f"{'stated':<16}{'cases':>7}{'mean stated':>14}{'arrived':>10}")
    for name, each in bins(found).items():
        print(f"{name:<16}{len(each):>7}{100 * mean_stated(each):>12.1f} %{100 * share(each):>8.1f} %")
    open_cases = [case for case in found if 0.0 < case.stated < 1.0]
    print(f"expected calibration error {error(found):.4f}; of the {len(open_cases)} cases in which it was")
    print(f"neither 0 nor 100 %: {error(open_cases):.4f}; by method:")
    for method in Method:
        print(f"  {method:<12} {sum(case.found.method is method for case in found)}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 3000)
