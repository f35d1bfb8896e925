"""20,000 episodes with all that is decided in them, as one hash for each group of 50.

    python -m tools.episodes --check [--processes 2]   compares all groups with the file
    python -m tools.episodes --lines "rules mixed 3"   prints what a group's hash is made of, for `diff`
    python -m tools.episodes --write FILE              writes the file by the code that is here

The hashes in `tests/data/v2/episodes.json` are those of the first program with version 2 of the rules: what
changes them on purpose takes a new version. Each tick is a line: digest of the world, outcome, move, trace of
all six moves, events. Planner names are left out of decisions.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import blake2b
from multiprocessing import Pool
from pathlib import Path
from typing import Any, Final

from sim.actions import Add, Adjust, Drive, Prefer, Remove, Reset, Scenario, Set, SetCount, SetMode, Where
from sim.config import Config
from sim.events import Event
from sim.generation import GenerationError
from sim.plan import Decision
from sim.session.edits import Applied, EditError, apply
from sim.state import SimState, StepResult
from sim.transition import step
from sim.types import Mode, Move, Outcome

KEPT: Final = Path(__file__).parents[1] / "tests" / "data" / "v2" / "episodes.json"
RUNS, EPISODES = 10, 5
"""Runs of a group, and the episodes that each of them is followed for."""
BREADTH_FIRST: Final = "exact"
"""The name of the planner that searches breadth first."""
SAME_NAME: Final = {"bfs": "exact"}
"""Names that mean the same as one of the version that wrote the file."""

Choices = Mapping[str, Sequence[Any]]


@dataclass(frozen=True)
class Family:
    """Groups of one kind: each run draws one of the values of every field of its configuration."""

    name: str
    planners: Mapping[str, int]
    """how many groups there are with each"""
    choices: Choices = field(default_factory=dict)
    edits: Sequence[Any] = ()
    """actions that some are drawn from, each to be done at a tick that is drawn as well"""


def drawn(choices: Sequence[Any], *purpose: object) -> Any:
    """One of these, the same on every machine."""
    word = blake2b(repr(purpose).encode(), digest_size=8).digest()
    return choices[int.from_bytes(word) % len(choices)]


SIZES: Final = ((3, 4), (4, 8), (5, 12), (8, 8), (8, 30), (11, 20), (12, 60))
SMALL: Final = ((3, 4), (4, 8), (5, 12), (6, 10), (8, 12))
PREFERENCES: Final = (
    (),
    (),
    ("avoid_potholes",),
    ("smooth_ride",),
    ("fastest",),
    ("cautious",),
    ("avoid_potholes", "cautious"),
    ("smooth_ride", "fastest"),
)
ANY: Final[Choices] = {
    "size": SIZES,
    "density": (0.0, 0.05, 0.1, 0.2, 0.3),
    "spawn_probability": (0.0, 0.34, 0.68, 0.68, 1.0),
    "pothole_probability": (0.0, 0.15, 0.15, 0.5),
    "barriers": (0, 0, 0, 2),
    "pedestrians": (0, 0, 1, 3),
    "courtesy": (0.0, 0.0, 0.3, 1.0),
    "attentive": (1.0, 1.0, 0.5, 0.0),
    "collision": ("swept", "swept", "cell"),
    "repetition": (True, True, False),
    "reset_delay_s": (2.0, 0.0, 0.5),
    "cell_m": (5.0, 5.0, 3.7),
}
ANY_SMALL: Final[Choices] = {
    **ANY,
    "size": SMALL,
    "preferences": PREFERENCES,
    "safety_buffer": (1, 1, 0, 2, 3),
}
FIRST_RULES: Final[Choices] = {
    "rules": (1,),
    "collision": ("cell",),
    "attentive": (0.0,),
    "repetition": (False,),
}

AHEAD, LEFT_LANE = Where(side="ahead"), Where(lane="left")
CHANGES: Final = (
    Add(kind="pothole", count=1, where=AHEAD),
    Add(kind="pothole", count=3),
    Add(kind="pothole", count=1, where=Where(side="ahead", cells=1)),
    Add(kind="barrier", count=1, where=Where(cell=(1, 2))),
    Add(kind="barrier", count=2, where=Where(side="ahead", distance_m=10.0)),
    Add(kind="vehicle", count=2),
    Add(kind="vehicle", count=1, where=LEFT_LANE),
    Add(kind="pedestrian", count=1, where=Where(row=2)),
    Remove(kind="pothole", count=1, where=Where(nearest=True)),
    Remove(kind="vehicle", count=1, where=Where(nearest=True)),
    Remove(kind="everything", count="all", where=LEFT_LANE),
    Remove(kind="vehicle", count="all"),
    Remove(kind="pothole", count=1, where=Where(id="pothole-2")),
    SetCount(kind="vehicle", count=4),
    SetCount(kind="pothole", count=6),
    SetCount(kind="pedestrian", count=2),
    Reset(),
    Set(parameter="courtesy", value=0.3),
    Set(parameter="attentive", value=0.5),
    Set(parameter="traffic", value="heavy"),
    Set(parameter="columns", value=5),
    Set(parameter="rows", value=11),
    Set(parameter="seed", value=77),
    Set(parameter="step_seconds", value=0.25),
    Adjust(parameter="pothole_probability", direction="up"),
    Adjust(parameter="courtesy", by=0.2),
    Adjust(parameter="rows", direction="down"),
)
ROADS: Final = (
    Scenario(road="city", potholes=12),
    Scenario(road="highway", traffic="heavy"),
    Scenario(layout="narrows", vehicles=10),
    Scenario(potholes=10_000),
    Set(parameter="planner", value="priority"),
    Set(parameter="planner", value="rules"),
)
WISHES: Final = (
    Prefer(preference="cautious"),
    Prefer(preference="fastest"),
    Prefer(preference="balanced"),
    Prefer(preference="smooth_ride"),
    Set(parameter="safety_buffer", value=2),
    Set(parameter="planner", value="astar"),
    Set(parameter="planner", value="dijkstra"),
    Set(parameter="planner", value=BREADTH_FIRST),
    Set(parameter="planner", value="rules"),
    Set(parameter="planner", value="dwa"),
)
BY_HAND: Final = (
    *(Drive(move=move) for move in Move),
    *(Drive(move=Move.FORWARD) for _ in range(6)),
    *(Drive(move=move) for move in (Move.FORWARD_LEFT, Move.FORWARD_RIGHT)),
    SetMode(mode=Mode.MANUAL),
    SetMode(mode=Mode.AUTO),
    SetMode(mode=Mode.AUTO),
    Add(kind="pothole", count=1, where=AHEAD),
    Reset(),
)


def both(groups: int) -> dict[str, int]:
    """As many groups with each of the planners that do not search."""
    return {"rules": groups, "priority": groups}


def searching(groups: int) -> dict[str, int]:
    """As many groups with each of the planners that do."""
    return {"astar": groups, "dijkstra": groups, BREADTH_FIRST: groups}


LAYOUTS: Final = ("walls", "narrows", "dead_ends", "crossing", "maze")
FAMILIES: Final = (
    Family("default", {"rules": 22, "priority": 12}),
    Family("potholes", both(12), {"potholes": (0, 5, 10, 20, 30, 40, 60, 90)}),
    Family("probabilities", both(6), {key: ANY[key] for key in ("spawn_probability", "pothole_probability")}),
    Family("courtesy", both(8), {"courtesy": (0.3, 1.0), "potholes": (None, 20)}),
    Family("attentive", both(8), {"attentive": (0.0, 0.5), "potholes": (None, 20)}),
    Family("pedestrians", both(8), {"pedestrians": (1, 5, 15), "vehicles": (None, 0, 40)}),
    Family("barriers", both(8), {"barriers": (1, 6, 20), "potholes": (None, 0)}),
    Family("layouts", both(12), {"layout": LAYOUTS, "size": ((8, 30), (5, 12), (12, 20))}),
    Family("cells", both(8), {"collision": ("cell",), "attentive": (0.0, 0.5, 1.0)}),
    Family("limit", both(6), {"repetition": (False,), "density": (0.0, 0.1, 0.2), "size": SMALL}),
    Family("first rules", {"rules": 2, "priority": 14}, {**FIRST_RULES, "potholes": (None, 0, 20)}),
    Family(
        "drivable", both(6), {"solvable": (True,), "density": (0.1, 0.2, 0.3), "size": ((8, 30), (6, 10))}
    ),
    Family("sizes", both(8), {"size": SIZES}),
    Family("mixed", both(23), ANY),
    Family("changed", both(20), ANY, (*CHANGES, *CHANGES, *ROADS)),
    Family("by hand", both(12), ANY, (*BY_HAND, *BY_HAND, *CHANGES)),
    Family("default", searching(3), {"size": ((8, 16),)}),
    Family("mixed", searching(7), ANY_SMALL),
    Family("changed", searching(6), ANY_SMALL, (*CHANGES, *WISHES, *WISHES)),
    Family("by hand", searching(2), ANY_SMALL, (*BY_HAND, *BY_HAND, *WISHES)),
    Family(
        "layouts", searching(2), {"layout": LAYOUTS, "size": ((5, 12), (6, 10)), "preferences": PREFERENCES}
    ),
)


def groups() -> dict[str, tuple[Family, str]]:
    """Family and planner of every group, by its name."""
    return {
        f"{SAME_NAME.get(planner, planner)} {family.name} {number}": (family, planner)
        for family in FAMILIES
        for planner, count in family.planners.items()
        for number in range(count)
    }


def config_of(group: str, number: int, attempt: int) -> Config:
    """What a run of a group begins with."""
    family, planner = groups()[group]
    parts = {name: drawn(values, group, number, name) for name, values in family.choices.items()}
    columns, rows = parts.pop("size", (8, 30))
    if (density := parts.pop("density", None)) is not None and drawn((True, False), group, number, "counted"):
        cells = columns * (rows - 2)
        parts["potholes"], parts["vehicles"] = int(cells * density), int(cells * density / 2)
    if columns * rows < 20:
        parts |= {"barriers": 0, "pedestrians": min(1, parts.get("pedestrians", 0))}  # there is room for few
    seed = drawn(range(2**40), group, number, "seed", attempt)
    return Config(seed=seed, planner=planner, columns=columns, rows=rows, **parts)


def started(group: str, number: int) -> SimState:
    """The run; where no road is found that must be drivable, one of another seed."""
    attempt = 0
    while True:
        try:
            return SimState.start(config_of(group, number, attempt))
        except GenerationError:
            attempt += 1


def changes_of(group: str, number: int) -> dict[int, list[Any]]:
    """What is done in a run, by tick."""
    family, _ = groups()[group]
    due: dict[int, list[Any]] = {}
    if family.edits:
        for change in range(drawn(range(4, 16), group, number, "changes")):
            tick = drawn(range(90), group, number, "at", change)
            due.setdefault(tick, []).append(drawn(family.edits, group, number, "change", change))
    return due


def lines_of(group: str) -> Iterator[str]:
    """What a group's hash is made of: a line for each tick and each change."""
    for number in range(RUNS):
        state, due, ended = started(group, number), changes_of(group, number), 0
        yield f"run {number} {state.world.digest()}"
        for tick in range(1_000_000):
            for action in due.get(tick, ()):
                try:
                    applied = apply(state, action)
                except EditError as error:
                    yield f"refused {error.category} {error.field}"
                else:
                    state = applied.state
                    yield changed(applied)
            before = state.world.outcome
            done = step(state)
            state = done.state
            yield told(done)
            ended += before is Outcome.RUNNING and state.world.outcome is not Outcome.RUNNING
            if ended == EPISODES:
                break
        yield figures(state)


def told(done: StepResult) -> str:
    """All that a tick came to."""
    world = done.state.world
    trace = "-" if done.decision is None else decided(done.decision)
    if done.decision is not None and world.outcome is not Outcome.RUNNING:
        trace += driven(done.state)
    events = " ".join(map(happened, done.events))
    return f"{world.tick} {world.digest()} {world.outcome.value} | {trace} | {events}"


def decided(decision: Decision) -> str:
    """A decision with its whole trace."""
    options = (
        f"{option.move.value}:{option.cell}:{option.reason.value}:{option.cost!r}:{','.join(option.causes)}"
        for option in decision.options
    )
    asked = "-" if decision.asked is None else decision.asked.value
    move, measure = decision.move.value, decision.measure.value
    return f"{decision.tick} {decision.av} {move} {asked} {measure} {decision.fault} {' '.join(options)}"


def driven(state: SimState) -> str:
    """What an episode came to at its end: moves, and detours by their reason."""
    course = state.record
    start, last = (None if each is None else each.digest() for each in (course.start, course.last))
    detours = ",".join(f"{reason.value}:{count}" for reason, count in course.sakes)
    return f" driven {course.changed} {course.certain} {course.moves} {detours} {start} {last}"


def happened(event: Event) -> str:
    """An event with all its parts."""
    move = None if event.move is None else event.move.value
    ids = ",".join(event.ids)
    return f"{event.type.value}:{event.tick}:{event.episode}:{ids}:{event.cell}:{move}:{event.how}"


def changed(applied: Applied) -> str:
    """What a change has done."""
    figures = " ".join(f"{each.path}={plain(each.before)}>{plain(each.after)}" for each in applied.changes)
    added, removed = (
        ",".join(f"{thing.id}@{thing.cell}" for thing in each) for each in (applied.added, applied.removed)
    )
    events = " ".join(map(happened, applied.events))
    return f"changed {applied.state.world.digest()} {figures} +{added} -{removed} {events}"


def plain(value: Any) -> Any:
    """A figure before or after a change, with the planner's name of then."""
    if isinstance(value, tuple):
        return ",".join(str(plain(each)) for each in value)
    return SAME_NAME.get(value, value) if isinstance(value, str) else repr(value)


def figures(state: SimState) -> str:
    """What a run has come to in all."""
    counts = state.metrics
    ends = (counts.successes, counts.crashes, counts.stuck, counts.last_episode_ticks)
    return f"{ends} {counts.forward} {counts.lateral} {counts.diagonal} {counts.stay} {counts.distance_m!r}"


def hashed(group: str) -> tuple[str, str, int]:
    """A group's name, its hash, and its ticks."""
    total, ticks = blake2b(digest_size=8), 0
    for line in lines_of(group):
        total.update(line.encode() + b"\n")
        ticks += line[0].isdigit()
    return group, total.hexdigest(), ticks


def hashes(names: Iterable[str], processes: int = 1) -> tuple[dict[str, str], int]:
    """The hash of each of these groups, and the ticks of all."""
    found: dict[str, str] = {}
    ticks = 0
    with Pool(processes) as pool:
        each = pool.imap(hashed, names, chunksize=1) if processes > 1 else map(hashed, names)
        for name, value, count in each:
            found[name] = value
            ticks += count
    return found, ticks


def kept() -> dict[str, str]:
    """The hashes of the version that wrote the file."""
    return dict(json.loads(KEPT.read_text())["groups"])


def main() -> int:
    """Print how many groups differ, and which; 1 if any does."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--check", action="store_true", help="compare with what is kept")
    what.add_argument("--write", type=Path, metavar="FILE", help="write the hashes of this version")
    what.add_argument("--lines", metavar="GROUP", help="print what one group's hash is made of")
    parser.add_argument("--processes", type=int, default=1, help="processes to share the work")
    given = parser.parse_args()
    if given.lines:
        print(*lines_of(given.lines), sep="\n")
        return 0
    began = time.perf_counter()
    found, ticks = hashes(groups(), given.processes)
    if given.write:
        body = {"episodes": len(found) * RUNS * EPISODES, "ticks": ticks, "groups": found}
        given.write.write_text(json.dumps(body, indent=0) + "\n")
        apart = []
    else:
        then = kept()
        apart = sorted(name for name in found.keys() | then.keys() if found.get(name) != then.get(name))
        for name in apart:
            print(f"differs: {name}")
    episodes, seconds = len(found) * RUNS * EPISODES, time.perf_counter() - began
    print(f"{episodes:,} episodes, {ticks:,} ticks, {len(apart)} groups differ ({seconds:.0f} s)")
    return 1 if apart else 0


if __name__ == "__main__":
    raise SystemExit(main())
