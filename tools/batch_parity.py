"""One world by itself and the same world in a batch: the same digest every tick.

    python -m tools.batch_parity --worlds 10000 --ticks 200

draws that many configurations of mixed sizes and settings and compares them all.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from sim.batch import Batch
from sim.config import Config, ConfigError
from sim.generation import GenerationError
from sim.metrics import Metrics
from sim.state import SimState
from sim.transition import step

LANES_OF_A_SIZE = 10


@dataclass(frozen=True)
class Difference:
    """Where the two engines part."""

    config: Config
    tick: int
    what: str


def mixed_configs(seed: int, count: int) -> Iterator[list[Config]]:
    """Groups of configurations of one road size each, `count` in all; every third has the default size.

    Within a group the rules differ from lane to lane; in every fourth all lanes have the default ones.
    """
    draw = random.Random(seed)
    while count > 0:
        usual = draw.random() < 1 / 3
        furthest = 512 if draw.random() < 1 / 20 else 60
        columns, rows = (8, 30) if usual else (draw.randint(3, 64), draw.randint(4, furthest))
        default_rules = draw.random() < 1 / 4
        group: list[Config] = []
        while len(group) < min(LANES_OF_A_SIZE, count):
            most = columns * rows // 6
            try:
                config = Config(
                    columns=columns,
                    rows=rows,
                    planner="priority",
                    seed=draw.randrange(2**53),
                    spawn_probability=draw.random(),
                    pothole_probability=draw.random() / 2,
                    vehicles=draw.choice([None, None, draw.randint(0, most)]),
                    potholes=draw.choice([None, None, draw.randint(0, most)]),
                    barriers=draw.choice([0, draw.randint(0, rows)]),
                    pedestrians=draw.choice([0, 0, draw.randint(0, rows)]),
                    courtesy=0.0 if default_rules else draw.choice([0.0, 0.0, 0.5, 1.0]),
                    attentive=1.0 if default_rules else draw.choice([0.0, 0.5, 1.0]),
                    collision="swept" if default_rules else draw.choice(["swept", "cell"]),
                    repetition=default_rules or draw.random() < 2 / 3,
                    solvable=draw.random() < 0.2,
                    reset_delay_s=draw.choice([0.0, 0.5, 2.0, 3.3]),
                )
            except ConfigError:
                continue
            group.append(config)
        count -= len(group)
        yield group


def difference(
    configs: list[Config], ticks: int, planner: Literal["priority", "rules"] = "priority"
) -> Difference | None:
    """The first thing that is not the same in both engines; None if all is."""
    configs = [config.with_parts(planner=planner) for config in configs if _has_a_road(config)]
    if not configs:
        return None
    batch, runs = Batch(configs), [SimState.start(config) for config in configs]
    for tick in range(ticks + 1):
        for lane, run in enumerate(runs):
            if batch.digest(lane) != run.world.digest():
                return Difference(run.config, tick, "state")
        if tick < ticks:
            batch.run(1, planner)
            runs = [step(run).state for run in runs]
    totals = batch.totals()
    for lane, run in enumerate(runs):
        if any(getattr(run.metrics, name) != getattr(totals, name)[lane] for name in COUNTED):
            return Difference(run.config, ticks, "metrics")
    return None


def _has_a_road(config: Config) -> bool:
    """Whether a road can be drawn; both engines must say the same."""
    try:
        SimState.start(config)
    except GenerationError:
        try:
            Batch([config])
        except GenerationError:
            return False
        raise AssertionError(f"only one engine finds a road for {config}") from None
    return True


COUNTED = ("forward", "lateral", "diagonal", "stay", "successes", "crashes", "stuck")
assert all(hasattr(Metrics(), name) for name in COUNTED)


def main() -> int:
    """Compare as many worlds as are asked for, telling how far it is."""
    parser = argparse.ArgumentParser(prog="tools.batch_parity")
    parser.add_argument("--worlds", type=int, default=10_000)
    parser.add_argument("--ticks", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--planner", choices=("priority", "rules"), default="priority")
    options = parser.parse_args()
    done, differing = 0, 0
    for configs in mixed_configs(options.seed, options.worlds):
        found = difference(configs, options.ticks, options.planner)
        done += len(configs)
        if found is not None:
            differing += 1
            print(f"\n{found}")
        if done % 500 < len(configs):
            print(f"\r{done} of {options.worlds} worlds, {differing} groups differ", end="", flush=True)
    print(f"\n{done} worlds x {options.ticks} ticks: {differing} groups with a difference")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
