"""Is the change that a why-not tells the smallest? On small roads all changes up to three edits are tried.

python -m tools.smallest_changes --decisions 2000

An edit takes a thing away, blocks a cell beside the vehicle, or says another wish. Each is made by the
actions of a person, and the decision is the one the run takes then.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections import Counter
from collections.abc import Iterator

from sim.config import Config
from sim.explain import why_not
from sim.explain.effort import Effort
from sim.search.compiled_costs import load_compiled_costs
from sim.session.timeline import Timeline
from sim.types import Move, Outcome
from tests.support.sentence_judge import changes_reaching

PLANNERS = ("priority", "rules", "bfs", "dijkstra", "astar")
MOST_EDITS = 3


def moments(count: int, seed: int, planner: str) -> Iterator[Timeline]:
    """Timelines of small roads that have just taken a decision."""
    draw, found = random.Random(f"{planner} {seed}"), 0
    while found < count:
        config = Config(
            seed=draw.randrange(2**32),
            columns=draw.choice([3, 4]),
            rows=draw.choice([5, 6]),
            potholes=draw.choice([1, 2, 3]),
            vehicles=draw.choice([1, 2, 4]),
            pedestrians=draw.choice([0, 1]),
            barriers=draw.choice([0, 1]),
            planner=planner,
        )
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, 5)):
            timeline.advance()
        if timeline.at(timeline.tick - 1).world.outcome is Outcome.RUNNING:
            found += 1
            yield timeline


def compared(timeline: Timeline, foil: Move, effort: Effort) -> tuple[str, str] | None:
    """How the change that is told compares with the smallest there is, and both; None without a question."""
    state, made = timeline.at(timeline.tick - 1), timeline.decision(timeline.tick - 1)
    assert made is not None
    if made.option(foil).cell is None:
        return None
    explanation = why_not(timeline, foil, effort=effort)
    told = [flip.change for flip in explanation.counterfactuals if flip.move is foil]
    size = len(told[0]) if told else None
    smallest = next(changes_reaching(state, foil, MOST_EDITS), None)
    least = None if smallest is None else len(smallest)
    where = f"{state.config.planner} seed {state.config.seed} tick {state.world.tick} {foil}"
    both = f"{where}: {told} beside {smallest}"
    if size == least:
        return "equal", both
    if least is None:
        return ("larger than three, and none of three" if size and size > MOST_EDITS else "WRONG"), both
    return ("MISSED" if size is None else "NOT SMALLEST" if size > least else "WRONG"), both


def main() -> int:
    """Print the figures; 1 where a change is not the smallest."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--decisions", type=int, default=2_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--show", type=int, default=6)
    parser.add_argument("--effort", choices=[*Effort], default=Effort.USUAL)
    options = parser.parse_args()
    load_compiled_costs(compile_now=True)
    draw, figures, shown = random.Random(options.seed), Counter[tuple[str, str]](), 0
    for planner in PLANNERS:
        for timeline in moments(options.decisions // len(PLANNERS), options.seed, planner):
            made = timeline.decision(timeline.tick - 1)
            foil = draw.choice([move for move in Move if made is None or move is not made.move])
            found = compared(timeline, foil, Effort(options.effort))
            if found is not None:
                figures[planner, found[0]] += 1
                if found[0].isupper() and shown < options.show:
                    shown += 1
                    print(*found, flush=True)
    for (planner, kind), count in sorted(figures.items()):
        print(f"{planner:<10}{kind:<40}{count:>7}")
    return int(any(kind.isupper() for _, kind in figures))


if __name__ == "__main__":
    sys.exit(main())
