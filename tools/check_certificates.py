"""Every road of many that is said to be blocked, checked by the slow search: no way, opened, minimal.

python -m tools.check_certificates --potholes 60 --worlds 20000
"""

from __future__ import annotations

import argparse
import sys
from itertools import combinations

from sim.batch import Batch
from sim.config import Config
from sim.oracle import Blocked, certify
from sim.state import SimState
from tests.support.slow_search import least_ticks
from tests.support.twin import position


def wrong(config: Config) -> str | None:
    """What is wrong with the certificate of a road that the batch says cannot be driven."""
    state = SimState.start(config)
    found = certify(state)
    if not isinstance(found, Blocked):
        return "said to be drivable"
    if least_ticks(position(state.world)) is not None:
        return "there is a way"
    if least_ticks(position(state.world.without(found.ids))) is None:
        return "it is not opened"
    sizes = range(len(found.ids)) if found.minimal else (len(found.ids) - 1,)
    for part in (part for size in sizes for part in combinations(found.ids, size)):
        if least_ticks(position(state.world.without(part))) is not None:
            return f"{part} would have been enough"
    return None


def main() -> int:
    """Look for blocked roads and check all their certificates."""
    parser = argparse.ArgumentParser(prog="tools.check_certificates")
    parser.add_argument("--potholes", type=int, default=60)
    parser.add_argument("--worlds", type=int, default=20_000)
    options = parser.parse_args()
    configs = [Config(seed=seed, potholes=options.potholes) for seed in range(options.worlds)]
    blocked = [
        config for config, least in zip(configs, Batch(configs).least("bfs"), strict=True) if least < 0
    ]
    failures = 0
    for number, config in enumerate(blocked, 1):
        defect = wrong(config)
        if defect is not None:
            failures += 1
            print(f"\nseed {config.seed}: {defect}")
        print(f"\r{number} of {len(blocked)} blocked roads, {failures} wrong", end="", flush=True)
    print(
        f"\n{len(configs)} roads with {options.potholes} potholes: {len(blocked)} blocked, {failures} wrong"
    )
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
