"""What other moves would have led to, against a person making them.

python -m tools.check_alternatives --cases 10000
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

from sim.explain import why_not
from sim.types import Move, Outcome
from tests.support.intervention_judge import played
from tests.support.moments import moments

SHARES = {"priority": 0.90, "bfs": 0.05, "dijkstra": 0.03, "astar": 0.02}
BATCH = 100


def checked(job: tuple[str, int, int]) -> Counter[str]:
    """The counts of some moments of a planner."""
    planner, seed, count = job
    draw, counts = random.Random(seed), Counter[str]()
    for timeline in moments(count, seed=seed, planner=planner):
        state, made = timeline.at(timeline.tick - 1), timeline.decision(timeline.tick - 1)
        assert made is not None
        explanation = why_not(timeline, draw.choice([move for move in Move if move is not made.move]))
        assert explanation.foil is not None
        counts["cases"] += 1
        counts[planner] += 1
        stakes = explanation.stakes
        if stakes is None:
            counts["off the road"] += explanation.decision.option(explanation.foil).cell is None
            continue
        really = played(state, explanation.foil)
        if really is None:  # a person's move into what is known to be blocked is held back
            counts["blocked, a crash"] += stakes.would is not None and stakes.would.outcome is Outcome.CRASH
        else:
            counts["played"] += 1
            counts["as stated"] += (
                stakes.would is not None and (stakes.would.outcome, stakes.would.ticks) == really
            )
    return counts


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=10_000)
    cases = parser.parse_args().cases
    jobs = [
        (planner, seed, min(BATCH, round(cases * share) - done))
        for planner, share in SHARES.items()
        for seed, done in enumerate(range(0, round(cases * share), BATCH))
    ]
    with ProcessPoolExecutor(2) as pool:
        counts = sum(pool.map(checked, jobs), Counter())
    for name, count in counts.items():
        print(f"{name:<18}{count:>8}")


if __name__ == "__main__":
    main()
