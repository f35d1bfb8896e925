"""Is what a what-if states what comes of it? Each fork is really run: copied, changed and advanced.

`python -m tools.check_what_if --cases 10000` prints the figures. The answers are read as a client
reads them: the fork is made from `play`, and the sentence is held to how it ended.
"""

from __future__ import annotations

import argparse
import random
import re
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from service import actions as contract
from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import (
    Add,
    Adjust,
    Drive,
    Prefer,
    Remove,
    Reset,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Where,
    WorldAction,
)
from sim.config import Config
from sim.explain.what_if import what_if
from sim.session.errors import EditError
from sim.session.timeline import Timeline
from sim.types import Mode, Move, Outcome

PLANNERS = ("priority", "astar", "dijkstra", "bfs")
ENDS = {
    Outcome.SUCCESS: r"arrive in {ticks}\b",
    Outcome.CRASH: r"crash with \w+ [\w ]+? in {ticks}\b",
    Outcome.STUCK: r"get stuck",
}


@dataclass
class Real:
    """How a timeline went on that was really run."""

    end: int
    outcome: Outcome
    digest: str
    path: list[Move]


@dataclass
class Figures:
    """What was found."""

    cases: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)
    seconds: dict[str, list[float]] = field(default_factory=dict)


def run_on(timeline: Timeline) -> Real:
    """To the end of the episode; where a result stands, of the next."""
    path = []
    standing = timeline.state.world.outcome is not Outcome.RUNNING
    while standing or timeline.state.world.outcome is Outcome.RUNNING:
        decision = timeline.advance().decision
        if decision is not None:
            path.append(decision.move)
        standing = standing and timeline.state.world.outcome is not Outcome.RUNNING
    world = timeline.state.world
    return Real(world.tick, world.outcome, world.digest(), path)


def sessions(seed: int) -> Iterator[tuple[random.Random, Timeline]]:
    """Sessions at any moment, with any planner: on the way, at an end, driven by hand."""
    draw = random.Random(seed)
    while True:
        rows, columns = draw.choice([8, 12, 30]), draw.choice([4, 8])
        cells = rows * columns
        timeline = Timeline(
            Config(
                seed=draw.randrange(2**32),
                columns=columns,
                rows=rows,
                planner=draw.choice(PLANNERS),
                potholes=draw.choice([None, 0, cells // 12, cells // 6]),
                vehicles=draw.choice([None, 0, cells // 8, cells // 4]),
                pedestrians=draw.choice([0, 2]),
                barriers=draw.choice([0, 2]),
                courtesy=draw.choice([0.0, 0.0, 0.5]),
            )
        )
        for _ in range(draw.choice([0, draw.randrange(rows), draw.randrange(3 * rows)])):
            timeline.advance()
        if draw.random() < 0.1:
            timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
        yield draw, timeline


def a_change(draw: random.Random) -> tuple[WorldAction, ...]:
    """One to three things a person might ask about."""
    return tuple(an_action(draw) for _ in range(draw.choice([1, 1, 1, 2, 3])))


def an_action(draw: random.Random) -> WorldAction:
    """Draws an action that a what-if may hold."""
    kind: Any = draw.choice(["pothole", "barrier", "vehicle", "pedestrian"])
    where = draw.choice(
        [None, Where(side="ahead"), Where(side="left"), Where(lane=2), Where(side="ahead", distance_m=10.0)]
    )
    parameter: Any
    match draw.randrange(14):
        case 0 | 1:
            return Remove(kind=kind, count=1, where=Where(nearest=True))
        case 2:
            return Remove(kind=draw.choice(["everything", kind]), count="all", where=where)
        case 3 | 4:
            return Add(kind=kind, count=draw.choice([1, 1, 3]), where=where)
        case 5:
            return SetCount(kind=kind, count=draw.choice([0, 3, 10]))
        case 6 | 7:
            return Drive(move=draw.choice(list(Move)))
        case 8:
            return Set(parameter="planner", value=draw.choice(PLANNERS))
        case 9:
            return Prefer(preference=draw.choice(["avoid_potholes", "smooth_ride", "cautious", "balanced"]))
        case 10:
            return SetMode(mode=draw.choice(list(Mode)))
        case 11:
            parameter, value = draw.choice([("traffic", "heavy"), ("courtesy", 1.0), ("rows", 10)])
            return Set(parameter=parameter, value=value)
        case 12:
            return Adjust(parameter="safety_buffer", direction=draw.choice(["up", "down"]))
        case _:
            return draw.choice([Reset(), Scenario(road="city", potholes=2)])


def check(narrator: Narrator, draw: random.Random, timeline: Timeline, figures: Figures) -> None:
    """One question about one moment."""
    change = a_change(draw)
    before, log = timeline.state, list(timeline.entries)
    began = time.perf_counter()
    answer = narrator.answer(Asked(Ask(about="what_if", change=change), timeline))
    figures.seconds.setdefault(before.config.planner, []).append(time.perf_counter() - began)
    figures.cases["asked"] += 1
    what = f"{before.config} tick {timeline.tick}: {change}: {answer['text']}"
    if timeline.state is not before or timeline.entries != log:
        figures.wrong.append(f"the session was touched: {what}")
    if "play" not in answer:
        figures.cases["cannot be"] += 1
        fork = (
            timeline.copy() if before.world.ended is None else replayed_to(timeline, before.world.ended - 1)
        )
        try:
            fork.apply(9, change)
        except EditError:
            return
        figures.wrong.append(f"it can be: {what}")
        return
    play = answer["play"]
    if play["at_tick"] == timeline.tick:
        as_it_is, fork = timeline.copy(), timeline.copy()
    else:  # the drive has ended: it is looked at from a tick of it
        figures.cases["a drive that has ended"] += 1
        if (
            before.world.ended is None
            or not before.world.episode_start <= play["at_tick"] < before.world.ended
        ):
            figures.wrong.append(f"asked of tick {play['at_tick']}: {what}")
        as_it_is, fork = (replayed_to(timeline, play["at_tick"]) for _ in range(2))
    actions: Any = contract.load(play["actions"])
    fork.apply(9, actions)
    real, changed = run_on(as_it_is), run_on(fork)
    figures.cases[f"{real.outcome} → {changed.outcome}"] += 1
    for told, came in ((answer["real"], real), (answer["changed"], changed)):
        stated = (told["outcome"], told["end_tick"], told["digest"], list(told["path"]))
        if stated != (came.outcome, came.end, came.digest, came.path):
            figures.wrong.append(f"{came}: {what}")
    if answer["same_road"]:
        check_difference(answer["first_difference"], real, changed, what, figures)
    if (
        "How others react is left to chance" in answer["text"]
    ):  # where others react by chance, it tells the chance of the outcome
        figures.cases["told as a chance"] += 1
    elif "would change nothing" not in answer["text"]:
        seconds = fork.state.config.step_seconds * len(changed.path)
        ticks = rf"{re.escape(f'{seconds:g}')}( s)?"
        if not re.search(ENDS[changed.outcome].format(ticks=ticks), answer["text"]):
            figures.wrong.append(f"said otherwise, {changed}: {what}")


def check_difference(told: Any, real: Real, changed: Real, what: str, figures: Figures) -> None:
    """Compares what an answer says of the first difference with both rollouts."""
    pairs = list(zip(real.path, changed.path, strict=False))
    ahead = next((place for place, (one, other) in enumerate(pairs) if one is not other), None)
    figures.cases["no difference" if ahead is None else "a difference"] += 1
    if ahead is None:
        if told is not None:
            figures.wrong.append(f"no difference: {what}")
        return
    stated = None if told is None else (told["ahead"], told["real"], told["changed"])
    if stated != (ahead, *pairs[ahead]) or told["tick"] != real.end - len(real.path) + ahead:
        figures.wrong.append(f"they differ after {ahead}: {what}")


def replayed_to(timeline: Timeline, tick: int) -> Timeline:
    """The session driven again to a tick, with what was said by then."""
    fork = Timeline(timeline.config)
    while True:
        for entry in timeline.entries:
            if entry.tick == fork.tick:
                fork.apply(entry.sequence, [entry.action])
        if fork.tick == tick:
            return fork
        fork.advance()


def check_past(draw: random.Random, timeline: Timeline, figures: Figures) -> None:
    """The same about a moment that has passed."""
    tick = draw.randrange(timeline.tick + 1)
    change = a_change(draw)
    fork = replayed_to(timeline, tick)
    try:
        found = what_if(timeline, change, tick)
    except EditError:
        figures.cases["cannot be"] += 1
        return
    fork.apply(9, change)
    came = run_on(fork)
    figures.cases["about the past"] += 1
    if (found.changed.outcome, found.changed.end, found.changed.digest) != (
        came.outcome,
        came.end,
        came.digest,
    ):
        figures.wrong.append(f"{came}: {timeline.config} tick {tick}: {change}")


def checked(cases: int, seed: int = 0) -> Figures:
    """So many questions, one in ten of them about the past."""
    narrator, figures = Narrator.load(), Figures()
    for number, (draw, timeline) in enumerate(sessions(seed)):
        if number == cases:
            return figures
        if number % 10 == 9:
            check_past(draw, timeline, figures)
        else:
            check(narrator, draw, timeline, figures)
    raise AssertionError("there is always one more session")


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    figures = checked(asked.cases, asked.seed)
    for what, count in sorted(figures.cases.items()):
        print(f"{count:7d}  {what}")
    for planner, seconds in sorted(figures.seconds.items()):
        ordered = sorted(seconds)
        p50, p99 = (1e3 * ordered[int(share * (len(ordered) - 1))] for share in (0.5, 0.99))
        print(f"{planner:9s} {len(ordered):5d} answers, p50 {p50:.1f} ms, p99 {p99:.1f} ms")
    for wrong in figures.wrong[:10]:
        print("WRONG", wrong)
    print(f"{asked.cases} cases, {len(figures.wrong)} wrong")
    raise SystemExit(bool(figures.wrong))


if __name__ == "__main__":
    main()
