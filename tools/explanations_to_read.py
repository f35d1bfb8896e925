"""A reader that knows nothing but the structured part of an answer, and says what happens after a change.

    python -m tools.explanations_to_read --cases 10000

It believes what is stated: a stated change leads to the stated decision, and taking away what is no
cause changes nothing.
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from typing import Any

from service.actions import load
from service.contract.encode.explanation import explanation_json
from sim.explain import why
from sim.types import Move
from tests.support.intervention_judge import move_after, taking
from tests.support.moments import moments

Json = dict[str, Any]


def predicted(answer: Json, gone: list[str]) -> str | None:
    """The decision after these were taken away, as far as the answer says; None where it does not."""
    for flip in answer["evidence"]["counterfactuals"]:
        removed = [action["where"]["id"] for action in flip["change"] if action["do"] == "remove"]
        if set(removed) == set(gone) and len(removed) == len(flip["change"]):
            return str(flip["decision"])
    told = {name for cause in answer["causes"] for name in cause["group"]}
    if not told & set(gone):
        return str(answer["move"])
    return None


def main() -> None:
    """Print how often the reader is right."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=10_000)
    cases = parser.parse_args().cases
    draw = random.Random(5)
    counts: Counter[str] = Counter()
    for timeline in moments(cases, seed=11):
        explanation = why(timeline)
        state, answer = explanation.moment, explanation_json(explanation)
        for flip in answer["evidence"]["counterfactuals"]:
            counts["stated"] += 1
            counts["stated, right"] += move_after(state, load(flip["change"])) == Move(flip["decision"])
        near = sorted(
            state.world.things(),
            key=lambda thing: abs(thing.cell[1] - state.world.road.cell(state.world.av)[1]),
        )
        if near:
            gone = [draw.choice(near[: draw.choice([3, 8, 40])]).id]
            said = predicted(answer, gone)
            counts["perturbed"] += 1
            counts["not said"] += said is None
            counts["perturbed, right"] += said == move_after(state, taking(gone, state.config))
    said = counts["perturbed"] - counts["not said"]
    print(f"stated changes   {counts['stated']:>7}, right {counts['stated, right'] / counts['stated']:.4%}")
    right = counts["perturbed, right"] / said
    print(f"one thing gone   {counts['perturbed']:>7}, said {said}, right {right:.4%} of them")


if __name__ == "__main__":
    main()
