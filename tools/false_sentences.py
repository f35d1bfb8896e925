"""Counts false sentences in very many explanations, by kind; each is checked by changing the road.

python -m tools.false_sentences --decisions 20000 --crashes 400 --results counted.jsonl

What has been counted is kept in the file of results, batch by batch, so that a count goes on where it was
stopped. Dear checks are made of a part: see `THOROUGH` and `CHANCES`.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from service.actions import Ask
from service.narration.crash import Crashes
from service.narration.what_if import WhatIfs
from service.sessions.facts import Asked
from sim.actions import Remove, Where
from sim.explain import QuestionError, why, why_not
from sim.explain.crash import why_crashed
from sim.explain.what_if import what_if
from sim.plan import traits_of
from sim.search.compiled_costs import load_compiled_costs
from sim.session.timeline import Timeline
from sim.types import Kind, Move, Outcome
from tests.support import sentence_judge as judge
from tests.support.chance_judge import hangs_on_chance, judge_stated
from tests.support.judged_drives import crashes, drives

SHARES = {"priority": 0.35, "rules": 0.30, "bfs": 0.13, "dijkstra": 0.11, "astar": 0.11}
"""How many of the decisions are whose."""
BATCH = 25
CRASHES = "crashes"
DRAWS = 4
"""Futures drawn to see whether it hangs on chance how it ends."""
THOROUGH = 2_000
"""One of so many decisions of quick planners has all changes up to two edits tried out."""
CHANCES = 20
"""One of so many decisions has the chances that are stated of it held to futures drawn anew."""
FURTHER = ("next", "confidence", "scene")
"""Questions of which the wording is judged too, one for each decision."""

Job = tuple[str, int, int]
"""A planner or `CRASHES`, a seed, and how many."""
Counted = tuple[Counter[str], Counter[str], list[str]]
"""How many sentences were looked at, how many were false, and those."""


def checked(job: Job) -> Counted:
    """The count of a batch."""
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
    for at, timeline in enumerate(drives(count, seed, planner), BATCH * seed):
        looked["decisions"] += 1
        for kind, found in _of_decision(timeline, at):
            looked[kind] += 1
            if found is not None:
                false[kind] += 1
                config = timeline.state.config
                lines.append(f"{kind} | {planner} seed {config.seed} tick {timeline.tick - 1}: {found}")
    return looked, false, lines


def _of_decision(timeline: Timeline, number: int) -> judge.Judged:
    state = timeline.at(timeline.tick - 1)
    thorough = traits_of(state.config.planner).quick and number % THOROUGH == THOROUGH - 1
    yield from _of_why(timeline, thorough=thorough)
    yield from _of_why_not(timeline, number, thorough=thorough)
    if timeline.state.world.outcome is Outcome.RUNNING and timeline.state.world.count(Kind.VEHICLE):
        yield from _of_what_if(timeline, number)
    if timeline.state.world.outcome is Outcome.CRASH:
        yield from _of_crash(timeline)
    else:
        _, _, narrator = judge.reading()
        about = FURTHER[number % len(FURTHER)]
        yield from judge.judge_wording(narrator.answer(Asked(Ask(about=about), timeline))["text"])  # type: ignore[arg-type]


def _of_why(timeline: Timeline, *, thorough: bool) -> judge.Judged:
    sayings, explained, narrator = judge.reading()
    explanation = why(timeline)
    text = explained.text(explanation)
    named = sayings.recorded(text)
    yield from judge.judge_comes_first(explanation, text)
    yield from judge.judge_groups(explanation, thorough=thorough)
    yield from judge.judge_left_out(explanation, text, named)
    yield from judge.judge_chain(explanation)
    yield from judge.judge_wording(text)
    line = narrator.decision(explanation.decision, explanation.moment)
    yield from judge.judge_narration(explanation.moment, explanation.decision, line, sayings.recorded(line))


def _of_why_not(timeline: Timeline, number: int, *, thorough: bool) -> judge.Judged:
    _, explained, _ = judge.reading()
    state = timeline.at(timeline.tick - 1)
    made = timeline.decision(timeline.tick - 1)
    assert made is not None
    foil = random.Random(number).choice([move for move in Move if move is not made.move])
    explanation = why_not(timeline, foil)
    text = explained.text(explanation)
    yield from judge.judge_comes_first(explanation, text)
    yield from judge.judge_change(explanation, text, thorough=thorough)
    off_road = made.option(foil).cell is None
    differ = not off_road and any(hangs_on_chance(state, DRAWS, move) for move in (foil, made.move))
    yield from judge.judge_chance(state, text, ends_differ=differ)
    yield from judge.judge_wording(text)
    stakes = explanation.stakes
    if number % CHANCES == 0 and stakes is not None and stakes.by_chance:
        yield from judge_stated(state, foil, stakes.would_chances, text)
        yield from judge_stated(state, made.move, stakes.real_chances, text)


def _of_what_if(timeline: Timeline, number: int) -> judge.Judged:
    sayings, _, _ = judge.reading()
    change = (Remove(kind="vehicle", count=1, where=Where(nearest=True)),)
    found = what_if(timeline, change)
    text = WhatIfs(sayings).text(Ask(about="what_if", change=change), found)
    differ = any(hangs_on_chance(each, DRAWS) for each in (found.state, found.done[-1].state))
    yield from judge.judge_chance(found.state, text, ends_differ=differ)
    yield from judge.judge_wording(text)
    if number % CHANCES == 0 and found.by_chance:
        yield from judge_stated(found.state, None, found.real_chances, text)
        yield from judge_stated(found.done[-1].state, None, found.changed_chances, text)


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


def jobs_of(decisions: int, accidents: int) -> list[Job]:
    """The batches, so mixed that any beginning of them holds every planner."""
    jobs = [
        (planner, seed, min(BATCH, round(decisions * share) - done))
        for planner, share in SHARES.items()
        for seed, done in enumerate(range(0, round(decisions * share), BATCH))
    ]
    jobs += [
        (CRASHES, seed, min(BATCH, accidents - done)) for seed, done in enumerate(range(0, accidents, BATCH))
    ]
    many = Counter(job[0] for job in jobs)
    return sorted(jobs, key=lambda job: (job[1] / many[job[0]], job[0]))


def counted(jobs: list[Job], results: Path | None, processes: int) -> Iterator[Counted]:
    """The counts of all batches; those that are in the file of results are read, and the others written."""
    known: dict[Job, Counted] = {}
    if results is not None and results.exists():
        for line in results.read_text(encoding="utf-8").splitlines():
            job, looked, false, lines = json.loads(line)
            known[tuple(job)] = Counter(looked), Counter(false), lines  # type: ignore[index]
    yield from (known[job] for job in jobs if job in known)
    left = [job for job in jobs if job not in known]
    with ProcessPoolExecutor(processes) as pool:
        for job, found in zip(left, pool.map(checked, left), strict=True):
            if results is not None:
                with results.open("a", encoding="utf-8") as file:
                    file.write(json.dumps([job, *found]) + "\n")
            yield found


def main() -> int:
    """Print the figures; 1 where a sentence is false."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--decisions", type=int, default=2_000)
    parser.add_argument("--crashes", type=int, default=100)
    parser.add_argument("--show", type=int, default=2, help="false sentences of each kind to print")
    parser.add_argument("--results", type=Path, help="where counts are kept, and read to go on from")
    parser.add_argument("--processes", type=int, default=1)
    options = parser.parse_args()
    looked, false, shown = Counter[str](), Counter[str](), Counter[str]()
    load_compiled_costs(compile_now=True)
    jobs = jobs_of(options.decisions, options.crashes)
    for each, wrong, told in counted(jobs, options.results, options.processes):
        looked += each
        false += wrong
        for line in told:
            kind = line.partition(" | ")[0]
            shown[kind] += 1
            if shown[kind] <= options.show:
                print(line, flush=True)
    for kind in sorted(looked):
        print(f"{kind:<42}{false[kind]:>7} of {looked[kind]}")
    return int(false.total() > 0)


if __name__ == "__main__":
    sys.exit(main())
