"""Compares planners on the same roads: python examples/compare_planners.py [ROADS] [LAYOUT]"""

import sys

from sim.config import Config
from sim.generation import GenerationError
from sim.state import SimState
from sim.statistics import mean, wilson
from sim.transition import step
from sim.types import Outcome

PLANNERS = ("rules", "priority", "astar", "bfs")


def drive(config: Config) -> SimState:
    """Drives one episode to its end."""
    state = SimState.start(config)
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state


def main() -> None:
    """Prints a row for each planner: how often it arrives and crashes, and how many ticks it takes."""
    roads = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    layout = sys.argv[2] if len(sys.argv) > 2 else "maze"
    print(f"{roads} roads, layout {layout}; shares with 95 % confidence intervals")
    print(f"{'planner':10} {'arrived':>24} {'crashed':>8} {'ticks':>12}")
    for planner in PLANNERS:
        ends = [drive(Config(seed=seed, layout=layout, planner=planner)).world for seed in range(roads)]
        arrived = [world for world in ends if world.outcome is Outcome.SUCCESS]
        crashed = sum(world.outcome is Outcome.CRASH for world in ends)
        low, high = wilson(len(arrived), roads)
        middle, half = mean([world.tick for world in arrived]) if arrived else (0.0, 0.0)
        share = f"{len(arrived) / roads:.0%} ({low:.0%} … {high:.0%})"
        print(f"{planner:10} {share:>24} {crashed / roads:>8.0%} {middle:>6.1f} ± {half:.1f}")


if __name__ == "__main__":
    try:
        main()
    except GenerationError as error:
        sys.exit(str(error))
