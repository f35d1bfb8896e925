"""The world beside its slow twin, tick by tick, on random roads.

    python -m tools.twin_run --ticks 100000

drives both over as many ticks, and fails at the first one in which they differ.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from dataclasses import replace
from random import Random

from sim.actions import Add, Where
from sim.config import Config
from sim.rules.yielding import attentive_movers, movers_beside, yielding_movers
from sim.session.edits import apply
from sim.state import SimState
from sim.transition import step
from sim.types import Cell, Outcome
from sim.world.grid import Board, bits
from tests.support import twin


def cells(state: SimState, board: Board) -> set[Cell]:
    """The cells of a board."""
    return {state.world.road.cell(cell) for cell in bits(board)}


def courteous(state: SimState) -> set[Cell]:
    """The draw the twin cannot make: which movers give way this tick."""
    return cells(state, yielding_movers(state.world, state.config, movers_beside(state.world)))


def braking(state: SimState) -> set[Cell]:
    """The other one: which movers brake for the vehicle if it stays in this tick."""
    return cells(state, attentive_movers(state.world, state.config, movers_beside(state.world)))


def drive_both(state: SimState, ticks: int) -> Counter[str]:
    """Advance both until the episode ends, comparing everything there is to compare.

    Returns how many ticks there were (`ticks`) and what happened in them.
    """
    slow, memory, counted = twin.position(state.world), twin.Memory(), Counter[str]()
    config = state.config
    remembers = config.repetition and config.courtesy == 0 and config.attentive in (0, 1)
    for _ in range(ticks):
        gives_way, brakes, swept = courteous(state), braking(state), config.collision == "swept"
        before, moved = slow, twin.moved_bodies(slow, gives_way)
        move, slow = twin.step(before, None, gives_way, brakes, swept=swept)
        repeats = slow.outcome is Outcome.RUNNING and remembers and memory.noticed(slow)
        if repeats:
            slow = replace(slow, outcome=Outcome.STUCK)
        tick = step(state)
        state = tick.state
        assert tick.decision is not None
        assert tick.decision.move is move, (state, move)
        for option in tick.decision.options:
            free = twin.outlook(before, option.move, moved, brakes, swept=swept)[2]
            assert free is (not option.reason.blocks), (state, option)
        assert twin.position(state.world) == slow, (state, slow)
        counted["ticks"] += 1
        counted["braked"] += slow.bodies != moved
        if slow.outcome is not Outcome.RUNNING:
            counted["repetition" if repeats else slow.outcome.value] += 1
            break
    return counted


def random_run(random: Random) -> SimState:
    """A run on a road of any size and density, by any of the rules, some movers held by potholes."""
    columns, rows = random.randint(3, 12), random.randint(4, 40)
    room = columns * (rows - 2)
    density = random.choice((0.0, 0.05, 0.1, 0.2, 0.4, 0.7))

    def some(share: float) -> int:
        return random.randint(0, int(room * density * share))

    config = Config(
        columns=columns,
        rows=rows,
        planner="priority",
        seed=random.randrange(2**40),
        vehicles=random.choice((None, some(0.5))) if room - 2 * rows > room * density else some(0.5),
        potholes=some(0.3),
        barriers=some(0.1),
        pedestrians=some(0.3),
        courtesy=random.choice((0.0, 0.0, 0.5, 1.0)),
        attentive=random.choice((1.0, 1.0, 0.5, 0.0)),
        collision=random.choice(("swept", "swept", "cell")),
        repetition=random.random() < 0.8,
    )
    state = SimState.start(config)
    for thing in list(state.world.things()):
        if thing.kind.moves and random.random() < 0.1:
            state = apply(state, Add(kind="pothole", count=1, where=Where(cell=thing.cell))).state
    return state


def main() -> int:
    """Drive both for as many ticks as are asked for."""
    parser = argparse.ArgumentParser(prog="tools.twin_run")
    parser.add_argument("--ticks", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    random, counted = Random(f"twin run {options.seed}"), Counter[str]()
    while counted["ticks"] < options.ticks:
        counted += drive_both(random_run(random), 420)
        counted["roads"] += 1
    told = ", ".join(f"{count} {what}" for what, count in sorted(counted.items()))
    print(f"no difference: {told}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
