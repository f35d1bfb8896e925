"""Answers to questions: CPU time of each kind, by planner, words included.

On roads of 8 lanes and 30 rows from empty to crowded, without and with courtesy. Each question is answered
several times, each time anew on a drive of its own, and counts by the least time: other work on the same
processor doubles the time of a single answer.
"""

from __future__ import annotations

import gc
import random
import time
from collections.abc import Callable, Iterator
from itertools import product

from bench.timing import Times
from service import actions as contract
from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.config import Config
from sim.search.compiled_costs import load_compiled_costs
from sim.session.timeline import Timeline
from sim.types import Kind, Move, Outcome
from tests.support.judged_drives import DENSITIES

COUNTS = {"priority": 200, "rules": 200, "bfs": 200, "dijkstra": 100, "astar": 100}
COURTESIES = (0.0, 0.5)
ROUNDS = 3
"""How often each question is answered."""
KINDS = ("why", "why_not", "what_if", "scene", "next", "confidence", "metrics", "status")


def drives(planner: str, courtesy: float) -> Iterator[Timeline]:
    """Timelines under way, at random ticks."""
    draw, found = random.Random(f"{planner} {courtesy}"), 0
    while found < COUNTS[planner]:
        potholes, vehicles, pedestrians, barriers = draw.choice(DENSITIES)
        config = Config(
            seed=draw.randrange(2**32),
            columns=8,
            rows=30,
            potholes=potholes,
            vehicles=vehicles,
            pedestrians=pedestrians,
            barriers=barriers,
            courtesy=courtesy,
            planner=planner,
        )
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, 30)):
            timeline.advance()
        if timeline.state.world.outcome is Outcome.RUNNING and timeline.state.world.count(Kind.VEHICLE):
            found += 1
            yield timeline


def asked(kind: str, planner: str, courtesy: float) -> Iterator[Asked]:
    """Questions of one kind at random moments."""
    draw = random.Random(1)
    for timeline in drives(planner, courtesy):
        match kind:
            case "why_not":
                ask = Ask(about="why_not", move=draw.choice(list(Move)))
            case "what_if":
                removed = {"do": "remove", "kind": "vehicle", "count": 1, "where": {"nearest": True}}
                (change,) = contract.load([removed])
                ask = Ask(about="what_if", change=(change,))
            case _:
                ask = Ask(about=kind)  # type: ignore[arg-type]
        yield Asked(ask, timeline)


def seconds_of(call: Callable[[Asked], object], questions: Iterator[Asked]) -> list[float]:
    """How many seconds the processor works for each question."""
    seconds = []
    for question in questions:
        start = time.process_time()
        call(question)
        seconds.append(time.process_time() - start)
    return seconds


def main() -> None:
    """Print a row for each kind and planner, once all rounds are done."""
    load_compiled_costs(compile_now=True)
    narrator = Narrator.load()
    gc.freeze()  # as the service does once it has started
    least: dict[tuple[str, str, float], list[float]] = {}
    for _ in range(ROUNDS):
        for row in product(KINDS, COUNTS, COURTESIES):
            seconds = seconds_of(narrator.answer, asked(*row))
            least[row] = list(map(min, seconds, least.get(row, seconds)))
    for planner, courtesy, kind in product(COUNTS, COURTESIES, KINDS):
        times = Times(sorted(least[kind, planner, courtesy]))
        print(times.row(f"{kind}, {planner}, courtesy {courtesy}"))


if __name__ == "__main__":
    main()
