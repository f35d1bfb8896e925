"""A reader that knows nothing but the structured part of an answer, and says what happens after a change.

    python -m tools.explanations_to_read [--cases 2000] [--planner priority] [--wrong]

It believes what is stated: a stated change leads to the stated decision, a thing whose removal alone is
no stated change leaves the decision as it was, and without its causes the decision is another. `--wrong`
lists what it gets wrong.
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


def predicted(answer: Json, gone: str) -> str | None:
    """The decision after one thing is taken away, as far as the answer says; None where it does not.

    What is listed as not tried is not said, nor what a necessary cause leads to where no change is stated.
    """
    for flip in answer["evidence"]["counterfactuals"]:
        removed = [action["where"]["id"] for action in flip["change"] if action["do"] == "remove"]
        if removed == [gone] and len(flip["change"]) == 1:
            return str(flip["decision"])
    if gone in answer["evidence"].get("untried", ()):
        return None
    if any(cause["id"] == gone and cause["necessary"] for cause in answer["causes"]):
        return None
    return str(answer["move"])


def main() -> None:
    """Prints how often the reader is right."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--cases", type=int, default=2_000)
    parser.add_argument("--planner", default="priority")
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--wrong", action="store_true")
    options = parser.parse_args()
    draw = random.Random(5)
    counts: Counter[str] = Counter()
    for timeline in moments(options.cases, options.seed, options.planner):
        explanation = why(timeline)
        state, answer = (
            explanation.moment,
            explanation_json(explanation, [""] * len(explanation.decision.options)),
        )
        for flip in answer["evidence"]["counterfactuals"]:
            counts["stated"] += 1
            counts["stated, right"] += move_after(state, load(flip["change"])) == Move(flip["decision"])
        near = sorted(
            state.world.things(),
            key=lambda thing: abs(thing.cell[1] - state.world.road.cell(state.world.av)[1]),
        )
        if near:
            gone = draw.choice(near[: draw.choice([3, 8, 40])]).id
            said, seen = predicted(answer, gone), move_after(state, taking([gone], state.config))
            counts["perturbed"] += 1
            counts["not said"] += said is None
            counts["perturbed, right"] += said == seen
            if options.wrong and said not in (None, seen):
                where = f"seed {state.config.seed} tick {answer['tick']}"
                print(f"{where}: without {gone} said {said}, is {seen}; made {answer['move']}")
    said = counts["perturbed"] - counts["not said"]
    print(f"stated changes   {counts['stated']:>7}, right {counts['stated, right'] / counts['stated']:.4%}")
    right = counts["perturbed, right"] / said
    print(f"one thing gone   {counts['perturbed']:>7}, said {said}, right {right:.4%} of them")


if __name__ == "__main__":
    main()
