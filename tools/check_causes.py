"""Every claim of very many explanations, checked by forks.

python -m tools.check_causes --decisions 100000
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

from sim.explain import why
from tests.support.intervention_judge import wrong_claims
from tests.support.moments import moments

SHARES = {"priority": 0.94, "bfs": 0.03, "dijkstra": 0.02, "astar": 0.01}
"""How many of the decisions are whose: planners that weigh costs are run hundreds of times for one answer."""
BATCH = 100


def checked(job: tuple[str, int, int]) -> tuple[Counter[str], list[str]]:
    """The counts and the wrong claims of some moments of a planner."""
    planner, seed, count = job
    counts: Counter[str] = Counter()
    wrong = []
    for at, timeline in enumerate(moments(count, seed=seed, planner=planner)):
        explanation = why(timeline)
        counts["decisions"] += 1
        counts[planner] += 1
        counts["causes"] += len(explanation.causes)
        counts["necessary"] += sum(cause.necessary for cause in explanation.causes)
        counts["each enough"] += sum(cause.each_enough for cause in explanation.causes)
        counts["wishes"] += sum(":" in cause.id for cause in explanation.causes)
        counts["sufficient"] += explanation.verified.sufficient is True
        counts["minimal"] += explanation.verified.minimal is True
        parts = at % 10 == 0
        counts["parts tried"] += parts
        claims = wrong_claims(explanation, parts=parts)
        wrong += [f"{planner} seed {seed} number {at}: {claim}" for claim in claims]
    return counts, wrong


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--decisions", type=int, default=100_000)
    decisions = parser.parse_args().decisions
    jobs = [
        (planner, seed, min(BATCH, max(1, round(decisions * share)) - done))
        for planner, share in SHARES.items()
        for seed, done in enumerate(range(0, max(1, round(decisions * share)), BATCH))
    ]
    counts: Counter[str] = Counter()
    wrong: list[str] = []
    with ProcessPoolExecutor(2) as pool:
        for at, (found, claims) in enumerate(pool.map(checked, jobs), 1):
            counts += found
            wrong += claims
            if sys.stderr.isatty() or at == len(jobs):
                print(
                    f"\r{counts['decisions']} decisions, {len(wrong)} wrong claims", end="", file=sys.stderr
                )
    print(file=sys.stderr)
    for name, count in counts.items():
        print(f"{name:<14}{count:>9}")
    print(f"{'wrong claims':<14}{len(wrong):>9}")
    print("\n".join(wrong[:20]))


if __name__ == "__main__":
    main()
