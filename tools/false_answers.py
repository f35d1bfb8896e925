"""Counts false answers to the canonical sentences, by kind of question, on very many drives.

    python -m tools.false_answers [--drives 20] [--seed 1] [--kinds near_misses,story] [--results FILE]

Each sentence of `prompts/questions/en/kinds.yaml` is asked of each drive. It is judged by its
form, and where a judge knows its kind by figures that are worked out anew from the recorded states, or by
driving again with the engine that sessions use. Dear kinds are asked of a part of the drives. Of all other
kinds the form alone is judged: the worst that may come, blame by rules, expectations, plans over time.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from service.actions import Ask
from service.grammar.engine import Language
from service.grammar.parse_types import Understood
from service.narration.narrator import Narrator
from service.resources import prompts_folder
from service.sessions.facts import Asked
from service.yaml_files import read_yaml
from sim.search.compiled_costs import load_compiled_costs
from tests.support import (
    judges_again,
    judges_beside,
    judges_of_drives,
    judges_of_futures,
    judges_of_nearness,
    judges_of_sight,
)
from tests.support.answer_judge import Judge, Told, formal
from tests.support.recorded_drives import Record, any_records

JUDGES: dict[str, Judge] = {
    **judges_of_drives.JUDGES,
    **judges_of_nearness.JUDGES,
    **judges_of_sight.JUDGES,
    **judges_of_futures.JUDGES,
    **judges_again.JUDGES,
    **judges_beside.JUDGES,
}
DEAR = 0.12
"""The share of drives of which each dear kind is asked."""
DEAR_S = 0.4
"""CPU seconds from which on a kind is dear."""
OF_BEFORE = "Of the drive before"
"""What an answer begins with that is about the drive before: the present one has just begun."""
SLOTS: dict[str, tuple[str, ...]] = {
    "planner": ("Dijkstra", "A*", "the rules", "BFS"),
    "planner_too": ("A*", "BFS"),
    "sensor": ("radar", "camera", "lidar"),
    "weather": ("foggy", "rainy"),
    "things": ("cars", "pedestrians", "potholes", "barriers"),
    "a_thing": ("a car", "a pothole", "a pedestrian"),
    "thing": ("the car ahead", "the nearest car"),
    "nearest": ("the nearest car", "the nearest pothole"),
    "side": ("to the left", "ahead", "to the right"),
    "go": ("go left", "go right", "stop"),
    "going": ("going left", "stopping"),
    "gone": ("gone left", "gone right", "stopped"),
    "instead": ("right", "forward"),
    "term": ("a barrier", "a near miss"),
    "n": ("3", "2", "1"),
    "ticks": ("3", "1", "2"),
    "lane": ("2", "1"),
}
"""What is put into the slots of the sentences."""


@cache
def _language() -> Language:
    return Language.load("en")


@cache
def _narrator() -> Narrator:
    return Narrator.load("en")


def sentences(kinds: frozenset[str] | None = None) -> list[tuple[str, str]]:
    """Each kind of question with its canonical sentences."""
    table: dict[str, Any] = read_yaml(prompts_folder() / "questions" / "en" / "kinds.yaml")
    return [
        (name, each)
        for name, kind in table.items()
        for each in dict.fromkeys(kind["says"])
        if kinds is None or name in kinds
    ]


def told_of(record: Record, kind: str, sentence: str, draw: random.Random) -> Told | None:
    """The answer to a sentence about a drive; None where the grammar does not know it so filled."""
    now = record.timeline.tick
    tick = draw.randrange(now + 1)
    slots = {name: draw.choice(values) for name, values in SLOTS.items()}
    slots |= {"tick": str(tick), "until": str(draw.randrange(tick, now + 1))}
    question = sentence.format(**slots)
    parsed = _language().parse(question)
    if not isinstance(parsed, Understood) or not isinstance(parsed.actions[0], Ask):
        return None
    asked = Asked(parsed.actions[0], record.timeline, supposes=parsed.supposed(0))
    return Told(record, kind, question, parsed.supposed(0), _narrator().answer(asked), slots)


def judged(
    record: Record, draw: random.Random, costs: Counter[str], kinds: frozenset[str] | None
) -> Iterator[tuple[str, str | None]]:
    """Each answer about a drive: its kind, and what is wrong; None where nothing is."""
    for kind, sentence in sentences(kinds):
        if kinds is None and costs[kind] > DEAR_S and draw.random() > DEAR:
            continue
        started = time.process_time()
        try:
            told = told_of(record, kind, sentence, draw)
            if told is None:
                continue
            spent = time.process_time() - started
            costs[kind] = max(costs[kind], spent)  # type: ignore[assignment]
            yield (
                f"form of {kind}",
                next((f"{each} | {told.question} {told.text}" for each in formal(told)), None),
            )
            if kind in JUDGES and not told.text.startswith(OF_BEFORE):
                wrong = list(JUDGES[kind](told))
                yield kind, f"{'; '.join(wrong)} | {told.question} {told.text}" if wrong else None
        except Exception:
            yield f"form of {kind}", f"{sentence}: {traceback.format_exc(limit=-4)}"


def count(
    drives: int, seed: int, kinds: frozenset[str] | None = None, seconds: float = 1e9
) -> tuple[Counter[str], Counter[str], list[str]]:
    """Answers that were judged and false ones, by kind, and a line for each false one."""
    looked, false, lines = Counter[str](), Counter[str](), []
    draw, costs, end = random.Random(seed), Counter[str](), time.monotonic() + seconds
    for number, record in enumerate(any_records(seed)):
        if number >= drives or time.monotonic() > end:
            break
        for kind, wrong in judged(record, draw, costs, kinds):
            looked[kind] += 1
            if wrong is not None:
                false[kind] += 1
                lines.append(
                    f"{kind} | drive {number} of seed {seed}, tick {record.timeline.tick}, {record.outcome}, "
                    f"{record.config.planner}, {record.config.sensor}: {wrong}"
                )
        looked["drives"] += 1
    return looked, false, lines


def main() -> int:
    """Print the figures; 1 where an answer is false."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--drives", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", help="kinds of question, with commas between; all by default")
    parser.add_argument("--seconds", type=float, default=1e9, help="when no further drive is begun")
    parser.add_argument("--show", type=int, default=2, help="false answers of each kind to print")
    parser.add_argument("--results", type=Path, help="where the counts are added as a line")
    options = parser.parse_args()
    load_compiled_costs(compile_now=True)
    kinds = frozenset(options.kinds.split(",")) if options.kinds else None
    looked, false, lines = count(options.drives, options.seed, kinds, options.seconds)
    shown = Counter[str]()
    for line in lines:
        kind = line.partition(" | ")[0]
        shown[kind] += 1
        if shown[kind] <= options.show:
            print(line)
    for kind in sorted(looked):
        if false[kind] or not kind.startswith("form of "):
            print(f"{kind:<30}{false[kind]:>6} of {looked[kind]}")
    forms = [kind for kind in looked if kind.startswith("form of ")]
    print(
        f"form: {sum(false[kind] for kind in forms)} of {sum(looked[kind] for kind in forms)} "
        f"in {len(forms)} kinds"
    )
    if options.results is not None:
        with options.results.open("a", encoding="utf-8") as file:
            file.write(json.dumps([options.seed, looked, false, lines]) + "\n")
    return int(false.total() > 0)


if __name__ == "__main__":
    sys.exit(main())
