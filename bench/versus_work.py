"""The work of `bench.versus`, by the code of whichever checkout is on the path.

A program of its own: it reads questions from its input and imports nothing of `bench`. Where two versions
call the same thing differently, all its names stand in the table below, the newer one first.
"""

from __future__ import annotations

import gc
import json
import os
import sys
import time
from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from operator import attrgetter
from typing import Any, Final

PLACES: Final[dict[str, tuple[str, ...]]] = {
    "Config": ("sim.config:Config",),
    "State": ("sim.state:SimState", "sim.run:Run"),
    "Result": ("sim.state:StepResult", "sim.transition:StepResult", "sim.step:StepResult", "sim.run:Tick"),
    "step": ("sim.state:step", "sim.step:step", "sim.transition:step", "sim.run:advance"),
    "Outcome": ("sim.types:Outcome", "sim.kinds:Outcome"),
    "Move": ("sim.types:Move", "sim.kinds:Move"),
    "Timeline": ("sim.session.timeline:Timeline", "sim.timeline:Timeline"),
    "Add": ("sim.actions:Add",),
    "Remove": ("sim.actions:Remove",),
    "SetCount": ("sim.actions:SetCount",),
    "least_ticks": ("sim.oracle:least_ticks", "sim.optimum:least_ticks"),
    "certify": ("sim.oracle:certify", "sim.optimum:certify"),
    "why": ("sim.explain:why",),
    "why_not": ("sim.explain:why_not",),
    "QuestionError": ("sim.explain:QuestionError",),
    "what_if": ("sim.explain:what_if", "sim.explain.what_if:what_if", "sim.explain.whatif:what_if"),
    "why_crashed": ("sim.explain:why_crashed", "sim.explain.crash:why_crashed"),
    "RoadEnv": ("sim.env:RoadEnv",),
    "RoadVectorEnv": ("sim.env:RoadVectorEnv",),
    "Batch": ("sim.batch:Batch",),
}
"""Where things are: module and name."""
STATE: Final = ("state", "run")
"""What the present state is called in the result of a step and in a timeline."""
STEP: Final = ("step", "advance")
"""What the method of a timeline that does one tick is called."""
BREADTH_FIRST: Final = ("bfs", "exact")
"""What the planner is called that searches breadth first."""


class MissingError(Exception):
    """Something is found under none of its names."""


@cache
def the(what: str) -> Any:
    """A thing of the table."""
    for place in PLACES[what]:
        module, _, name = place.partition(":")
        try:
            return getattr(import_module(module), name)
        except (ModuleNotFoundError, AttributeError):
            continue
    raise MissingError(f"{what} under {', '.join(PLACES[what])}")


def attribute(owner: Any, names: Sequence[str]) -> str:
    """Which of its names an attribute has."""
    for name in names:
        if hasattr(owner, name):
            return name
    raise MissingError(f"{owner} has none of {', '.join(names)}")


def config(**parts: Any) -> Any:
    """A configuration; the planner `breadth first` under the name that it has here."""
    if parts.get("planner") != "breadth first":
        return the("Config")(**parts)
    for name in BREADTH_FIRST:
        try:
            return the("Config")(**{**parts, "planner": name})
        except ValueError:
            continue
    raise MissingError("no planner that searches breadth first")


Work = Callable[[], tuple[int, Any]]
"""Does a fixed amount of work; answers how many units that is, and what it came to."""


def ticks(planner: str, roads: int) -> Work:
    """First episodes, decided with the whole trace, to their ends."""
    starts = [the("State").start(config(seed=seed, planner=planner)) for seed in range(roads)]
    step, state = the("step"), attrgetter(attribute(the("Result"), STATE))
    running = the("Outcome").RUNNING

    def work() -> tuple[int, Any]:
        count, digests = 0, []
        for now in starts:
            while now.world.outcome is running:
                now = state(step(now))
                count += 1
            digests.append(now.world.digest())
        return count, digests

    return work


def asked(what: str, roads: int, potholes: Sequence[int | None]) -> Work:
    """A question of the oracle at the beginnings of roads."""
    starts = [
        the("State").start(config(seed=seed, potholes=count, pedestrians=seed % 3))
        for count in potholes
        for seed in range(roads)
    ]
    ask = the(what)

    def work() -> tuple[int, Any]:
        answers = [ask(start) for start in starts]
        return len(answers), [each if isinstance(each, int) else type(each).__name__ for each in answers]

    return work


def moments(count: int, planner: str) -> list[Any]:
    """Timelines a few ticks into roads with few and with many potholes."""
    found = []
    for seed in range(count):
        timeline = the("Timeline")(config(seed=seed, potholes=seed * 7 % 40, planner=planner))
        step = getattr(timeline, attribute(timeline, STEP))
        for _ in range(1 + seed % 25):
            step()
        found.append(timeline)
    return found


def explained(what: str, count: int, planner: str = "rules") -> Work:
    """A question to each of so many moments."""
    timelines, ask, refused = moments(count, planner), the(what), the("QuestionError")
    more: tuple[Any, ...] = ()
    if what == "why_not":
        more = (the("Move").LEFT,)
    elif what == "what_if":
        more = ([the("Remove")(kind="pothole", count="all")],)

    def work() -> tuple[int, Any]:
        answered = 0
        for timeline in timelines:
            try:
                ask(timeline, *more)
            except refused:
                continue  # it did go left
            answered += 1
        return len(timelines), answered

    return work


def crashes(count: int) -> Work:
    """The explanation of a crash, on crowded roads where nobody brakes."""
    found: list[Any] = []
    seed, outcomes, why_crashed = 0, the("Outcome"), the("why_crashed")
    while len(found) < count:
        parts = {"columns": 5, "rows": 12, "vehicles": 14, "attentive": 0.0, "planner": "priority"}
        timeline = the("Timeline")(config(seed=seed, **parts))
        step, state = getattr(timeline, attribute(timeline, STEP)), attribute(timeline, STATE)
        while getattr(timeline, state).world.outcome is outcomes.RUNNING:
            step()
        if getattr(timeline, state).world.outcome is outcomes.CRASH:
            found.append(timeline)
        seed += 1

    def work() -> tuple[int, Any]:
        for timeline in found:
            why_crashed(timeline)
        return len(found), seed

    return work


def one_environment(steps: int) -> Work:
    """Steps of one world, a forward move mostly, with resets."""
    env = the("RoadEnv")()

    def work() -> tuple[int, Any]:
        env.reset(seed=5)
        paid = 0.0
        for number in range(steps):
            _, reward, over, late, _ = env.step(number * number % 7 % 6)
            paid += reward
            if over or late:
                env.reset()
        return steps, round(paid, 6)

    return work


def many_environments(lanes: int, steps: int) -> Work:
    """Steps of many worlds at once."""
    import numpy as np

    env = the("RoadVectorEnv")(lanes)
    actions = [np.arange(lanes) * (number + 3) % 7 % 6 for number in range(steps)]

    def work() -> tuple[int, Any]:
        env.reset(seed=5)
        paid = sum(float(env.step(action)[1].sum()) for action in actions)
        return lanes * steps, round(paid, 3)

    return work


def saved_environment(times: int) -> Work:
    """The state of one world written and read."""
    env = the("RoadEnv")()
    env.reset(seed=5)

    def work() -> tuple[int, Any]:
        for _ in range(times):
            state = env.get_state()
            env.set_state(state)
        return times, state["digest"]

    return work


def batch(planner: str, lanes: int, amount: int) -> Work:
    """Ticks of many worlds, each begun again when it ends."""
    batch_of = the("Batch")
    start = batch_of([config(seed=seed) for seed in range(lanes)], after="restart")
    names = BREADTH_FIRST if planner == "breadth first" else (planner,)
    for name in names:
        try:
            start.copy().run(1, name)
            planner = name
            break
        except (ValueError, KeyError, LookupError):
            continue
    else:
        raise MissingError(f"no planner {planner} in the batch")

    def work() -> tuple[int, Any]:
        worlds = start.copy()
        worlds.run(amount, planner)
        return lanes * amount, worlds.digest(0)

    return work


@cache
def session(length: int = 3_000) -> Any:
    """A session with a change every 100 ticks."""
    timeline = the("Timeline")(config(seed=3))
    step = getattr(timeline, attribute(timeline, STEP))
    changes = [
        the("Add")(kind="pothole", count=3),
        the("SetCount")(kind="vehicle", count=25),
        the("Remove")(kind="pothole", count="all"),
    ]
    for tick in range(length):
        if tick % 100 == 50:
            timeline.apply(tick, [changes[tick // 100 % len(changes)]])
        step()
    return timeline


def past_ticks() -> Work:
    """States of the past of a session, from the nearest snapshot on."""
    timeline = session()

    def work() -> tuple[int, Any]:
        asked = range(1, timeline.tick, 31)
        return len(asked), [timeline.at(tick).world.digest() for tick in asked][-1]

    return work


def forks() -> Work:
    """Copies of a session that go back to a tick and on from there."""
    timeline = session()
    steps = attribute(timeline, STEP)

    def work() -> tuple[int, Any]:
        ticks = range(1, timeline.tick, 97)
        for tick in ticks:
            fork = timeline.copy()
            fork.rewind(tick)
            getattr(fork, steps)()
        return len(ticks), getattr(fork, attribute(fork, STATE)).world.digest()

    return work


def replayed() -> Work:
    """A whole session, replayed from its log, a change less."""
    timeline = session()

    def work() -> tuple[int, Any]:
        fork = timeline.copy()
        fork.rewrite(list(timeline.entries)[1:], 0)
        return fork.tick, getattr(fork, attribute(fork, STATE)).world.digest()

    return work


WORKS: Final[dict[str, Callable[[], Work]]] = {
    "tick, rules": lambda: ticks("rules", 60),
    "tick, priority": lambda: ticks("priority", 60),
    "tick, astar": lambda: ticks("astar", 6),
    "tick, breadth first": lambda: ticks("breadth first", 20),
    "least_ticks": lambda: asked("least_ticks", 40, (None, 20, 60)),
    "certify": lambda: asked("certify", 8, (None, 20, 60, 90)),
    "why": lambda: explained("why", 200),
    "why, astar": lambda: explained("why", 5, "astar"),
    "why_not": lambda: explained("why_not", 50),
    "what_if": lambda: explained("what_if", 20),
    "crash explained": lambda: crashes(30),
    "env step": lambda: one_environment(2_000),
    "env step, one of 256": lambda: many_environments(256, 200),
    "env saved and restored": lambda: saved_environment(1_000),
    "batch tick, priority": lambda: batch("priority", 1024, 10_000),
    "batch tick, breadth first": lambda: batch("breadth first", 256, 300),
    "session: a past tick": past_ticks,
    "session: fork, back and on": forks,
    "session: tick of a replay": replayed,
}


def prepared(name: str) -> dict[str, Any]:
    """Make what a kind of work needs, and do it once: how long it takes and what it comes to."""
    try:
        work = works[name] = WORKS[name]()
        work()
    except (MissingError, ImportError) as error:
        return {"missing": str(error)}
    return timed(work)


def timed(work: Work) -> dict[str, Any]:
    """CPU seconds of one repetition."""
    gc.collect()
    gc.freeze()  # what other kinds of work keep is not walked through in this one's time
    began = time.process_time()
    units, came_to = work()
    return {"seconds": time.process_time() - began, "units": units, "came_to": str(came_to)}


works: dict[str, Work] = {}


def main() -> None:
    """Answer questions until the input ends."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # whatever is printed is no answer
    for line in sys.stdin:
        match json.loads(line):
            case ["names"]:
                answer: Any = [*WORKS]
            case ["prepare", name]:
                answer = prepared(name)
            case ["work", name]:
                answer = timed(works[name])
        answers.write(json.dumps(answer) + "\n")
        answers.flush()


if __name__ == "__main__":
    main()
