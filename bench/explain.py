"""Answers to questions: how long each kind takes, by planner, words included."""

from __future__ import annotations

import random
from collections.abc import Iterator

from bench.timing import timed
from service import actions as contract
from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.types import Move
from tests.support.moments import moments

COUNTS = {"priority": 1_000, "bfs": 200, "dijkstra": 60, "astar": 60}
KINDS = ("why", "why_not", "what_if", "scene", "next", "confidence", "metrics", "status")


def asked(kind: str, planner: str) -> Iterator[Asked]:
    """Questions of one kind at random moments."""
    draw = random.Random(1)
    for timeline in moments(COUNTS[planner], seed=21, planner=planner):
        match kind:
            case "why_not":
                ask = Ask(about="why_not", move=draw.choice(list(Move)))
            case "what_if":
                (change,) = contract.load([{"do": "remove", "kind": "pothole", "count": "all"}])
                ask = Ask(about="what_if", change=(change,))
            case _:
                ask = Ask(about=kind)  # type: ignore[arg-type]
        yield Asked(ask, timeline)


def main() -> None:
    """Print a row for each kind and planner."""
    narrator = Narrator.load()
    for planner in COUNTS:
        for kind in KINDS:
            questions = list(asked(kind, planner))
            print(timed(narrator.answer, questions).row(f"{kind}, {planner}"))


if __name__ == "__main__":
    main()
