"""Counts false sentences in very many explanations, by kind; each is checked by changing the road.

python -m tools.false_sentences --decisions 2000
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace

from service.actions import Ask
from service.narration.crash import Crashes
from service.sessions.facts import Asked
from sim.actions import Remove, Where
from sim.config import Config
from sim.explain import QuestionError, why, why_not
from sim.explain.crash import why_crashed
from sim.plan import traits_of
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome
from tests.support import sentence_judge as judge

SHARES = {"priority": 0.35, "rules": 0.30, "bfs": 0.13, "dijkstra": 0.11, "astar": 0.11}
"""How many of the decisions are whose."""
BATCH = 25
CRASHES = "crashes"
DRAWS = 4
"""Futures drawn to see whether it hangs on chance how it ends."""
THOROUGH = 50
"""Every so many decisions of a quick planner all changes up to two edits are tried out."""
DENSITIES = ((4, 10, 0, 0), (12, 30, 3, 4), (25, 90, 6, 8), (40, 60, 4, 0))
"""Potholes, vehicles, pedestrians and barriers on a road of 8 lanes and 30 rows."""


def drives(count: int, seed: int, planner: str) -> Iterator[Timeline]:
    """Timelines that have just taken a decision; some run on to a crash."""
    draw, found = random.Random(f"{planner} {seed}"), 0
    while found < count:
        rows = 30 if planner in ("priority", "rules") else 12
        potholes, vehicles, pedestrians, barriers = (
            round(each * rows / 30) for each in draw.choice(DENSITIES)
        )
        config = Config(
            seed=draw.randrange(2**32),
            columns=8,
            rows=rows,
            potholes=potholes,
            vehicles=vehicles,
            pedestrians=pedestrians,
            barriers=barriers,
            courtesy=draw.choice([0.0, 0.5]),
            planner=planner,
        )
        if planner in ("dijkstra", "astar") and draw.random() < 0.4:
            config = config.with_parts(
                preferences=draw.choice([("cautious",), ("fastest",), ("smooth_ride",)])
            )
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, rows)):
            timeline.advance()
            if timeline.state.world.outcome is Outcome.CRASH:
                break
        if timeline.at(timeline.tick - 1).world.outcome is Outcome.RUNNING:
            found += 1
            yield timeline


def crashes(count: int, seed: int) -> Iterator[Timeline]:
    """Timelines of dense roads on which nobody brakes, that have ended in a crash."""
    draw, found = random.Random(f"crashes {seed}"), 0
    while found < count:
        config = Config(
            seed=draw.randrange(2**32),
            potholes=draw.choice([18, 25]),
            vehicles=draw.choice([40, 90]),
            pedestrians=6,
            barriers=8,
            attentive=0.0,
            planner=draw.choice(["priority", "rules"]),
        )
        timeline = Timeline(config)
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        if timeline.state.world.outcome is Outcome.CRASH:
            found += 1
            yield timeline


def checked(job: tuple[str, int, int]) -> tuple[Counter[str], Counter[str], list[str]]:
    """How many sentences were looked at, how many were false, and those."""
    planner, seed, count = job
    looked, false, lines = Counter[str](), Counter[str](), []
    if planner == CRASHES:
        for timeline in crashes(count, seed):
            for kind, wrong in _of_crash(timeline):
                looked[kind] += 1
                if wrong is not None:
                    false[kind] += 1
                    lines.append(f"{kind} | seed {timeline.state.config.seed}: {wrong}")
        return looked, false, lines
    draw = random.Random(seed)
    for at, timeline in enumerate(drives(count, seed, planner)):
        looked["decisions"] += 1
        for kind, found in _of_decision(
            timeline, draw, thorough=traits_of(planner).quick and (BATCH * seed + at) % THOROUGH == 0
        ):
            looked[kind] += 1
            if found is not None:
                false[kind] += 1
                config = timeline.state.config
                lines.append(f"{kind} | {planner} seed {config.seed} tick {timeline.tick - 1}: {found}")
    return looked, false, lines


def _of_decision(timeline: Timeline, draw: random.Random, *, thorough: bool) -> judge.Judged:
    sayings, explained, narrator = judge.reading()
    state = timeline.at(timeline.tick - 1)
    explanation = why(timeline)
    decision = explanation.decision
    sayings.recorded()
    text = explained.text(explanation)
    named = sayings.recorded()
    yield from judge.judge_comes_first(explanation, text)
    yield from judge.judge_groups(explanation, thorough=thorough)
    yield from judge.judge_left_out(explanation, text, named)
    yield from judge.judge_wording(text)
    line = narrator.decision(decision, state)
    yield from judge.judge_narration(state, decision, line, sayings.recorded())
    foil = draw.choice([move for move in Move if move is not decision.move])
    other = why_not(timeline, foil)
    text = explained.text(other)
    yield from judge.judge_comes_first(other, text)
    yield from judge.judge_change(other, text, thorough=thorough)
    yield from judge.judge_chance(state, text, ends_differ=_hangs_on_chance(state))
    yield from judge.judge_wording(text)
    if state.world.movers:
        change = (Remove(kind="vehicle", count=1, where=Where(nearest=True)),)
        told = narrator.answer(Asked(Ask(about="what_if", change=change), timeline))["text"]
        yield from judge.judge_chance(state, told, ends_differ=_hangs_on_chance(timeline.state))
        yield from judge.judge_wording(told)
    if timeline.state.world.outcome is Outcome.CRASH:
        yield from _of_crash(timeline)


def _hangs_on_chance(state: SimState) -> bool:
    """Whether different draws of who gives way lead to different ends."""
    ends = set()
    for seed in range(DRAWS if state.config.courtesy else 0):
        drawn = replace(state, config=state.config.with_parts(seed=state.config.seed + seed))
        while drawn.world.outcome is Outcome.RUNNING:
            drawn = step(drawn).state
        ends.add((drawn.world.outcome, drawn.world.tick))
    return len(ends) > 1


def _of_crash(timeline: Timeline) -> judge.Judged:
    sayings, _, _ = judge.reading()
    try:
        crash = why_crashed(timeline)
    except QuestionError:
        return
    text = Crashes(sayings).text(crash)
    start = timeline.state.world.episode_start
    yield from judge.judge_crash(crash, timeline.at(max(start, crash.end - 64)), timeline.at, text)
    yield from judge.judge_wording(text)


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--decisions", type=int, default=2_000)
    parser.add_argument("--crashes", type=int, default=100)
    parser.add_argument("--show", type=int, default=2, help="false sentences of each kind to print")
    options = parser.parse_args()
    jobs = [
        (planner, seed, min(BATCH, round(options.decisions * share) - done))
        for planner, share in SHARES.items()
        for seed, done in enumerate(range(0, round(options.decisions * share), BATCH))
    ]
    jobs += [
        (CRASHES, seed, min(BATCH, options.crashes - done))
        for seed, done in enumerate(range(0, options.crashes, BATCH))
    ]
    looked, false, shown = Counter[str](), Counter[str](), Counter[str]()
    lines: list[str] = []
    with ProcessPoolExecutor(2) as pool:
        for each, wrong, told in pool.map(checked, jobs):
            looked += each
            false += wrong
            lines += told
    for kind in sorted(looked):
        print(f"{kind:<42}{false[kind]:>7} of {looked[kind]}")
    for line in lines:
        kind = line.partition(" | ")[0]
        shown[kind] += 1
        if shown[kind] <= options.show:
            print(line)


if __name__ == "__main__":
    main()
