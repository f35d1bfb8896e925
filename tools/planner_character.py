"""How each planner drives, counted on many roads: the figures behind "how does this planner drive?".

    python -m tools.planner_character --roads 2400 --processes 2 --write

All planners drive the same roads, each for one episode. A road is drawn from its seed; how many potholes, cars
and people are on it, and whether all of them watch out, goes round with the seed. `--write` replaces
`sim/explain/planner_character.json`, which names the command.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import product
from multiprocessing import Pool
from typing import Any, Final

from sim.config import Config
from sim.explain.planner_character import FILE
from sim.oracle.lower_bounds import least_ticks
from sim.planner_names import BUILT_IN
from sim.search.reactive import ImpatientError
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

ROADS: Final = tuple(
    {"potholes": potholes, "vehicles": vehicles, "pedestrians": pedestrians, "attentive": attentive}
    for potholes, vehicles, pedestrians, attentive in product(
        (5, 15, 30, 45), (10, 20, 35), (0, 6), (1.0, 0.9)
    )
)
"""The kinds of road, light to dense, in turn."""
KINDS: Final = {
    Move.FORWARD: "forward",
    Move.LEFT: "sideways",
    Move.RIGHT: "sideways",
    Move.FORWARD_LEFT: "diagonal",
    Move.FORWARD_RIGHT: "diagonal",
    Move.STAY: "stay",
}
STATES: Final = 20_000
"""States searched for the quickest way on a road; where they are not enough, no ticks lost are counted."""
GROUP: Final = 24


@dataclass
class Tally:
    """What came of the drives of one planner."""

    roads: int = 0
    ends: Counter[str] = field(default_factory=Counter)
    moves: Counter[str] = field(default_factory=Counter)
    """of the drives that arrived; one that is stuck makes the same moves for long"""
    arrival_ticks: int = 0
    compared: int = 0
    """arrivals on roads of which the quickest way is known"""
    ticks_above: int = 0
    """ticks that these took more than the quickest way"""

    def add(self, other: Tally) -> None:
        """Count another's drives as well."""
        self.roads += other.roads
        self.ends += other.ends
        self.moves += other.moves
        self.arrival_ticks += other.arrival_ticks
        self.compared += other.compared
        self.ticks_above += other.ticks_above

    def figures(self) -> dict[str, Any]:
        """Counts, and shares and seconds made of them, as the file has them."""
        step_s, moves = Config().step_seconds, self.moves.total()
        return {
            "roads": self.roads,
            "arrived": self.ends[Outcome.SUCCESS],
            "crashed": self.ends[Outcome.CRASH],
            "stuck": self.ends[Outcome.STUCK],
            "moves": {kind: round(self.moves[kind] / moves, 4) for kind in dict.fromkeys(KINDS.values())},
            "arrival_s": round(self.arrival_ticks * step_s / max(1, self.ends[Outcome.SUCCESS]), 2),
            "lost_s": round(self.ticks_above * step_s / max(1, self.compared), 2),
        }


def drive(planner: str, seed: int, fewest: int | None) -> Tally:
    """One drive; `fewest`: ticks of the quickest way, None where it is not known."""
    state = road(seed).with_each_ego(planner=planner)
    tally, moves = Tally(roads=1), Counter[str]()
    while state.world.outcome is Outcome.RUNNING:
        tick = step(state)
        assert tick.decision is not None
        moves[KINDS[tick.decision.move]] += 1
        state = tick.state
    tally.ends[state.world.outcome] += 1
    if state.world.outcome is Outcome.SUCCESS:
        tally.moves, tally.arrival_ticks = moves, state.world.episode_tick
        if fewest is not None:
            tally.compared, tally.ticks_above = 1, state.world.episode_tick - fewest
    return tally


def road(seed: int) -> SimState:
    """The road of a seed."""
    return SimState.start(Config(seed=seed).with_parts(**ROADS[seed % len(ROADS)]))


def drive_all(seeds: Iterable[int]) -> dict[str, Tally]:
    """The drives of every planner on these roads."""
    tallies = {planner: Tally() for planner in BUILT_IN}
    for seed in seeds:
        start = road(seed)
        try:
            fewest = least_ticks(start, STATES) if start.config.certain else None
        except ImpatientError:
            fewest = None
        for planner, tally in tallies.items():
            tally.add(drive(planner, seed, fewest))
    return tallies


def groups(roads: int) -> Iterator[range]:
    """The seeds in groups, one for each piece of work."""
    for first in range(0, roads, GROUP):
        yield range(first, min(roads, first + GROUP))


def main() -> None:
    """Drive, and print or write the figures."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--roads", type=int, default=2400)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    said = parser.parse_args()
    tallies = {planner: Tally() for planner in BUILT_IN}
    with Pool(said.processes) as pool:
        for found in pool.imap_unordered(drive_all, groups(said.roads)):
            for planner, tally in found.items():
                tallies[planner].add(tally)
    figures = {
        "command": f"python -m tools.planner_character --roads {said.roads} --write",
        "roads": said.roads,
        "planners": {planner: tally.figures() for planner, tally in tallies.items()},
    }
    text = json.dumps(figures, indent=2) + "\n"
    print(text)
    if said.write:
        FILE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
