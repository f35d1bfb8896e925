"""The command: `python -m tools.model_walks --walks 100`; with `--real` against a process that is killed."""

from __future__ import annotations

import argparse
import asyncio
import logging
import sys
import time
from functools import partial

import structlog

from service.grammar import Language
from tests import conftest
from tests.model.compare import DifferenceError
from tests.model.plan import Op, walk
from tests.model.shrinking import shrunk
from tests.model.walker import printed
from tests.model.walking import walked


async def found(ops: list[Op], language: Language, small_ones: bool, real: bool) -> str | None:
    """What went wrong in a walk; None if nothing did."""
    try:
        await walked(ops, language, small_ones, real=real)
    except DifferenceError as difference:
        return str(difference)
    return None


def quiet() -> None:
    """What a service writes of snapshots that a kill has overtaken is of no interest."""
    structlog.configure(wrapper_class=structlog.make_filtering_bound_logger(logging.WARNING))


def main() -> int:
    """Runs the walks that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--walks", type=int, default=20)
    parser.add_argument("--first", type=int, default=1, help="the first seed")
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--most", type=int, default=3, help="stop after so many that went wrong")
    parser.add_argument("--real", action="store_true", help="a process with a file, killed by the system")
    parser.add_argument("--no-shrink", action="store_true")
    asked = parser.parse_args()
    conftest.pytest_configure()  # grammars and schemas are read once
    language = Language.load()
    quiet()
    wrong = steps = ticks = refused = 0
    began = time.process_time()
    for seed in range(asked.first, asked.first + asked.walks):
        ops = walk(seed, asked.steps, by_hand=not asked.real)
        few = seed % 2 == 0 and not asked.real
        try:
            walker = asyncio.run(walked(ops, language, few, real=asked.real))
            steps, ticks, refused = steps + walker.done, ticks + walker.judge.ticks, refused + walker.refused
        except DifferenceError as difference:
            wrong += 1
            print(f"seed {seed}: {difference}", flush=True)
            if not asked.no_shrink:
                ops = asyncio.run(
                    shrunk(ops, partial(found, language=language, small_ones=few, real=asked.real))
                )
                print(asyncio.run(found(ops, language, few, asked.real)))
                print(printed(ops), flush=True)
            if wrong >= asked.most:
                break
    took = time.process_time() - began
    print(f"{steps} steps, {refused} refused, {ticks} ticks judged, {wrong} walks went wrong; {took:.0f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
