"""How many failures a search finds in 10,000 worlds, drawn at random and directed.

    python -m tools.failures_found --worlds 1000 --planners priority rules blind-in-crowds

A failure counts where a search proves that a way leads to the goal. `blind-in-crowds` is the broken planner
of the tests. Both searches draw from the same space, with the same seeds; nothing is shrunk.
"""

from __future__ import annotations

import argparse
import time

from sim.falsify import Falsification
from sim.falsify.stages import SearchPiece, pieces, run_piece, unpack
from sim.statistics import wilson
from tests.support.broken_planner import registered


def failures(spec: Falsification) -> int:
    """Failures among the worlds of a search."""
    parts: dict[str, bytes] = {}
    while left := [piece for piece in pieces(spec, parts) if isinstance(piece, SearchPiece)]:
        for piece in left:
            parts[piece.key] = run_piece(spec.to_json(), piece, lambda: False)
    return sum(each.finding.failed for body in parts.values() for each in unpack(body))


def main() -> None:
    """Print a line for each planner and way to search."""
    parser = argparse.ArgumentParser(prog="tools.failures_found")
    parser.add_argument("--worlds", type=int, default=1_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--planners", nargs="*", default=["priority", registered()])
    options = parser.parse_args()
    print(f"{'planner':<18}{'search':<10}{'worlds':>8}{'failures':>10}{'per 10,000':>12}  95 % interval    s")
    for planner in options.planners:
        for directed in (False, True):
            spec = Falsification(planner=planner, worlds=options.worlds, seed=options.seed, directed=directed)
            began = time.perf_counter()
            found = failures(spec)
            taken = time.perf_counter() - began
            low, high = (10_000 * each for each in wilson(found, spec.worlds))
            name = "directed" if directed else "random"
            row = (
                f"{planner:<18}{name:<10}{spec.worlds:>8,}{found:>10,}{10_000 * found / spec.worlds:>12,.0f}"
            )
            print(f"{row}  {low:>5,.0f} to {high:<6,.0f}{taken:>6.0f}", flush=True)


if __name__ == "__main__":
    main()
