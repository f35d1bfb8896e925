"""Occlusion by ray casting against the slow exact check, on random roads.

    python -m tools.check_occlusion --pairs 100000

A pair is a vehicle and a cell that it looks at.
"""

from __future__ import annotations

import argparse
import random
import sys

from sim.perceive.occlusion import hidden
from sim.types import KINDS, Kind
from sim.world.grid import Road, board_of
from tests.support.slow_occlusion import is_hidden

REACH = 20
KIND_WEIGHTS = {Kind.VEHICLE: 3, Kind.BARRIER: 3, Kind.AV: 1}


def differences(pairs: int, seed: int = 0) -> tuple[int, int, int]:
    """How many pairs were compared, how many of them were hidden, and how many differ."""
    draw, compared, unseen, wrong = random.Random(seed), 0, 0, 0
    while compared < pairs:
        road = Road.of(draw.choice([3, 5, 8, 13]), draw.choice([6, 12, 30]))
        cells = list(range(road.columns * road.rows))
        ego = draw.choice(cells)
        share = draw.choice([0.02, 0.1, 0.3])
        bodies = {
            cell: draw.choices(list(KIND_WEIGHTS), list(KIND_WEIGHTS.values()))[0]
            for cell in cells
            if draw.random() < share
        }
        boards = [
            (kind, board_of([cell for cell, each in bodies.items() if each is kind])) for kind in KIND_WEIGHTS
        ]
        found = hidden(road, ego, REACH, boards)
        row = ego // road.columns
        for cell in cells:
            if not max(0, row - REACH) <= cell // road.columns <= row or cell == ego:
                continue
            there = [(kind, road.cell(each)) for each, kind in bodies.items() if each != ego]
            slow = is_hidden(road.cell(ego), road.cell(cell), there)
            compared += 1
            unseen += slow
            wrong += slow is not bool(found >> cell & 1)
            if compared == pairs:
                break
    return compared, unseen, wrong


def main() -> int:
    """Compare, and print what was found."""
    parser = argparse.ArgumentParser(prog="tools.check_occlusion")
    parser.add_argument("--pairs", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    assert all(KINDS[kind].occludes for kind in KIND_WEIGHTS)
    compared, unseen, wrong = differences(options.pairs, options.seed)
    print(f"{compared} pairs, {unseen} hidden, {wrong} different")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
