"""Prints answers as a passenger would hear them, with their words, and what no passenger should hear.

    python -m tools.answers_aloud [--answers 120] [--seed 1] [--language en]

Questions are asked of drives of all planners, densities and courtesies, under way and at their end.
Counted are answers of more than 60 words and of names of code, ticks and raw costs.
"""

from __future__ import annotations

import argparse
import random
import re
import statistics
import sys
from collections.abc import Iterator

from service.grammar.engine import Language
from service.grammar.parse_types import Understood
from service.narration.answers import Answers
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Outcome

QUESTIONS = {
    "running": (
        "why did you do that?",
        "why didn't you go left?",
        "why not right?",
        "what if you had gone straight?",
        "what will you do next?",
        "what would it take for you to go left?",
        "where are you?",
        "what is in front of you?",
        "how sure are you?",
        "is it safe to go left?",
        "when will we arrive?",
        "what was the riskiest moment so far?",
        "summarise this trip",
        "what would A* do here?",
        "are you stuck?",
        "what happened between 1 and 4?",
        "why left instead of right?",
    ),
    "ended": (
        "why did you crash?",
        "what was the closest call?",
        "whose fault was it?",
        "could you have avoided it?",
        "when was it too late?",
        "did you see it coming?",
        "summarise this trip",
        "why did you do that?",
        "compare the planners",
    ),
}
MOST_WORDS = 60
_CODE = re.compile(r"\b(?:vehicle|pothole|barrier|pedestrian|av)-\d+|\b\w+_\w+\b|[{}<>]|\bNone\b|\bTrue\b")
_TICK = re.compile(r"\bticks?\b", re.IGNORECASE)
_NUMBER = re.compile(r"\d")
_COST = re.compile(r"\b\d{4,}\b")


def drives(draw: random.Random) -> Iterator[Timeline]:
    """Runs, some under way and some at their end."""
    while True:
        rows, columns = draw.choice([12, 20, 30]), draw.choice([4, 6, 8])
        cells = rows * columns
        timeline = Timeline(
            Config(
                seed=draw.randrange(2**32),
                rows=rows,
                columns=columns,
                planner=draw.choice(["rules", "priority", "astar", "dijkstra", "bfs"]),
                courtesy=draw.choice([0.0, 0.5]),
                vehicles=cells // draw.choice([6, 10, 20]),
                potholes=cells // draw.choice([8, 15, 30]),
                pedestrians=draw.choice([0, 2]),
                barriers=draw.choice([0, 3]),
            )
        )
        for _ in range(draw.choice([2, 5, 9, 60])):
            if timeline.state.world.outcome is Outcome.RUNNING:
                timeline.advance()
        yield timeline


def faults(text: str, question: str = "") -> list[str]:
    """What no passenger should hear in an answer; ticks may be told to who asked by their numbers."""
    named = [(_CODE, "code"), (_COST, "raw number")]
    if not _NUMBER.search(question):
        named.append((_TICK, "tick"))
    found = [f"{name}: {match[0]}" for pattern, name in named if (match := pattern.search(text))]
    words = len(text.split())
    return [*found, f"{words} words"] if words > MOST_WORDS else found


def main() -> int:
    """Prints the answers; fails where one has a fault."""
    parser = argparse.ArgumentParser(prog="tools.answers_aloud")
    parser.add_argument("--answers", type=int, default=120)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--language", default="en", help="of the answers")
    options = parser.parse_args()
    draw = random.Random(options.seed)
    language, answers = Language.load("en"), Answers(Sayings.load(options.language))
    lengths, faulty = [], 0
    for timeline in drives(draw):
        running = timeline.state.world.outcome is Outcome.RUNNING
        for question in draw.sample(QUESTIONS["running" if running else "ended"], 4):
            parsed = language.parse(question)
            if not isinstance(parsed, Understood):
                print(f"not understood: {question}")
                continue
            asked = Asked(parsed.actions[0], timeline, supposes=parsed.supposed(0))  # type: ignore[arg-type]
            text = answers.answer(asked)["text"]
            lengths.append(len(text.split()))
            wrong = faults(text, question)
            faulty += bool(wrong)
            print(f"{question}  [{lengths[-1]}{'; ' + '; '.join(wrong) if wrong else ''}]\n    {text}")
        if len(lengths) >= options.answers:
            break
    mean, middle = statistics.mean(lengths), statistics.median(lengths)
    print(f"{len(lengths)} answers: {mean:.1f} words in the mean, {middle:.0f} in the middle, "
          f"{max(lengths)} at most; {faulty} with a fault")  # fmt: skip
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
